// Implements run_writers.h.
#include "program/run_writers.h"

#include <algorithm>
#include <utility>

#include "ringlet/bodies/body_surface.h"
#include "ringlet/groom/obj_file.h"

namespace ringlet::program {
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

Writers::Writers(const LoadedScene& scene, const RunOptions& options, std::optional<FullHair> hairs,
                 int frameCount)
    : scene_(scene),
      options_(options),
      frames_(scene),
      cuts_(frames_, scene.frameCount),
      hairs_(std::move(hairs)),
      frameCount_(frameCount) {
  if (options.writesSheet) sheet_.emplace(scene.groom, scene.frameCount, options.up, solidsOf(scene.bodies));
}

Status Writers::open() {
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

UsdExtras Writers::usdExtras() const {
  const auto has = [&](const char* value) { return std::ranges::count(options_.values, value) > 0; };
  UsdExtras extras{.ids = has("id"),
                   .rest = has("rest"),
                   .velocities = has("velocities"),
                   .head = options_.usdHead,
                   .clipFrames = options_.clipFrames,
                   .origin = options_.origin,
                   .originValues = has("groom"),
                   .originPrims = options_.usesGroomPrims};
  extras.widthFactors.assign(scene_.widthFactors.begin(), scene_.widthFactors.end());
  if (hairs_ && !extras.widthFactors.empty()) {
    extras.widthFactors.clear();
    for (const std::uint32_t strand : hairs_->strandOf())
      extras.widthFactors.push_back(scene_.widthFactors[strand]);
  }
  if (options_.tipWidth)
    extras.tipDiameter = static_cast<float>(*options_.tipWidth / scene_.groom.metresPerUnit);
  return extras;
}

Status Writers::addFrame(int frame, std::vector<Vec3f> points, const HeadPose& head,
                         std::span<const BodyPose> bodies) {
  if (!isOpen_) {
    if (Status opened = open(); !opened) return opened;
  }
  if (sheet_) sheet_->offer(frame, points, placesOf(bodies), cuts_.cutBeyond(frame, scene_.groom.firstPoint));
  lastPoints_ = std::move(points);
  const UsdTransform place = rigidTransform(head.rotation, head.position / scene_.groom.metresPerUnit);
  if (hairs_ && !animations_.empty()) {
    const double seconds = frames_.secondsAt(frame);
    hairs_->follow(lastPoints_, bodies, hairs_->rootsAt(seconds, scene_.motion.poseAt(seconds)));
  }
  const std::vector<Vec3f>& shown = hairs_ ? hairs_->groom().points : lastPoints_;
  for (const auto& animation : animations_) {
    if (Status added = animation->addFrame(shown, place); !added) return added;
  }
  return {};
}

Status Writers::sync() {
  for (const auto& animation : animations_) {
    if (Status done = animation->sync(); !done) return done;
  }
  return {};
}

void Writers::archive(Archive& archive) {
  if (sheet_) sheet_->archive(archive);
}

Result<std::vector<std::filesystem::path>> Writers::finish() {
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

std::optional<double> Writers::errorBound() const {
  std::optional<double> largest;
  for (const auto& animation : animations_) largest = std::max(largest, animation->errorBound());
  return largest;
}

std::vector<std::string> animationsOf(const RunOptions& options) {
  std::vector<std::string> names;
  for (const AnimationFormat& format : animationFormats()) {
    const bool isWritten = format.hasPrecisions
                               ? options.cache.has_value()
                               : std::ranges::count(options.animations, format.extension) > 0;
    if (isWritten) names.push_back(std::string("hair") + format.extension);
  }
  return names;
}

std::vector<std::filesystem::path> outputsOf(const RunOptions& options) {
  std::vector<std::filesystem::path> outputs;
  for (const std::string& name : animationsOf(options)) outputs.push_back(options.folder / name);
  if (options.writesLast) outputs.push_back(options.folder / "last.obj");
  if (options.writesSheet) outputs.push_back(options.folder / "sheet.png");
  return outputs;
}

}  // namespace ringlet::program
