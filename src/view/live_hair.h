// LiveHair: hair of one material that is simulated while its numbers change. What the solver takes between
// frames it takes; for all else the hair is built anew where it is.
#pragma once

#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/simulation.h"
#include "view/edits.h"

namespace ringlet::view {

/// Where everything that moves by itself is at a moment, and was one step before.
struct Standing {
  HeadPose head, headEarlier;
  std::vector<BodyPose> bodies;
  std::vector<BodyPose> roots, rootsEarlier;  // of a scene with a scalp
};

class LiveHair {
 public:
  /// At rest. `scene` and `device` must live as long. Errors: HairAsset::build's and Simulation::create's.
  static Result<LiveHair> create(const ComputeDevice& device, const LoadedScene& scene,
                                 const HairNumbers& numbers, const Standing& standing);

  enum class Change { none, live, rebuilt };
  /// Fails without a change where the solver refuses the numbers.
  Result<Change> setNumbers(const HairNumbers& numbers, const Standing& standing);
  /// At rest again.
  Status reset(const Standing& standing);

  const HairNumbers& numbers() const { return numbers_; }
  Simulation& simulation() { return *hair_; }
  const Simulation& simulation() const { return *hair_; }

 private:
  LiveHair(const ComputeDevice& device, const LoadedScene& scene, const HairNumbers& numbers)
      : device_(&device), scene_(&scene), numbers_(numbers), built_(numbers) {}
  bool canTake(const HairNumbers& numbers) const;
  Status build(const Standing& standing);
  Status place(const Standing& standing);

  const ComputeDevice* device_;
  const LoadedScene* scene_;
  HairNumbers numbers_;
  HairNumbers built_;  // those of the asset
  std::optional<HairAsset> asset_;
  std::optional<Simulation> hair_;
};

}  // namespace ringlet::view
