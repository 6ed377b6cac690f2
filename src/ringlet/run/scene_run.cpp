// Implements run/scene_run.h.
#include "ringlet/run/scene_run.h"

#include <utility>

#include "ringlet/run/scene_hair.h"
#include "ringlet/scenes/load/shot_start.h"

namespace ringlet {
namespace {

// Adapts a Simulation to takeChange.
struct Changeable {
  Simulation& hair;
  Status cut(std::span<const StrandCut> cuts) { return hair.cut(cuts); }
  Status setNumbers(const Settings& settings, const Material& material) {
    if (Status set = hair.setSettings(settings); !set) return set;
    return hair.setMaterial(material);
  }
};

}  // namespace

Features featuresOf(const LoadedScene& scene) {
  return {.bodies = !scene.bodies.empty(),
          .roots = scene.scalp.has_value(),
          .goals = scene.forces.haveGoals(),
          .fields = scene.forces.haveFields()};
}

KernelChoice kernelOf(const LoadedScene& scene, KernelChoice kernel) {
  kernel.features = kernel.features | featuresOf(scene);
  return kernel;
}

Result<HairAsset> buildAsset(const ComputeDevice& device, const LoadedScene& scene,
                             const KernelChoice& kernel) {
  return HairAsset::build(device, scene.groom, scene.material, scene.settings, kernelOf(scene, kernel));
}

InitialState stateOf(const ScenePlaces& places, const LoadedScene& scene) {
  return {.head = places.head,
          .oneStepEarlier = places.headEarlier,
          .bodies = scene.bodies,
          .bodyPlaces = places.bodies,
          .roots = places.roots,
          .rootsEarlier = places.rootsEarlier,
          .rootShifts = scene.rootShifts};
}

HairState startOf(HairState atRest, const ScenePlaces& places, const LoadedScene& scene) {
  const ShotStart& start = *scene.start;
  const Quatd head = places.head.rotation, turn = places.headEarlier.rotation * head.conjugate();
  const double step = scene.settings.stepSeconds();
  const Groom& groom = scene.groom;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::uint32_t first = groom.firstPoint[s];
    const Vec3d root(atRest.positions[first]);
    for (auto i = first + static_cast<std::uint32_t>(scene.settings.rootCount); i < groom.firstPoint[s + 1];
         ++i) {
      const Vec3d place = root + rotate(head, Vec3d(start.offsets[i]));
      atRest.positions[i] = Vec3f(place);
      atRest.velocities[i] =
          Vec3f((place - rotate(turn, place)) * (1 / step) + rotate(head, Vec3d(start.velocities[i])));
    }
  }
  return atRest;
}

Status beginShot(const ScenePlaces& places, const LoadedScene& scene, Simulation& hair) {
  if (!scene.start) return {};
  auto atRest = hair.state();
  if (!atRest) return atRest.error();
  return hair.setState(startOf(std::move(*atRest), places, scene));
}

Status prepare(const SceneFrame& frame, Simulation& hair, bool isStepByStep) {
  Changeable changeable{hair};
  if (Status taken = takeChange(frame.change, isStepByStep, changeable); !taken) return taken;
  return frame.forces.set(hair);
}

Status catchUp(const SceneFrames& frames, int frame, Simulation& hair, bool isStepByStep) {
  Changeable changeable{hair};
  return takeChangesBefore(frames, frame, isStepByStep, changeable);
}

Status stepScene(const SceneFrames& frames, Simulation& hair, int frame) {
  const auto now = frames.at(frame);
  if (!now) return now.error();
  if (Status prepared = prepare(*now, hair); !prepared) return prepared;
  return hair.stepFrame(now->heads, now->bodies, now->roots, now->bodyPoints());
}

}  // namespace ringlet
