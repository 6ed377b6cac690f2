// The header of a simulation's checkpoint. It lets damaged bytes, and those of other hair, be refused before
// anything is changed:
//
//   magic 8 | checksum of all that follows 8 | hair 8 | cuts 8 | bodies 8 | state
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ringlet/base/result.h"

namespace ringlet {

/// What a checkpoint belongs to, as hashes.
struct CheckpointOwner {
  std::uint64_t hair = 0;  // HairAsset::Implementation::fingerprint
  std::uint64_t cuts = 0;  // of the strands' cuts
  std::uint64_t bodies = 0;
};

inline constexpr std::size_t kCheckpointGuardBytes = 40;
/// Fills in the first kCheckpointGuardBytes of a complete checkpoint.
void guardCheckpoint(std::span<std::byte> checkpoint, const CheckpointOwner& owner);
/// The state within a checkpoint. Fails if it is damaged or of other hair.
Result<std::span<const std::byte>> stateOfCheckpoint(std::span<const std::byte> checkpoint,
                                                     const CheckpointOwner& owner);

}  // namespace ringlet
