// Implements solver/inputs/frame_input.h.
#include "ringlet/solver/inputs/frame_input.h"

#include <algorithm>
#include <utility>

#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/inputs/frame_inputs.h"

namespace ringlet {

Status FrameInput::stage(const InputSource& from, std::uint64_t bytes, const char* name) {
  auto made = StagedBuffer::create(from.device, bytes, from.slots, name);
  if (!made) return made.error();
  staged_.push_back(std::move(*made));
  return {};
}

std::uint64_t FrameInput::largestBuffer() const {
  std::uint64_t largest = 0;
  for (const StagedBuffer& staged : staged_) largest = std::max(largest, staged.bytes());
  return largest;
}
std::uint64_t FrameInput::bytes() const {
  std::uint64_t bytes = 0;
  for (const StagedBuffer& staged : staged_) bytes += staged.bytes();
  return bytes;
}
std::uint64_t FrameInput::writtenBytes() const {
  std::uint64_t bytes = 0;
  for (const StagedBuffer& staged : staged_) bytes += staged.writtenBytes();
  return bytes;
}
std::uint64_t DeviceMemory::*FrameInput::kind() const { return &DeviceMemory::world; }
void FrameInput::addTo(DeviceMemory& memory) const {
  memory.*kind() += bytes();
  memory.frames += writtenBytes();
}

}  // namespace ringlet
