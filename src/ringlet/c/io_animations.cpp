// Implements c/ringlet_io.h: animations.
#include <fmt/format.h>

#include <cmath>

#include "ringlet/c/io_handles.h"
#include "ringlet/c/poses.h"
#include "ringlet/output/finite_points.h"

namespace ringlet::c {
namespace {

constexpr std::uint32_t kMostFrames = 1'000'000;
constexpr double kWidth = 0.0005;           // [m]
constexpr NumberRange kAbove{1e-12, 1e12};  // of what is above 0
constexpr NumberRange kWidths{1e-9, 1};     // [m]

// 0 stands for the standard.
Outcome take(const char* name, double number, double standard, const NumberRange& range, double& taken) {
  taken = number == 0 ? standard : number;
  if (range.contains(taken)) return {};
  return Outcome::invalid(fmt::format("{} is {}; it takes {} to {}", name, number, range.low, range.high));
}

Outcome optionsOf(const ringlet_animation_options& from, const AnimationFormat* format, double groomUnit,
                  AnimationOptions& options) {
  double width = 0, tipWidth = 0;
  if (Outcome o =
          take("frames_per_second", from.frames_per_second, 24, {0.001, 1e6}, options.framesPerSecond);
      !o.isFine())
    return o;
  if (Outcome o = take("metres_per_unit", from.metres_per_unit, groomUnit, kAbove, options.metresPerUnit);
      !o.isFine())
    return o;
  if (Outcome o = take("width", from.width, kWidth, kWidths, width); !o.isFine()) return o;
  if (Outcome o = take("tip_width", from.tip_width, width, kWidths, tipWidth); !o.isFine()) return o;
  if (from.frame_count > kMostFrames)
    return Outcome::invalid(
        fmt::format("frame_count is {}; it takes at most {}", from.frame_count, kMostFrames));
  if (from.tip_width != 0 && format && !format->hasValues)
    return Outcome::invalid(
        fmt::format("tip_width is of {}", animationEndings(&AnimationFormat::hasValues, "and")));
  options.up = from.up_is_z ? UpAxis::z : UpAxis::y;
  options.diameter = static_cast<float>(width / options.metresPerUnit);
  if (from.tip_width != 0) options.usd.tipDiameter = static_cast<float>(tipWidth / options.metresPerUnit);
  options.frameCount = from.frame_count == 0 ? 1000 : static_cast<int>(from.frame_count);
  options.precision = from.sixteen_bits ? CachePrecision::bits16 : CachePrecision::float32;
  return {};
}

// Positions that are seen from the head, into the world and the file's unit.
Outcome add(ringlet_animation& animation, std::vector<Vec3f> points, const HeadPose& head) {
  if (!animation.writer) return Outcome::invalid(fmt::format("{} is finished", animation.path.string()));
  if (points.size() != animation.particleCount)
    return Outcome::invalid(fmt::format("a frame of {} has {} particles; found {}", animation.path.string(),
                                        animation.particleCount, points.size()));
  if (animation.writer->frameCount() >= static_cast<int>(animation.mostFrames))
    return Outcome::invalid(fmt::format("{} was made for {} frames, and has them: say more as frame_count",
                                        animation.path.string(), animation.mostFrames));
  for (Vec3f& p : points) p = static_cast<Vec3f>((head.position + Vec3d(p)) / animation.metresPerUnit);
  if (!areFinite(points))
    return Outcome::invalid(
        fmt::format("a frame of {} has positions that are not finite", animation.path.string()));
  return animation.writer->addFrame(points,
                                    rigidTransform(head.rotation, head.position / animation.metresPerUnit));
}

}  // namespace
}  // namespace ringlet::c

using namespace ringlet;
using namespace ringlet::c;

ringlet_result ringlet_animation_create(const char* path, const ringlet_groom* groom,
                                        const ringlet_animation_options* options,
                                        ringlet_animation** animation) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_animation_create takes a path, a groom, options and a place for it",
                           {given("path", path), sized("groom", groom), sizedOrNull("options", options),
                            given("animation", animation)});
        !wrong.isFine())
      return wrong;
    Groom topology;
    if (Outcome wrong = takeGroom(taken(groom), topology); !wrong.isFine()) return wrong;
    if (Outcome wrong = checkStrands(topology); !wrong.isFine()) return wrong;
    AnimationOptions chosen;
    if (Outcome wrong = optionsOf(taken(options), animationFormatOf(path), topology.metresPerUnit, chosen);
        !wrong.isFine())
      return wrong;
    auto writer = createAnimation(path, topology, chosen);
    if (!writer) return writer.error();
    *animation = new ringlet_animation{path, std::move(*writer), topology.points.size(),
                                       static_cast<std::uint32_t>(chosen.frameCount), chosen.metresPerUnit};
    return {};
  });
}

ringlet_result ringlet_animation_add(ringlet_animation* animation, const float* xyz, uint64_t particle_count,
                                     const ringlet_pose* head) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_animation_add takes an animation and positions",
                                       {given("animation", animation), given("xyz", xyz)});
        !wrong.isFine())
      return wrong;
    const auto pose = poseOf<HeadPose>(head ? *head : ringlet_pose{});
    if (!pose) return notFinite("the head");
    // A wrong number is refused before so many are read.
    const bool fits = particle_count == animation->particleCount;
    std::vector<Vec3f> points(fits ? static_cast<std::size_t>(particle_count) : 0);
    for (Vec3f& p : points) p = {xyz[0], xyz[1], xyz[2]}, xyz += 3;
    return add(*animation, std::move(points), *pose);
  });
}

ringlet_result ringlet_animation_add_hair(ringlet_animation* animation, const ringlet_hair* hair) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_animation_add_hair takes an animation and hair",
                                       {given("animation", animation), given("hair", hair)});
        !wrong.isFine())
      return wrong;
    if (Outcome outcome = checkFree(*hair); !outcome.isFine()) return outcome;
    auto positions = hair->simulation.positions();
    if (!positions) return positions.error();
    return add(*animation, std::move(*positions), hair->simulation.head());
  });
}

ringlet_result ringlet_animation_finish(ringlet_animation* animation) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong =
            checkArguments("ringlet_animation_finish takes an animation", {given("animation", animation)});
        !wrong.isFine())
      return wrong;
    if (!animation->writer) return Outcome::invalid(fmt::format("{} is finished", animation->path.string()));
    if (animation->writer->frameCount() == 0)
      return Outcome::invalid(
          fmt::format("{} has no frame; add one before it is finished", animation->path.string()));
    if (Status finished = animation->writer->finish(); !finished) return finished;
    animation->writer.reset();
    return {};
  });
}

void ringlet_animation_release(ringlet_animation* animation) { delete animation; }

ringlet_result ringlet_frames_open(const char* path, ringlet_warn warn, void* user, ringlet_frames** frames) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_frames_open takes a path and a place for the frames",
                                       {given("path", path), given("frames", frames)});
        !wrong.isFine())
      return wrong;
    auto reader = AnimationReader::open(path);
    if (!reader) return reader.error();
    warnOf(reader->warnings(), warn, user);
    *frames = new ringlet_frames{std::move(*reader)};
    return {};
  });
}

ringlet_result ringlet_frames_get(const ringlet_frames* frames, ringlet_frames_facts* facts) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_frames_get takes frames and facts to fill",
                                       {given("frames", frames), sized("facts", facts)});
        !wrong.isFine())
      return wrong;
    const AnimationReader& of = frames->reader;
    give(facts, {.struct_size = 0,
                 .frames_per_second = of.header().framesPerSecond,
                 .metres_per_unit = of.header().metresPerUnit,
                 .up_is_z = of.header().up == UpAxis::z,
                 .is_finished = of.isFinished(),
                 .frame_count = static_cast<uint32_t>(of.frameCount()),
                 .strand_count = static_cast<uint32_t>(of.groom().strandCount()),
                 .particle_count = of.groom().firstPoint.back()});
    return {};
  });
}

ringlet_result ringlet_frames_next(ringlet_frames* frames, float* xyz, uint64_t particle_count) {
  return guarded([&]() -> Outcome {
    if (Outcome wrong = checkArguments("ringlet_frames_next takes frames and room for positions",
                                       {given("frames", frames), given("xyz", xyz)});
        !wrong.isFine())
      return wrong;
    AnimationReader& reader = frames->reader;
    if (particle_count != reader.groom().firstPoint.back())
      return Outcome::invalid(fmt::format("there is room for {} particles, and a frame has {}",
                                          particle_count, reader.groom().firstPoint.back()));
    if (frames->latest == reader.frameCount())
      return Outcome::invalid(fmt::format("there are {} frames, and all were read", reader.frameCount()));
    if (Status read = reader.readFrame(frames->latest + 1); !read) return read;
    ++frames->latest;
    for (const Vec3f& p : reader.groom().points) *xyz++ = p.x, *xyz++ = p.y, *xyz++ = p.z;
    return {};
  });
}

void ringlet_frames_release(ringlet_frames* frames) { delete frames; }
