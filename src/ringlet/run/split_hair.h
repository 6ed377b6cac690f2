// SplitHair: the strands of a groom in parts, each on a device; each strand has the bits that it has on one.
// Where strands meet, parts are stepped at the same time and hand each other what they do
// (solver/part_link.h).
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

using StrandParts = std::vector<std::vector<std::uint32_t>>;  // strands of each

struct HairPart {
  std::unique_ptr<SceneHair> hair;
  std::vector<std::uint32_t> strands;
};
using PartLinks = std::vector<std::unique_ptr<PartLink>>;

/// A part on a device; `link`: where strands meet.
Result<std::unique_ptr<SceneHair>> makeHairPart(const SceneHairInput& input, DeviceHairChoice choice,
                                                std::span<const std::uint32_t> strands, PartLink* link);
/// All of them as one. The links are the parts'.
std::unique_ptr<SceneHair> joinParts(PartLinks links, std::vector<HairPart> parts, const Groom& groom);

/// `choices`: a device each; one may be there twice. Errors: what HairAsset::build says of hair that cannot
/// be divided.
Result<std::unique_ptr<SceneHair>> makeSplitHair(const SceneHairInput& input, const StrandParts& parts,
                                                 std::vector<DeviceHairChoice> choices);

}  // namespace ringlet
