// Implements run/scene_run.h.
#include "ringlet/run/scene_run.h"

#include <cmath>

namespace ringlet {
namespace {

double startSeconds(const LoadedScene& scene) {
  return -preRollFrames(scene) / scene.settings.framesPerSecond;
}

Status makeCuts(const LoadedScene& scene, Simulation& hair, int frame) {
  const bool isFirst = frame == -preRollFrames(scene);
  for (const TimedCuts& now : cutsOfFrame(scene.cuts, frame, scene.settings.framesPerSecond, isFirst)) {
    if (Status status = hair.cut(now.cuts); !status) return status;
  }
  return {};
}

// The numbers that keys give the frame.
Status takeNumbers(const LoadedScene& scene, Simulation& hair, int frame) {
  if (!scene.keys) return {};
  const auto numbers =
      scene.keys->at((frame + 1) / scene.settings.framesPerSecond, scene.settings.stepsPerFrame);
  if (!numbers) return numbers.error();
  if (Status status = hair.setSettings(numbers->settings); !status) return status;
  return hair.setMaterial(numbers->material);
}

Status takeForces(const LoadedScene& scene, Simulation& hair, int frame) {
  const double framesPerSecond = scene.settings.framesPerSecond;
  const auto forces = scene.forces.inFrame(frame / framesPerSecond, (frame + 1) / framesPerSecond,
                                           scene.motion, scene.settings, scene.keys ? &*scene.keys : nullptr);
  return forces ? forces->set(hair) : forces.error();
}

}  // namespace

// Times are exact quotients, so they do not drift.
SceneFrame frameOf(const LoadedScene& scene, int frame) {
  const Settings& settings = scene.settings;
  SceneFrame poses;
  std::vector<double> times;
  for (int step = 1; step <= settings.stepsPerFrame; ++step) {
    const double steps = static_cast<double>(frame) * settings.stepsPerFrame + step;
    times.push_back(steps / (settings.framesPerSecond * settings.stepsPerFrame));
    poses.heads.push_back(scene.motion.poseAt(times.back()));
    if (!scene.scalp) continue;
    const std::vector<BodyPose> roots = scene.scalp->rootPosesAt(times.back());
    poses.roots.insert(poses.roots.end(), roots.begin(), roots.end());
  }
  poses.bodies = bodyPosesOf(scene.bodies, poses.heads, times);
  return poses;
}

int preRollFrames(const LoadedScene& scene) {
  return static_cast<int>(std::ceil(scene.preRollSeconds * scene.settings.framesPerSecond - 1e-6));
}

KernelChoice kernelOf(const LoadedScene& scene, KernelChoice kernel) {
  kernel.movingRoots = kernel.movingRoots || scene.scalp.has_value();
  kernel.goals = kernel.goals || scene.forces.haveGoals();
  kernel.fields = kernel.fields || scene.forces.haveFields();
  return kernel;
}

Result<HairAsset> buildAsset(const ComputeDevice& device, const LoadedScene& scene,
                             const KernelChoice& kernel) {
  return HairAsset::build(device, scene.groom, scene.material, scene.settings, kernelOf(scene, kernel),
                          scene.bodies.empty() ? BodyUse::none : BodyUse::some);
}

SceneStart::SceneStart(const LoadedScene& scene) {
  const double start = startSeconds(scene), earlier = start - scene.settings.stepSeconds();
  head_ = scene.motion.poseAt(start);
  oneStepEarlier_ = scene.motion.poseAt(earlier);
  bodies_ = bodyPosesOf(scene.bodies, std::span(&head_, 1), std::span(&start, 1));
  if (scene.scalp)
    roots_ = scene.scalp->rootPosesAt(start), rootsEarlier_ = scene.scalp->rootPosesAt(earlier);
}

InitialState SceneStart::state(const LoadedScene& scene) const {
  return {.head = head_,
          .oneStepEarlier = oneStepEarlier_,
          .bodies = scene.bodies,
          .bodyPlaces = bodies_,
          .roots = roots_,
          .rootsEarlier = rootsEarlier_,
          .rootShifts = scene.rootShifts};
}

Status prepareFrame(const LoadedScene& scene, Simulation& hair, int frame) {
  if (Status status = makeCuts(scene, hair, frame); !status) return status;
  if (Status status = takeNumbers(scene, hair, frame); !status) return status;
  return takeForces(scene, hair, frame);
}

Status stepScene(const LoadedScene& scene, Simulation& hair, int frame) {
  if (Status status = prepareFrame(scene, hair, frame); !status) return status;
  const SceneFrame poses = frameOf(scene, frame);
  return hair.stepFrame(poses.heads, poses.bodies, poses.roots);
}

}  // namespace ringlet
