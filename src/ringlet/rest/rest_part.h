// A part of a groom, for hair that is divided among several devices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_halo.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"

namespace ringlet {

/// Whether each of strandCount strands is in `part`. Errors: as restrictTo. Cost: linear.
Result<std::vector<bool>> membersOf(std::span<const std::uint32_t> part, std::size_t strandCount);

/// Keeps the strands `here`, followed by the strands `around` (RestState::haloCount); device order, each
/// listed once. Of the other strands only the rest points are kept (RestState::elsewhere). Members about the
/// whole groom do not change. Cost: linear.
void keepStrands(RestState& state, std::span<const std::uint32_t> here,
                 std::span<const std::uint32_t> around = {});

/// Keeps the simulated strands that are in `part`, groom order. Errors: a strand that the groom does not
/// have, or that is listed twice. Cost: linear.
Status restrictTo(RestState& state, std::span<const std::uint32_t> part);

/// The part of each strand, device order. Errors: as restrictTo; a strand that is in no part or in two.
Result<std::vector<std::size_t>> partOfEach(const std::vector<std::vector<std::uint32_t>>& parts,
                                            const RestState& rest);

/// A whole groom's rest state with contacts.
struct RestHair {
  RestState& state;
  RestContacts& contacts;
  std::optional<RestVolume>& volume;
};
/// Keeps the strands that a part needs according to `halo`, and renumbers the halo. Contact particles stay in
/// the order of the whole groom, since searches list them in this order; firstOfStrand is invalid. For halo
/// strands neither contact pairs nor volume groups are kept. Cost: linear.
void restrictTo(const RestHair& hair, RestHalo& halo);

}  // namespace ringlet
