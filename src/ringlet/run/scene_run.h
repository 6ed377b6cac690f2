// Steps a loaded scene on a Simulation, frame by frame. For hosts that step a scene themselves, in C++, C and
// Python:
//
//   const SceneFrames frames(scene);
//   const ScenePlaces start = frames.placesAt(frames.first());
//   auto hair = Simulation::create(*buildAsset(device, scene), stateOf(start, scene));
//   for (int frame = frames.first(); frame < scene.frameCount; ++frame) stepScene(frames, *hair, frame);
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/kernel_choice.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// The features that a scene's hair needs in any of its frames.
Features featuresOf(const LoadedScene& scene);

/// `kernel` with the scene's features added.
KernelChoice kernelOf(const LoadedScene& scene, KernelChoice kernel = {});
/// HairAsset::build of the scene's groom, material and settings.
Result<HairAsset> buildAsset(const ComputeDevice& device, const LoadedScene& scene,
                             const KernelChoice& kernel = {});

/// The state of the scene's hair at these places, at rest. Refers to both arguments.
InitialState stateOf(const ScenePlaces& places, const LoadedScene& scene);

/// Hair that begins as another run ended (LoadedScene::start, which there is): from its state at rest there.
/// Roots stay where they are, and all moves with the head besides.
HairState startOf(HairState atRest, const ScenePlaces& places, const LoadedScene& scene);
/// Makes hair that was made in stateOf() begin so, where the scene says it.
Status beginShot(const ScenePlaces& places, const LoadedScene& scene, Simulation& hair);

/// Applies a frame's change and forces to the hair before the frame; no frame may be in flight if there is a
/// change. `isStepByStep`: the hair's frames are steps of the scene's frames.
Status prepare(const SceneFrame& frame, Simulation& hair, bool isStepByStep = false);
/// Applies the changes of all frames before this one, which checkpoints do not contain, to hair before it is
/// restored.
Status catchUp(const SceneFrames& frames, int frame, Simulation& hair, bool isStepByStep = false);
/// Gets the frame, then calls prepare and Simulation::stepFrame.
Status stepScene(const SceneFrames& frames, Simulation& hair, int frame);

}  // namespace ringlet
