// Implements solver/inputs/frame_input.h.
#include "ringlet/solver/inputs/frame_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ringlet {

using gpu::Buffer;
using gpu::BufferKind;

Result<FrameInput> FrameInput::create(gpu::Device& device, std::uint64_t bytes, std::size_t slots,
                                      const std::string& name) {
  auto seen = Buffer::create(device, bytes, BufferKind::storage, name);
  if (!seen) return seen.error();
  return create(device, std::move(*seen), slots, name);
}

Result<FrameInput> FrameInput::create(gpu::Device& device, gpu::Buffer seen, std::size_t slots,
                                      const std::string& name) {
  FrameInput input(std::move(seen));
  for (std::size_t slot = 0; slot < slots; ++slot) {
    auto written = Buffer::create(device, input.bytes(), BufferKind::stream,
                                  fmt::format("{} of frame slot {}", name, slot));
    if (!written) return written.error();
    input.written_.push_back(std::move(*written));
  }
  return input;
}

std::uint64_t largestOf(std::span<const FrameInput> inputs) {
  std::uint64_t largest = 0;
  for (const FrameInput& input : inputs) largest = std::max(largest, input.bytes());
  return largest;
}
std::uint64_t bytesOf(std::span<const FrameInput> inputs) {
  std::uint64_t bytes = 0;
  for (const FrameInput& input : inputs) bytes += input.bytes();
  return bytes;
}
std::uint64_t writtenBytesOf(std::span<const FrameInput> inputs) {
  std::uint64_t bytes = 0;
  for (const FrameInput& input : inputs) bytes += input.writtenBytes();
  return bytes;
}

}  // namespace ringlet
