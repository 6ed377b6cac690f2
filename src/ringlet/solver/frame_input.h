// FrameInput: what the host says anew for every frame. Kernels see one buffer; each frame in flight has a
// copy of its own in the host's memory, which it begins by taking over: so the host writes the next frame's
// while the device still reads this one's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"

namespace ringlet {

class FrameInput {
 public:
  /// For `slots` frames in flight. No bytes are fine.
  static Result<FrameInput> create(gpu::Device& device, std::uint64_t bytes, std::size_t slots,
                                   const std::string& name);
  /// Kernels are to see `seen`.
  static Result<FrameInput> create(gpu::Device& device, gpu::Buffer seen, std::size_t slots,
                                   const std::string& name);

  /// What kernels see.
  const gpu::Buffer& seen() const { return seen_; }
  std::uint64_t bytes() const { return seen_.bytes(); }
  /// Of all frames' copies.
  std::uint64_t writtenBytes() const { return written_.size() * seen_.bytes(); }
  /// What the host writes for the frame of this slot, while that is not submitted.
  template <class T>
  std::span<T> of(std::size_t slot) const {
    const auto bytes = written_[slot].mapped();
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
  /// Takes it over, at the frame's start; a barrier must follow.
  void record(gpu::CommandList& list, std::size_t slot) const {
    list.copyBuffer(written_[slot], seen_, seen_.bytes());
  }

 private:
  explicit FrameInput(gpu::Buffer seen) : seen_(std::move(seen)) {}

  gpu::Buffer seen_;
  std::vector<gpu::Buffer> written_;  // by slot
};

/// Of one input for each chunk of a groom.
std::uint64_t largestOf(std::span<const FrameInput> inputs);
std::uint64_t bytesOf(std::span<const FrameInput> inputs);
std::uint64_t writtenBytesOf(std::span<const FrameInput> inputs);

}  // namespace ringlet
