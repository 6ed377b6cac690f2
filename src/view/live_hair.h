// LiveHair: hair of one material that is simulated while its numbers change. What the solver takes between
// frames it takes; for all else the hair is built anew where it is.
#pragma once

#include <optional>

#include "ringlet/base/result.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/simulation.h"
#include "view/edits.h"

namespace ringlet::view {

/// Between two frames of a scene.
struct SceneMoment {
  const SceneFrames& frames;
  int frame = 0;             // that comes next
  SceneDrags dragsBefore{};  // of the frame before
};

class LiveHair {
 public:
  /// At rest, cut as it is by now. `scene` and `device` must live as long. Errors: HairAsset::build's and
  /// Simulation::create's.
  static Result<LiveHair> create(const ComputeDevice& device, const LoadedScene& scene,
                                 const HairNumbers& numbers, const SceneMoment& now);

  enum class Change { none, live, rebuilt };
  /// Fails without a change where the solver refuses the numbers.
  Result<Change> setNumbers(const HairNumbers& numbers, const SceneMoment& now);
  /// At rest again.
  Status reset(const SceneMoment& now);

  const HairNumbers& numbers() const { return numbers_; }
  Simulation& simulation() { return *hair_; }
  const Simulation& simulation() const { return *hair_; }

 private:
  LiveHair(const ComputeDevice& device, const LoadedScene& scene, const HairNumbers& numbers)
      : device_(&device), scene_(&scene), numbers_(numbers), built_(numbers) {}
  bool canTake(const HairNumbers& numbers) const;
  Status build(const SceneMoment& now);
  Status place(const SceneMoment& now);

  const ComputeDevice* device_;
  const LoadedScene* scene_;
  HairNumbers numbers_;
  HairNumbers built_;  // those of the asset
  std::optional<HairAsset> asset_;
  std::optional<Simulation> hair_;
};

}  // namespace ringlet::view
