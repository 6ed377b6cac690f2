// StagedBuffer: a buffer that the host writes for every frame. Kernels read one buffer; each frame in flight
// has its own copy in host memory, and its commands begin by copying that into the kernels' buffer. So the
// host can write the next frame's data while the device still reads this frame's.
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

class StagedBuffer {
 public:
  /// For `slots` frames in flight; `bytes` may be 0.
  static Result<StagedBuffer> create(gpu::Device& device, std::uint64_t bytes, std::size_t slots,
                                     const std::string& name);
  /// With the given buffer as the one that kernels read.
  static Result<StagedBuffer> create(gpu::Device& device, gpu::Buffer seen, std::size_t slots,
                                     const std::string& name);

  /// The buffer that kernels read.
  const gpu::Buffer& seen() const { return seen_; }
  std::uint64_t bytes() const { return seen_.bytes(); }
  /// Size of all frames' copies [bytes].
  std::uint64_t writtenBytes() const { return written_.size() * seen_.bytes(); }
  /// The host copy of this slot's frame. Write it only while that frame is not submitted.
  template <class T>
  std::span<T> of(std::size_t slot) const {
    const auto bytes = written_[slot].mapped();
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
  /// Records the copy into the kernels' buffer, at the frame's start; the caller adds a barrier after it.
  void record(gpu::CommandList& list, std::size_t slot) const {
    list.copyBuffer(written_[slot], seen_, seen_.bytes());
  }

 private:
  explicit StagedBuffer(gpu::Buffer seen) : seen_(std::move(seen)) {}

  gpu::Buffer seen_;
  std::vector<gpu::Buffer> written_;  // by slot
};

}  // namespace ringlet
