// What stands before the state in a simulation's checkpoint, so that damaged bytes and those of other hair
// are refused before anything is changed:
//
//   magic 8 | checksum of all that follows 8 | of the hair 8 | of its cuts 8 | bodies 8 | state
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ringlet/base/result.h"

namespace ringlet {

/// What a checkpoint is of.
struct CheckpointOwner {
  std::uint64_t hair = 0;  // HairAsset::Implementation::fingerprint
  std::uint64_t cuts = 0;  // likewise
  std::uint64_t bodies = 0;
};

inline constexpr std::size_t kCheckpointGuardBytes = 40;
/// Fills in the first kCheckpointGuardBytes of what will be a checkpoint.
void guardCheckpoint(std::span<std::byte> checkpoint, const CheckpointOwner& owner);
/// The state in it. Errors: damaged, or of other hair.
Result<std::span<const std::byte>> stateOfCheckpoint(std::span<const std::byte> checkpoint,
                                                     const CheckpointOwner& owner);

}  // namespace ringlet
