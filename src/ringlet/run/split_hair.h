// SplitHair: hair whose strands are divided among devices; each strand has the same bits as on a single
// device. With contacts, parts are stepped at the same time and exchange data (solver/part_link.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/device_hair.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/part_link.h"

namespace ringlet {

using StrandParts = std::vector<std::vector<std::uint32_t>>;  // the strands of each part

struct HairPart {
  std::unique_ptr<SceneHair> hair;
  std::vector<std::uint32_t> strands;
};
using PartLinks = std::vector<std::unique_ptr<PartLink>>;

/// One part on a device; `link`: needed with contacts.
Result<std::unique_ptr<SceneHair>> makeHairPart(const SceneHairInput& input, DeviceHairChoice choice,
                                                std::span<const std::uint32_t> strands, PartLink* link);
/// Joins all parts. The links are those of the parts.
std::unique_ptr<SceneHair> joinParts(PartLinks links, std::vector<HairPart> parts, const Groom& groom);

/// `choices`: one device for each part; a device may occur twice. Errors: what HairAsset::build says of hair
/// that cannot be divided.
Result<std::unique_ptr<SceneHair>> makeSplitHair(const SceneHairInput& input, const StrandParts& parts,
                                                 std::vector<DeviceHairChoice> choices);

}  // namespace ringlet
