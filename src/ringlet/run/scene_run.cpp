// Implements run/scene_run.h.
#include "ringlet/run/scene_run.h"

#include "ringlet/run/scene_hair.h"

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
