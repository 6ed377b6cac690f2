// Buffer: bytes the device can read and write, and the ways in and out of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/gpu/allocation.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/owned.h"

namespace ringlet::gpu {

enum class BufferKind {
  storage,  // close to the device; for data that kernels read and write
  stream,   // close to the host, always mapped, coherent; for data that is often transferred
};

/// What of a buffer kernels are given: the whole, or at most parts of it (Buffer::part), which alone must be
/// as small as the device wants it.
enum class BufferUse { whole, inParts };

/// A vec4, the largest unit kernels read [bytes].
inline constexpr std::uint64_t kRecordBytes = 16;

class Buffer {
 public:
  /// The content is undefined until written. No bytes are fine, and can be bound. `name` is for messages.
  static Result<Buffer> create(Device& device, std::uint64_t bytes, BufferKind kind, const std::string& name,
                               BufferUse use = BufferUse::whole);
  /// `bytes` of `whole` from `offset` on, a multiple of its alignment(), as a buffer of its own in the same
  /// memory, which it keeps: what is written by one is read by the other, after a barrier.
  static Result<Buffer> part(const Buffer& whole, std::uint64_t offset, std::uint64_t bytes,
                             const std::string& name);
  Buffer(Buffer&&) = default;
  Buffer& operator=(Buffer&&) = default;

  std::uint64_t bytes() const { return bytes_; }
  BufferKind kind() const { return kind_; }
  const std::string& name() const { return name_; }

  /// The content in the host's memory, in place; empty unless it is there (a stream's always is). Write while
  /// no submission uses the buffer; what a submission wrote is there after its wait.
  std::span<std::byte> mapped() const { return {mapped_, mapped_ ? static_cast<std::size_t>(bytes_) : 0}; }

  /// Copies in, out, or zeros; done when they return. No submission may be using the buffer meanwhile.
  /// `offset` [bytes] plus the span's size must lie within the buffer.
  Status upload(std::span<const std::byte> data, std::uint64_t offset = 0);
  Status download(std::span<std::byte> data, std::uint64_t offset = 0) const;
  Status fillZero();

  // For the other files of gpu/.
  VkBuffer handle() const { return buffer_.get(); }
  /// bytes(), rounded up to whole 16-byte records and to at least one: what is bound and filled.
  std::uint64_t capacity() const { return capacity_; }
  /// Where parts may begin [bytes].
  std::uint64_t alignment() const { return alignment_; }

 private:
  Buffer() = default;
  static Result<Buffer> withoutMemory(Device& device, std::uint64_t bytes, BufferKind kind,
                                      const std::string& name);
  Status bind(std::uint64_t offset);
  std::string attempt() const;  // completes "could not ..."

  Device* device_ = nullptr;  // held open by the members below
  std::shared_ptr<Allocation> memory_;
  std::shared_ptr<void> counted_;  // counts the bytes as taken from the device's memory
  OwnedBuffer buffer_;
  std::byte* mapped_ = nullptr;
  std::uint64_t bytes_ = 0;
  std::uint64_t capacity_ = 0;
  std::uint64_t alignment_ = 1;
  BufferKind kind_ = BufferKind::storage;
  std::string name_;
};

/// What is left of the memory that storage buffers are made in [bytes]; see Device::availableBytes.
std::uint64_t availableStorageBytes(const Device& device);
/// Whether streams are made in the same.
bool isOneMemory(const Device& device);

}  // namespace ringlet::gpu
