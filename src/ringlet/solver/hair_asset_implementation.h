// What a HairAsset holds, for the files that implement it and simulations of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "ringlet/rest/goal.h"
#include "ringlet/rest/goal_units.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_halo.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/solver/features.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/inputs/head_places.h"
#include "ringlet/solver/plan/groom_chunks.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/strands/device_groom.h"
#include "ringlet/solver/strands/frame_readback.h"

namespace ringlet {

/// What of an asset depends on the features that its hair uses.
struct FeaturePlan {
  Features features;
  std::vector<StrandRange> ranges{};
  std::vector<StrandRange> firstRanges{};  // of the first solve of a step, if that has kernels of its own
  std::uint32_t groupSize = 0;             // workgroup size of strand kernels
  std::vector<GoalUnit> goalUnits{};       // with goals, of each particle, device order
};

/// Those that were asked for; for any thread.
struct FeaturePlans {
  std::mutex guard;
  std::map<Features, std::shared_ptr<const FeaturePlan>> made;
};

/// Whether hair with these settings can be divided (KernelChoice::part, link): no feature may need all of its
/// strands, and contacts need a link.
Status checkPart(const Settings& settings, const PartLink* link);

struct HairAsset::Implementation {
  ComputeDevice device;
  Material material;
  Settings settings;
  KernelChoice choice;
  DeviceLimits limits;                     // of the device, with the chosen subgroup width
  RestState rest{};                        // without its particles, which are on the device
  std::optional<RestHalo> halo{};          // of divided hair with contacts
  std::optional<RestContacts> contacts{};  // with contacts
  std::optional<RestVolume> volume{};      // if some strands meet as a volume
  std::vector<ShapeCost> measured{};       // choice.measured
  GroomRecords records{};
  std::vector<GroomChunk> chunks{};
  std::vector<ConstantChunk> constants{};
  FramePlaces framePlaces{};
  std::shared_ptr<HeadPlaces> places{};   // of many small heads; none: each has its own buffers
  std::optional<GroomGoal> goal{};        // where Settings::goal is on
  std::unique_ptr<FeaturePlans> plans{};  // never null

  /// With these features. Fails, with advice, where the settings have none of them, or a step is too long for
  /// the device.
  Result<std::shared_ptr<const FeaturePlan>> plan(const Features& features) const;

  /// Of rest state, settings, material, choice, device, driver and version: what a checkpoint of its hair
  /// depends on.
  std::uint64_t fingerprint() const;
  ContactKinds kinds() const { return contacts ? contacts->kinds : ContactKinds{}; }
  /// Of the inputs of a simulation with this plan.
  InputSource inputSource(const FeaturePlan& plan, const InitialState& initial,
                          const std::optional<HeadPlace>& place) const;

 private:
  friend class HairAsset;
  Result<FeaturePlan> makePlan(const Features& features) const;
  Status makeConstants();
};

}  // namespace ringlet
