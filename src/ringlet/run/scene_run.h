// A loaded scene on a simulation, frame by frame. For hosts that step a scene themselves, in C++, C and
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

/// What acts on a scene's hair in some frame.
Features featuresOf(const LoadedScene& scene);

/// `kernel` with the scene's features besides.
KernelChoice kernelOf(const LoadedScene& scene, KernelChoice kernel = {});
/// HairAsset::build of the scene's groom, material and settings.
Result<HairAsset> buildAsset(const ComputeDevice& device, const LoadedScene& scene,
                             const KernelChoice& kernel = {});

/// Hair of the scene that begins there, at rest. Refers to both.
InitialState stateOf(const ScenePlaces& places, const LoadedScene& scene);

/// What a frame changes, and its forces, given to hair before it; none is in flight where there is a change.
/// `isStepByStep`: the hair's frames are steps of the scene's.
Status prepare(const SceneFrame& frame, Simulation& hair, bool isStepByStep = false);
/// What frames before this one changed, of which a checkpoint knows nothing, given to hair that is restored
/// from one.
Status catchUp(const SceneFrames& frames, int frame, Simulation& hair, bool isStepByStep = false);
/// The frame, prepare and Simulation::stepFrame.
Status stepScene(const SceneFrames& frames, Simulation& hair, int frame);

}  // namespace ringlet
