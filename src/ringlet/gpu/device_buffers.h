// Storage buffers filled at creation, and read back whole: the ways between host and device that modules
// above use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"

namespace ringlet {

template <class T>
Result<gpu::Buffer> createFilled(gpu::Device& device, std::span<const T> values, const std::string& name) {
  auto buffer = gpu::Buffer::create(device, values.size_bytes(), gpu::BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->upload(std::as_bytes(values)); !status) return status.error();
  return buffer;
}
template <class T>
Result<gpu::Buffer> createFilled(gpu::Device& device, const std::vector<T>& values, const std::string& name) {
  return createFilled(device, std::span<const T>(values), name);
}

inline Result<gpu::Buffer> createZero(gpu::Device& device, std::uint64_t bytes, const std::string& name) {
  auto buffer = gpu::Buffer::create(device, bytes, gpu::BufferKind::storage, name);
  if (!buffer) return buffer;
  if (Status status = buffer->fillZero(); !status) return status.error();
  return buffer;
}

/// All of a buffer as records of T, from the `offset`th on.
template <class T>
Result<std::vector<T>> downloadAll(const gpu::Buffer& buffer, std::size_t count, std::uint64_t offset = 0) {
  std::vector<T> values(count);
  if (Status status = buffer.download(std::as_writable_bytes(std::span(values)), offset * sizeof(T));
      !status) {
    return status.error();
  }
  return values;
}

/// Archives a whole buffer, or restores it from an archive that is long enough.
inline Status archiveBuffer(Archive& archive, gpu::Buffer& buffer) {
  const auto bytes = static_cast<std::size_t>(buffer.bytes());
  if (!archive.isReading()) return buffer.download(archive.room(bytes));
  const std::span<const std::byte> read = archive.next(bytes);
  return archive.isShort() ? Status{} : buffer.upload(read);
}

/// What grows, or is cut to fit, is read as texels where a device sees at least this much of a buffer
/// [bytes]: what the smallest storage buffers hold.
inline constexpr std::uint64_t kLeastTexelBytes = 128ull << 20;

/// Whether a kernel on the device sees all of a buffer of this size as texels (gpu::BindingKind).
inline bool isSeenAsTexels(const gpu::Device& device, std::uint64_t bytes) {
  return bytes <= device.properties().maxTexelRecords * 16;
}

}  // namespace ringlet
