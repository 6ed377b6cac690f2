// Implements run_writers.h.
#include "ringlet/run/run_writers.h"

#include <algorithm>
#include <utility>

#include "ringlet/bodies/body_surface.h"
#include "ringlet/groom/obj_file.h"

namespace ringlet {
namespace {

std::vector<SheetSolid> solidsOf(std::span<const Body> bodies) {
  std::vector<SheetSolid> solids;
  for (const Body& body : bodies) {
    TriangleMesh mesh = surfaceOf(body);
    solids.push_back({std::move(mesh.points), std::move(mesh.triangles)});
  }
  return solids;
}

std::vector<SheetPlace> placesOf(std::span<const BodyPose> bodies) {
  std::vector<SheetPlace> places;
  for (const BodyPose& pose : bodies) places.push_back({pose.position, pose.rotation});
  return places;
}

}  // namespace

RunWriters::RunWriters(const LoadedScene& scene, const RunOptions& options, std::optional<FullHair> hairs,
                       int frameCount)
    : scene_(scene),
      options_(options),
      frames_(scene),
      cuts_(frames_, scene.frameCount),
      hairs_(std::move(hairs)),
      frameCount_(frameCount) {
  if (hairs_ && hairs_->areOwn() && !scene.level->sample.empty()) followWatch_.emplace(scene);
  if (options.writesSheet) sheet_.emplace(scene.groom, scene.frameCount, options.up, solidsOf(scene.bodies));
}

Status RunWriters::open() {
  const double metresPerUnit = scene_.groom.metresPerUnit;
  const AnimationOptions animation{.framesPerSecond = scene_.settings.framesPerSecond,
                                   .metresPerUnit = metresPerUnit,
                                   .up = options_.up,
                                   .diameter = static_cast<float>(options_.width / metresPerUnit),
                                   .frameCount = scene_.frameCount,
                                   .precision = options_.cache.value_or(CachePrecision::float32),
                                   .usd = usdExtras()};
  for (const std::string& name : animationsOf(options_)) {
    const std::filesystem::path path = options_.folder / name;
    auto writer = animationFormatOf(path)->resume(path, hairs_ ? hairs_->groom() : scene_.groom, animation,
                                                  frameCount_);
    if (!writer) return writer.error();
    animations_.push_back(std::move(*writer));
    if (Status written = (hairs_ ? hairs_->cutsOfHairs(cuts_) : cuts_).write(path); !written) return written;
  }
  isOpen_ = true;
  return {};
}

UsdExtras RunWriters::usdExtras() const {
  const auto has = [&](const char* value) { return std::ranges::count(options_.values, value) > 0; };
  UsdExtras extras{.ids = has("id"),
                   .rest = has("rest"),
                   .velocities = has("velocities"),
                   .unreal = has("unreal"),
                   .head = options_.usdHead,
                   .clipFrames = options_.clipFrames,
                   .origin = options_.origin,
                   .originValues = has("groom"),
                   .originPrims = options_.usesGroomPrims};
  if (extras.unreal) addGroups(extras);
  if (extras.unreal && hairs_) extras.closestGuides = hairs_->closestGuides();
  extras.widthFactors.assign(scene_.widthFactors.begin(), scene_.widthFactors.end());
  if (hairs_ && !hairs_->areOwn() && !extras.widthFactors.empty()) {
    extras.widthFactors.clear();
    for (const std::uint32_t strand : hairs_->strandOf())
      extras.widthFactors.push_back(scene_.widthFactors[strand]);
  }
  if (options_.tipWidth)
    extras.tipDiameter = static_cast<float>(*options_.tipWidth / scene_.groom.metresPerUnit);
  return extras;
}

// Each strand is of the first group that has it; those of none are one group more.
void RunWriters::addGroups(UsdExtras& extras) const {
  if (options_.groups.empty()) return;
  const bool areOwn = hairs_ && hairs_->areOwn();
  std::vector<std::uint32_t> groupOf((areOwn ? hairs_->groom() : scene_.groom).strandCount(),
                                     static_cast<std::uint32_t>(options_.groups.size()));
  for (std::size_t g = options_.groups.size(); g-- > 0;) {
    for (const StrandRun& run : options_.groups[g].runs) {
      for (std::size_t s = run.first; s <= run.last && s < groupOf.size(); ++s)
        groupOf[s] = static_cast<std::uint32_t>(g);
    }
  }
  for (const RunGroup& group : options_.groups) extras.groupNames.push_back(group.name);
  extras.groupNames.emplace_back("others");
  if (!hairs_ || areOwn) {
    extras.groupOf = std::move(groupOf);
    return;
  }
  for (const std::uint32_t strand : hairs_->strandOf()) extras.groupOf.push_back(groupOf[strand]);
}

Status RunWriters::addFrame(int frame, std::vector<Vec3f> points, const HeadPose& head,
                            std::span<const BodyPose> bodies) {
  if (!isOpen_) {
    if (Status opened = open(); !opened) return opened;
  }
  if (sheet_) sheet_->offer(frame, points, placesOf(bodies), cuts_.cutBeyond(frame, scene_.groom.firstPoint));
  lastPoints_ = std::move(points);
  const UsdTransform place = rigidTransform(head.rotation, head.position / scene_.groom.metresPerUnit);
  if (hairs_ && (followWatch_ || !animations_.empty())) {
    const double seconds = frames_.secondsAt(frame);
    const std::vector<Vec3d> roots = hairs_->rootsAt(seconds, scene_.motion.poseAt(seconds));
    const auto bodyPoints = frames_.bodyPointsAt(frame);
    if (Status moved = hairs_->follow({lastPoints_, bodies, bodyPoints, roots}); !moved) return moved;
    if (followWatch_) followWatch_->look(lastPoints_, hairs_->groom().points);
  }
  const std::vector<Vec3f>& shown = hairs_ ? hairs_->groom().points : lastPoints_;
  for (const auto& animation : animations_) {
    if (Status added = animation->addFrame(shown, place); !added) return added;
  }
  return {};
}

Status RunWriters::sync() {
  for (const auto& animation : animations_) {
    if (Status done = animation->sync(); !done) return done;
  }
  return {};
}

void RunWriters::archive(Archive& archive) {
  if (sheet_) sheet_->archive(archive);
  if (followWatch_) followWatch_->archive(archive);
}

Result<std::vector<std::filesystem::path>> RunWriters::finish() {
  if (!isOpen_) {
    if (Status opened = open(); !opened) return opened.error();
  }
  for (const auto& animation : animations_) {
    if (Status done = animation->finish(); !done) return done.error();
  }
  if (options_.writesLast) {
    if (Status done = writeObj(options_.folder / "last.obj", scene_.groom, lastPoints_); !done)
      return done.error();
  }
  if (sheet_) {
    if (Status done = sheet_->write(options_.folder / "sheet.png"); !done) return done.error();
  }
  return outputsOf(options_);
}

std::optional<double> RunWriters::errorBound() const {
  std::optional<double> largest;
  for (const auto& animation : animations_) largest = std::max(largest, animation->errorBound());
  return largest;
}

}  // namespace ringlet
