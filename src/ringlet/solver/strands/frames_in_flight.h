// FramesInFlight: which frames of a head are submitted, finished and waited for, and their slots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/strands/frame_slot.h"

namespace ringlet {

/// Frame n has slot n % kFramesInFlight. Frames are submitted to the device, finished by it, then waited for
/// by the caller.
struct FramesInFlight {
  std::uint64_t submitted = 0, finished = 0, waited = 0;
  bool isReadBack = false;      // the positions read back last are those on the device
  std::optional<Error> lost{};  // after this error the state is unknown
  std::vector<FrameSlot> slots{};

  std::size_t slotNumber(std::uint64_t frame) const { return frame % slots.size(); }
  FrameSlot& slotOf(std::uint64_t frame) { return slots[slotNumber(frame)]; }
  bool areAllWaitedFor() const { return waited == submitted; }
  /// Whether positions are copied to host memory after every frame.
  bool readBack() const { return slots.front().readback.has_value(); }
  /// Invalidates recordings.
  void forgetRecordings() {
    for (FrameSlot& slot : slots) slot.recorded = FrameSlot::Recorded::nothing;
  }
  /// Also invalidates positions that were read back.
  void forget() {
    isReadBack = false;
    forgetRecordings();
  }
};

}  // namespace ringlet
