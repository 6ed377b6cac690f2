// Implements scenes/load/shot_start.h.
#include "ringlet/scenes/load/shot_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/measure/head_fit.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

std::vector<Vec3d> rootsOf(const Groom& groom, std::span<const Vec3f> points, double metresPerUnit,
                           int rootCount) {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::uint32_t first = groom.firstPoint[s], end = groom.firstPoint[s + 1];
    for (std::uint32_t i = first; i < std::min(end, first + static_cast<std::uint32_t>(rootCount)); ++i)
      roots.push_back(Vec3d(points[i]) * metresPerUnit);
  }
  return roots;
}

// Seen from the head.
std::vector<Vec3d> offsetsOf(const Groom& groom, std::span<const Vec3f> points, double metresPerUnit,
                             int rootCount) {
  const std::vector<Vec3d> rest = rootsOf(groom, groom.points, groom.metresPerUnit, rootCount);
  const Quatd back = fitHeadRotation(rest, rootsOf(groom, points, metresPerUnit, rootCount)).conjugate();
  std::vector<Vec3d> offsets;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const Vec3d root(points[groom.firstPoint[s]]);
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      offsets.push_back(rotate(back, (Vec3d(points[i]) - root) * metresPerUnit));
  }
  return offsets;
}

double lengthOf(const Groom& groom, std::span<const Vec3f> points) {
  double all = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    for (std::uint32_t i = groom.firstPoint[s] + 1; i < groom.firstPoint[s + 1]; ++i)
      all += length(Vec3d(points[i]) - Vec3d(points[i - 1]));
  return all;
}

void doubtLength(double share, const std::string& name, std::vector<std::string>& warnings) {
  constexpr double kUsual = 0.2;
  if (std::abs(share - 1) <= kUsual) return;
  warnings.push_back(
      fmt::format("the strands of {} are {:.3g} times as long as the groom's: it has another unit, or is of "
                  "another groom",
                  name, share));
}

// Of a particle's way a frame, at the last of one frame, two or three: exact where it goes on a parabola
// through three.
Vec3d slopeAtEnd(const std::vector<std::vector<Vec3d>>& frames, std::size_t particle) {
  const auto at = [&](std::size_t back) { return frames[frames.size() - 1 - back][particle]; };
  if (frames.size() == 1) return {};
  if (frames.size() == 2) return at(0) - at(1);
  return at(0) * 1.5 - at(1) * 2.0 + at(2) * 0.5;
}

// Nothing where the run has no such frame.
std::optional<int> frameOf(const SceneStart& start, const AnimationReader& run) {
  const int frame = start.frame.value_or(run.frameCount());
  return frame >= 1 && frame <= run.frameCount() ? std::optional(frame) : std::nullopt;
}

// Of the groom's strands.
Result<AnimationReader> openRun(const std::filesystem::path& file, const SceneFile& scene,
                                const Groom& groom) {
  const GroomReading reading = readingOf(scene.groom);
  auto run = AnimationReader::open(file, {.metresPerUnit = scene.groom.metresPerUnit,
                                          .upIsZ = reading.upIsZ,
                                          .rootEnd = reading.rootEnd,
                                          .pointsPerStrand = reading.pointsPerStrand,
                                          .framesPerSecond = scene.simulation.framesPerSecond,
                                          .groom = scene.groom.file});
  if (!run || run->groom().firstPoint == groom.firstPoint) return run;
  return Error{fmt::format(
      "{} has {} strands of {} particles in all, the groom {} of {}; expected the same strands, particle for "
      "particle",
      file.string(), run->groom().strandCount(), run->groom().firstPoint.back(), groom.strandCount(),
      groom.points.size())};
}

}  // namespace

std::vector<Vec3f> ShotStart::placesIn(const Groom& groom) const {
  std::vector<Vec3f> places;
  places.reserve(offsets.size());
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const Vec3d root = Vec3d(groom.points[groom.firstPoint[s]]) * groom.metresPerUnit;
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      places.push_back(Vec3f(root + Vec3d(offsets[i])));
  }
  return places;
}

Result<ShotStart> loadShotStart(const SceneFile& scene, const Groom& groom, int rootCount,
                                std::vector<std::string>& warnings) {
  const auto file = animationFileOf(scene.start.from);
  if (!file) return file.error();
  const std::string name = file->string();
  auto run = openRun(*file, scene, groom);
  if (!run) return run.error();
  const auto frame = frameOf(scene.start, *run);
  if (!frame)
    return Error{fmt::format("{} has frames 1 to {}; there is no frame {}", name, run->frameCount(),
                             scene.start.frame.value_or(run->frameCount()))};
  const double unit = run->header().metresPerUnit;
  const auto offsetsAt = [&](int k) -> Result<std::vector<Vec3d>> {
    if (Status read = run->readFrame(k); !read) return read.error();
    return offsetsOf(groom, run->groom().points, unit, rootCount);
  };
  // The frame and the two before it, as far as there are.
  std::vector<std::vector<Vec3d>> offsets;
  for (int k = std::max(1, *frame - 2); k <= *frame; ++k) {
    auto read = offsetsAt(k);
    if (!read) return read.error();
    offsets.push_back(std::move(*read));
  }
  if (offsets.size() == 1)
    warnings.push_back(fmt::format(
        "frame 1 of {} has none before it, which velocities would follow from; hair begins without any",
        name));
  doubtLength(
      lengthOf(groom, run->groom().points) * unit / (lengthOf(groom, groom.points) * groom.metresPerUnit),
      name, warnings);
  ShotStart start;
  for (std::size_t i = 0; i < offsets.back().size(); ++i) {
    start.offsets.push_back(Vec3f(offsets.back()[i]));
    start.velocities.push_back(Vec3f(slopeAtEnd(offsets, i) * run->header().framesPerSecond));
  }
  return start;
}

}  // namespace ringlet
