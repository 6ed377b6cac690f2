// The members of a HairAsset, for the files that implement it and for its simulations.
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

/// The part of an asset that depends on the features its hair uses.
struct FeaturePlan {
  Features features;
  std::vector<StrandRange> ranges{};
  std::vector<StrandRange> firstRanges{};  // for the first solve of a step, if it has kernels of its own
  std::uint32_t groupSize = 0;             // workgroup size of strand kernels
  std::vector<GoalUnit> goalUnits{};       // with goals, of each particle, device order
};

/// The plans asked for so far. Thread-safe.
struct FeaturePlans {
  std::mutex guard;
  std::map<Features, std::shared_ptr<const FeaturePlan>> made;
};

/// Fails if hair with these settings cannot be divided (KernelChoice::part, link): because a feature needs
/// all of its strands, or because contacts have no link.
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
  std::optional<RestVolume> volume{};      // if some strands are in contact as a volume
  std::vector<ShapeCost> measured{};       // choice.measured
  GroomRecords records{};
  std::vector<GroomChunk> chunks{};
  std::vector<ConstantChunk> constants{};
  FramePlaces framePlaces{};
  std::shared_ptr<HeadPlaces> places{};   // of many small heads; none: each has its own buffers
  std::optional<GroomGoal> goal{};        // if Settings::goal is on
  std::unique_ptr<FeaturePlans> plans{};  // never null

  /// The plan for these features. Fails, with advice, where the settings do not allow them, or where a step
  /// is too long for the device.
  Result<std::shared_ptr<const FeaturePlan>> plan(const Features& features) const;

  /// A hash of rest state, settings, material, choice, device, driver and version: all that a checkpoint of
  /// its hair depends on.
  std::uint64_t fingerprint() const;
  ContactKinds kinds() const { return contacts ? contacts->kinds : ContactKinds{}; }
  /// What the inputs of a simulation with this plan are made from.
  InputSource inputSource(const FeaturePlan& plan, const InitialState& initial,
                          const std::optional<HeadPlace>& place) const;

 private:
  friend class HairAsset;
  Result<FeaturePlan> makePlan(const Features& features) const;
  Status makeConstants();
};

}  // namespace ringlet
