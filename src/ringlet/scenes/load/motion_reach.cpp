// Implements scenes/load/motion_reach.h.
#include "ringlet/scenes/load/motion_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

constexpr int kFewFrames = 10;  // one cut in so many frames in which the head moves is a cut

// `what` follows the file.
std::optional<std::string> endsEarly(const SceneMotion& stated, const Motion& motion, const std::string& what,
                                     const Settings& settings, int frameCount) {
  if (stated.file.empty() || !motion.keyframes) return std::nullopt;
  const double seconds = motion.keyframes->seconds();
  const double reached = seconds * settings.framesPerSecond + 1e-6;
  if (reached >= frameCount) return std::nullopt;
  const int frames = static_cast<int>(reached);
  return fmt::format(
      "{}: its motion ends after {:.3g} s, at frame {} of the {} of this run; in the other {} {} keeps its "
      "last pose",
      stated.file.string(), seconds, frames, frameCount, frameCount - frames, what);
}

struct Steps {
  int moves = 0, jumps = 0;  // frames
};

Steps stepsOf(const Motion& head, const Settings& settings, int frameCount) {
  Steps steps;
  Vec3d before = head.poseAt(0).position;
  for (int f = 1; f <= frameCount; ++f) {
    const Vec3d now = head.poseAt(f / settings.framesPerSecond).position;
    const double step = length(now - before);
    steps.moves += step > 0 ? 1 : 0;
    steps.jumps += settings.jumps(step) ? 1 : 0;
    before = now;
  }
  return steps;
}

std::string sizeOf(const SceneMotion& stated) {
  if (!stated.file.empty()) return "is the unit of its file right (--motion-unit, unit of [motion])?";
  if (!stated.keys.empty()) return "are the positions of its keys in metres?";
  return "is the amplitude right (--amplitude, amplitude of [motion])?";
}

std::optional<std::string> onlyJumps(const SceneMotion& stated, const Motion& head, const Settings& settings,
                                     int frameCount) {
  const auto [moves, jumps] = stepsOf(head, settings, frameCount);
  const bool isCut = jumps == 1 && frameCount > 1;
  if (jumps == 0 || isCut || jumps * kFewFrames < moves) return std::nullopt;
  return fmt::format(
      "in {} of {} frames the head moves farther than {} m, which counts as a teleport: hair is carried "
      "along and not simulated there; {} Where the head is so fast, a larger teleport_distance of "
      "[simulation], or 0, simulates it",
      jumps, frameCount, settings.teleportDistance, sizeOf(stated));
}

}  // namespace

std::vector<std::string> motionReach(const SceneFile& scene, const Motion& head,
                                     const std::vector<Body>& bodies, const Settings& settings,
                                     int frameCount) {
  RINGLET_ASSERT(bodies.size() == scene.bodies.size(), "every body of the scene is loaded");
  std::vector<std::string> sentences;
  const auto add = [&](std::optional<std::string> sentence) {
    if (sentence) sentences.push_back(std::move(*sentence));
  };
  add(endsEarly(scene.motion, head, "the head", settings, frameCount));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const SceneBody& stated = scene.bodies[b];
    if (stated.moves && bodies[b].motion)
      add(endsEarly(*stated.moves, *bodies[b].motion, "the body " + bodies[b].name, settings, frameCount));
  }
  add(onlyJumps(scene.motion, head, settings, frameCount));
  return sentences;
}

}  // namespace ringlet
