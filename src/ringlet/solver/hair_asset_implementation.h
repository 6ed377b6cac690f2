// What a HairAsset holds, for the files that implement it and simulations of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ringlet/rest/goal.h"
#include "ringlet/rest/goal_units.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_halo.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/inputs/head_places.h"
#include "ringlet/solver/plan/groom_chunks.h"
#include "ringlet/solver/plan/shape_plan.h"
#include "ringlet/solver/strands/device_groom.h"
#include "ringlet/solver/strands/frame_readback.h"

namespace ringlet {

/// Whether hair with these settings can be divided (KernelChoice::part, link): no feature may need all of its
/// strands, and contacts need a link.
Status checkPart(const Settings& settings, const PartLink* link);

struct HairAsset::Implementation {
  ComputeDevice device;
  Material material;
  Settings settings;
  KernelChoice choice;
  BodyUse bodies = BodyUse::none;
  DeviceLimits limits;                     // of the device, with the chosen subgroup width
  std::uint32_t groupSize = 0;             // workgroup size of strand kernels
  RestState rest{};                        // without its particles, which are on the device
  std::optional<RestHalo> halo{};          // of divided hair with contacts
  std::optional<RestContacts> contacts{};  // with contacts
  std::optional<RestVolume> volume{};      // if some strands meet as a volume
  std::vector<StrandRange> ranges{};
  std::vector<StrandRange> firstRanges{};  // of the first solve of a step, if that has kernels of its own
  GroomRecords records{};
  std::vector<ConstantChunk> constants{};
  FramePlaces framePlaces{};
  std::shared_ptr<HeadPlaces> places{};              // of many small heads; none: each has its own buffers
  std::optional<GroomGoal> goal{};                   // where Settings::goal is on
  std::optional<std::vector<GoalUnit>> goalUnits{};  // with goals

  /// Of rest state, settings, material, choice, device, driver and version: what a checkpoint of its hair
  /// depends on.
  std::uint64_t fingerprint() const;
  ContactKinds kinds() const { return contacts ? contacts->kinds : ContactKinds{}; }
  std::vector<GroomChunk> chunks() const {
    std::vector<GroomChunk> parts;
    for (const ConstantChunk& chunk : constants) parts.push_back(chunk.part);
    return parts;
  }
};

}  // namespace ringlet
