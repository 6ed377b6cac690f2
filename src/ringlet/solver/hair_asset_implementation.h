// What a HairAsset holds, for the files that implement it and simulations of it.
#pragma once

#include <optional>
#include <vector>

#include "ringlet/rest/goal.h"
#include "ringlet/rest/goal_units.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/groom_chunks.h"
#include "ringlet/solver/hair_asset.h"
#include "ringlet/solver/head_places.h"
#include "ringlet/solver/shape_plan.h"

namespace ringlet {

/// Whether hair with these settings may be divided (KernelChoice::part, link): nothing may ask all of its
/// strands, and what couples them takes a link.
Status checkPart(const Settings& settings, const PartLink* link);

struct HairAsset::Implementation {
  ComputeDevice device;
  Material material;
  Settings settings;
  KernelChoice choice;
  BodyUse bodies = BodyUse::none;
  DeviceLimits limits;                   // the device's, with the subgroups that were chosen
  std::uint32_t groupSize = 0;           // of strand kernels
  RestState rest;                        // its particles are on the device
  std::vector<bool> isHere;              // of strands, device order, where others step some; none: all are
  std::optional<RestContacts> contacts;  // with contacts
  std::optional<RestVolume> volume;      // where strands meet as one
  std::vector<StrandRange> ranges;
  std::vector<StrandRange>
      firstRanges;  // as a step's first solve has them, where that has kernels of its own
  GroomRecords records;
  std::vector<ConstantChunk> constants;
  std::shared_ptr<HeadPlaces> places;              // of many small heads; none: each has its own buffers
  std::optional<GroomGoal> goal;                   // where Settings::goal is on
  std::optional<std::vector<GoalUnit>> goalUnits;  // with goals

  ContactKinds kinds() const { return contacts ? contacts->kinds() : ContactKinds{}; }
  std::vector<GroomChunk> chunks() const {
    std::vector<GroomChunk> parts;
    for (const ConstantChunk& chunk : constants) parts.push_back(chunk.part);
    return parts;
  }
};

}  // namespace ringlet
