// Implements solver/inputs/staged_buffer.h.
#include "ringlet/solver/inputs/staged_buffer.h"

#include <fmt/format.h>

#include <utility>

namespace ringlet {

using gpu::Buffer;
using gpu::BufferKind;

Result<StagedBuffer> StagedBuffer::create(gpu::Device& device, std::uint64_t bytes, std::size_t slots,
                                          const std::string& name) {
  auto seen = Buffer::create(device, bytes, BufferKind::storage, name);
  if (!seen) return seen.error();
  return create(device, std::move(*seen), slots, name);
}

Result<StagedBuffer> StagedBuffer::create(gpu::Device& device, gpu::Buffer seen, std::size_t slots,
                                          const std::string& name) {
  StagedBuffer staged(std::move(seen));
  for (std::size_t slot = 0; slot < slots; ++slot) {
    auto written = Buffer::create(device, staged.bytes(), BufferKind::stream,
                                  fmt::format("{} of frame slot {}", name, slot));
    if (!written) return written.error();
    staged.written_.push_back(std::move(*written));
  }
  return staged;
}

}  // namespace ringlet
