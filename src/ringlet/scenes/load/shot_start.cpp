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

// Nothing where the run has no such frame.
std::optional<int> frameOf(const SceneStart& start, const AnimationReader& run) {
  const int frame = start.frame.value_or(run.frameCount());
  return frame >= 1 && frame <= run.frameCount() ? std::optional(frame) : std::nullopt;
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
  const GroomReading reading = readingOf(scene.groom);
  auto run = AnimationReader::open(*file, {.metresPerUnit = scene.groom.metresPerUnit,
                                           .upIsZ = reading.upIsZ,
                                           .rootEnd = reading.rootEnd,
                                           .pointsPerStrand = reading.pointsPerStrand,
                                           .groom = scene.groom.file});
  if (!run) return run.error();
  const std::string name = file->string();
  if (run->groom().firstPoint != groom.firstPoint)
    return Error{fmt::format(
        "{} has {} strands of {} particles in all, the groom {} of {}; expected the same strands, particle "
        "for particle",
        name, run->groom().strandCount(), run->groom().firstPoint.back(), groom.strandCount(),
        groom.points.size())};
  const auto frame = frameOf(scene.start, *run);
  if (!frame)
    return Error{fmt::format("{} has frames 1 to {}; there is no frame {}", name, run->frameCount(),
                             scene.start.frame.value_or(run->frameCount()))};
  const double unit = run->header().metresPerUnit;
  const auto offsetsAt = [&](int k) -> Result<std::vector<Vec3d>> {
    if (Status read = run->readFrame(k); !read) return read.error();
    return offsetsOf(groom, run->groom().points, unit, rootCount);
  };
  std::vector<Vec3d> before;
  if (*frame > 1) {
    auto read = offsetsAt(*frame - 1);
    if (!read) return read.error();
    before = std::move(*read);
  }
  const auto offsets = offsetsAt(*frame);
  if (!offsets) return offsets.error();
  if (before.empty()) {
    before = *offsets;
    warnings.push_back(fmt::format(
        "frame 1 of {} has none before it, which velocities would follow from; hair begins without any",
        name));
  }
  doubtLength(
      lengthOf(groom, run->groom().points) * unit / (lengthOf(groom, groom.points) * groom.metresPerUnit),
      name, warnings);
  ShotStart start;
  for (std::size_t i = 0; i < offsets->size(); ++i) {
    start.offsets.push_back(Vec3f((*offsets)[i]));
    start.velocities.push_back(Vec3f(((*offsets)[i] - before[i]) * run->header().framesPerSecond));
  }
  return start;
}

}  // namespace ringlet
