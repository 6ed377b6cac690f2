// A loaded scene on a simulation, frame by frame: where everything is, and what changes between frames. For
// hosts that step a scene themselves, in C++, C and Python:
//
//   SceneStart start(scene);
//   auto hair = Simulation::create(*buildAsset(device, scene), start.state(scene));
//   for (int frame = -preRollFrames(scene); frame < scene.frameCount; ++frame) stepScene(scene, *hair,
//   frame);
#pragma once

#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/kernel_choice.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// Poses at the end of each step of a frame, as Simulation::stepFrame takes them.
struct SceneFrame {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies{}, roots{};  // [step][body], [step][strand]; none: the head carries them
};

/// A host's frame is from -kMostFrame to kMostFrame.
inline constexpr int kMostFrame = 1'000'000;

/// Frame 0 is the first; those of the pre-roll are before it.
SceneFrame frameOf(const LoadedScene& scene, int frame);
/// Frames before the first one, in which hair comes to rest or to speed.
int preRollFrames(const LoadedScene& scene);

/// What an asset of the scene's hair must be built for: `kernel` with what the scene has besides.
KernelChoice kernelOf(const LoadedScene& scene, KernelChoice kernel = {});
/// HairAsset::build of the scene's groom, material and settings.
Result<HairAsset> buildAsset(const ComputeDevice& device, const LoadedScene& scene,
                             const KernelChoice& kernel = {});

/// Where everything is as the pre-roll begins.
class SceneStart {
 public:
  explicit SceneStart(const LoadedScene& scene);
  /// Refers to this and to the scene.
  InitialState state(const LoadedScene& scene) const;

 private:
  HeadPose head_, oneStepEarlier_;
  std::vector<BodyPose> bodies_, roots_, rootsEarlier_;
};

/// What cuts, keys, fields and holds say of a frame, given to hair before it; none is in flight. Errors: of
/// files that are read as time goes on, and of what changes.
Status prepareFrame(const LoadedScene& scene, Simulation& hair, int frame);
/// prepareFrame and Simulation::stepFrame.
Status stepScene(const LoadedScene& scene, Simulation& hair, int frame);

}  // namespace ringlet
