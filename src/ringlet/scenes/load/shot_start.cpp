// Implements scenes/load/shot_start.h.
#include "ringlet/scenes/load/shot_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "ringlet/measure/head_fit.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet {
namespace {

// The strands of the scene, in another run's frames.
class ShotFrames {
 public:
  static Result<ShotFrames> open(const std::filesystem::path& file, const SceneFile& scene,
                                 const LoadedScene& loaded) {
    auto run = AnimationReader::open(file, foreignReadingOf(scene));
    if (!run) return run.error();
    ShotFrames self(std::move(*run), loaded);
    if (self.strands_.empty())
      return Error{fmt::format(
          "{} has {} strands of {} particles in all, the groom {} of {}; expected the same strands, particle for "
          "particle",
          file.string(), self.run_.groom().strandCount(), self.run_.groom().firstPoint.back(),
          loaded.groom.strandCount(), loaded.groom.points.size())};
    return self;
  }

  const AnimationReader& run() const { return run_; }

  // Of all particles, seen from the head, relative to the first of their strand [m].
  Result<std::vector<Vec3d>> offsetsAt(int frame) {
    if (Status read = run_.readFrame(frame); !read) return read.error();
    std::vector<Vec3d> rest, found;
    for (std::size_t s = 0; s < groom_->strandCount(); ++s) {
      const auto roots = std::min<std::size_t>(rootCount_, groom_->strand(s).size());
      for (std::size_t i = 0; i < roots; ++i) {
        rest.push_back(Vec3d(groom_->strand(s)[i]) * groom_->metresPerUnit);
        found.push_back(placeOf(s, i));
      }
    }
    const Quatd back = fitHeadRotation(rest, found).conjugate();
    std::vector<Vec3d> offsets;
    for (std::size_t s = 0; s < groom_->strandCount(); ++s)
      for (std::size_t i = 0; i < groom_->strand(s).size(); ++i)
        offsets.push_back(rotate(back, placeOf(s, i) - placeOf(s, 0)));
    return offsets;
  }

 private:
  ShotFrames(AnimationReader run, const LoadedScene& loaded)
      : run_(std::move(run)),
        groom_(&loaded.groom),
        rootCount_(static_cast<std::size_t>(loaded.settings.rootCount)) {
    takeStrands(loaded.level.get());
  }

  // The run's strands are the scene's; or all hairs of a groom whose guides the scene has.
  void takeStrands(const LevelOfDetail* level) {
    std::vector<std::uint32_t> strands(groom_->strandCount());
    std::iota(strands.begin(), strands.end(), 0U);
    if (level && !level->guides.empty() && run_.groom().strandCount() == level->hairs.size()) {
      strands = level->guides;
      strands.insert(strands.end(), level->sample.begin(), level->sample.end());
    } else if (run_.groom().strandCount() != strands.size()) {
      return;
    }
    const std::vector<std::uint32_t>& first = run_.groom().firstPoint;
    for (std::size_t s = 0; s < strands.size(); ++s)
      if (first[strands[s] + 1] - first[strands[s]] != groom_->strand(s).size()) return;
    strands_ = std::move(strands);
  }

  Vec3d placeOf(std::size_t strand, std::size_t particle) const {
    const Groom& groom = run_.groom();
    return Vec3d(groom.points[groom.firstPoint[strands_[strand]] + particle]) * run_.header().metresPerUnit;
  }

  AnimationReader run_;
  const Groom* groom_;
  std::size_t rootCount_;
  std::vector<std::uint32_t> strands_{};  // of the run, of each of the groom's; empty: others
};

// Of all strands together, from the places of particles in the head's frame, or such of the run.
template <class PlaceOf>
double lengthOf(const Groom& groom, PlaceOf placeOf) {
  double all = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    for (std::uint32_t i = groom.firstPoint[s] + 1; i < groom.firstPoint[s + 1]; ++i)
      all += length(placeOf(i) - placeOf(i - 1));
  return all;
}

void doubtLength(const Groom& groom, const std::vector<Vec3d>& offsets, const std::string& name,
                 std::vector<std::string>& warnings) {
  constexpr double kUsual = 0.2;
  const double rest =
      lengthOf(groom, [&](std::uint32_t i) { return Vec3d(groom.points[i]) * groom.metresPerUnit; });
  const double share = lengthOf(groom, [&](std::uint32_t i) { return offsets[i]; }) / rest;
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

Result<ShotStart> loadShotStart(const SceneFile& scene, LoadedScene& loaded) {
  const auto file = animationFileOf(scene.start.from);
  if (!file) return file.error();
  const std::string name = file->string();
  auto frames = ShotFrames::open(*file, scene, loaded);
  if (!frames) return frames.error();
  const int count = frames->run().frameCount(), frame = scene.start.frame.value_or(count);
  if (frame < 1 || frame > count)
    return Error{fmt::format("{} has frames 1 to {}; there is no frame {}", name, count, frame)};
  // The frame and the two before it, as far as there are.
  std::vector<std::vector<Vec3d>> offsets;
  for (int k = std::max(1, frame - 2); k <= frame; ++k) {
    auto read = frames->offsetsAt(k);
    if (!read) return read.error();
    offsets.push_back(std::move(*read));
  }
  if (offsets.size() == 1)
    loaded.warnings.push_back(fmt::format(
        "frame 1 of {} has none before it, which velocities would follow from; hair begins without any",
        name));
  doubtLength(loaded.groom, offsets.back(), name, loaded.warnings);
  ShotStart start;
  for (std::size_t i = 0; i < offsets.back().size(); ++i) {
    start.offsets.push_back(Vec3f(offsets.back()[i]));
    start.velocities.push_back(Vec3f(slopeAtEnd(offsets, i) * frames->run().header().framesPerSecond));
  }
  return start;
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

Status takeShotStart(const SceneFile& scene, LoadedScene& loaded) {
  if (scene.start.from.empty()) {
    if (!scene.start.frame && scene.start.blend == 0) return {};
    return Error{"start.frame and start.blend have no effect without start.from; expected the run it is of"};
  }
  if (scene.motion.preRollSeconds > 0)
    return Error{
        "found start.from and motion.pre_roll: one lets hair begin as another run ended, the other with its own "
        "motion before the first frame; expected one of them"};
  auto start = loadShotStart(scene, loaded);
  if (!start) return Error{fmt::format("the start: {}", start.error().message), start.error().fault};
  loaded.start = std::make_shared<const ShotStart>(std::move(*start));
  return {};
}

}  // namespace ringlet
