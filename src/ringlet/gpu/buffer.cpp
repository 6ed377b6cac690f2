// Implements gpu/buffer.h.
#include "ringlet/gpu/buffer.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/check.h"
#include "ringlet/gpu/memory_choice.h"
#include "ringlet/gpu/recorder.h"

namespace ringlet::gpu {
namespace {

constexpr std::uint64_t kStagingBytes = 32ull
                                        << 20;  // larger copies go in pieces, to bound the host's memory

constexpr VkMemoryPropertyFlags kMappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                            VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                            VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

// The heap a buffer of this kind is made in while there is room.
std::optional<std::uint32_t> bestHeap(const Device& device, BufferKind kind) {
  const auto types = memoryTypesFor(device.memory(), ~0u, kind, device.options().alwaysStage);
  if (types.empty()) return std::nullopt;
  return device.memory().memoryTypes[types.front()].heapIndex;
}

Status checkSize(const DeviceProperties& limits, std::uint64_t bytes, const std::string& name,
                 BufferUse use) {
  // The comparison comes before rounding up, which could overflow.
  const bool isRange = use == BufferUse::whole && limits.maxStorageBufferRange <= limits.maxAllocationBytes;
  const std::uint64_t largest = isRange ? limits.maxStorageBufferRange : limits.maxAllocationBytes;
  if (bytes <= largest / kRecordBytes * kRecordBytes) return {};
  return Error{fmt::format(
      "could not make the buffer '{}' of {} bytes on {}: this device allows at most {} bytes ({}). Use less "
      "data, or another device",
      name, bytes, limits.name, largest, isRange ? "maxStorageBufferRange" : "maxMemoryAllocationSize")};
}

}  // namespace

std::string Buffer::attempt() const {
  return fmt::format("make the buffer '{}' of {} bytes on {}", name_, bytes_, device_->properties().name);
}

Result<Buffer> Buffer::withoutMemory(Device& device, std::uint64_t bytes, BufferKind kind,
                                     const std::string& name) {
  Buffer self;
  self.device_ = &device;
  self.bytes_ = bytes;
  self.capacity_ = std::max(kRecordBytes, (bytes + kRecordBytes - 1) / kRecordBytes * kRecordBytes);
  self.kind_ = kind;
  self.name_ = name;

  auto info = zeroed<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = self.capacity_;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
               VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  VkBuffer buffer = VK_NULL_HANDLE;
  RINGLET_VK_CHECK(device.vk().vkCreateBuffer(device.handle(), &info, nullptr, &buffer), self.attempt());
  self.buffer_ = OwnedBuffer(device.shared_from_this(), buffer);
  device.nameObject(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer), name);
  return self;
}

Status Buffer::bind(std::uint64_t offset) {
  RINGLET_VK_CHECK(device_->vk().vkBindBufferMemory(device_->handle(), handle(), memory_->memory(),
                                                    memory_->offset() + offset),
                   attempt());
  return {};
}

Result<Buffer> Buffer::create(Device& device, std::uint64_t bytes, BufferKind kind, const std::string& name,
                              BufferUse use) {
  if (Status status = checkSize(device.properties(), bytes, name, use); !status) return status.error();
  auto made = withoutMemory(device, bytes, kind, name);
  if (!made) return made;
  Buffer& self = *made;

  VkMemoryRequirements requirements;
  device.vk().vkGetBufferMemoryRequirements(device.handle(), self.handle(), &requirements);
  self.alignment_ = std::max(kRecordBytes, requirements.alignment);
  const auto types =
      memoryTypesFor(device.memory(), requirements.memoryTypeBits, kind, device.options().alwaysStage);
  if (types.empty()) {
    return Error{fmt::format("could not {}: the driver offers no {} memory for it", self.attempt(),
                             kind == BufferKind::stream ? "host-coherent" : "device")};
  }
  self.memory_ = std::make_shared<Allocation>();
  const auto allocate = [&](std::uint32_t type) {
    return Allocation::make(device, requirements, type, *self.memory_);
  };
  const auto type = allocateInFirst(device.memory(), types, requirements.size, self.attempt(), allocate);
  if (!type) return type.error();
  const VkMemoryType& chosen = device.memory().memoryTypes[*type];
  self.counted_ = device.countBytes(chosen.heapIndex, requirements.size);
  if (Status status = self.bind(0); !status) return status.error();

  const bool isMapped = kind == BufferKind::stream ||
                        (!device.options().alwaysStage && (chosen.propertyFlags & kMappable) == kMappable);
  if (isMapped) {
    const auto address = self.memory_->map(self.attempt());
    if (!address) return address.error();
    self.mapped_ = *address;
  }
  return made;
}

Result<Buffer> Buffer::part(const Buffer& whole, std::uint64_t offset, std::uint64_t bytes,
                            const std::string& name) {
  RINGLET_ASSERT(offset % whole.alignment_ == 0, "a part begins where buffers may");
  RINGLET_ASSERT(offset <= whole.bytes_ && bytes <= whole.bytes_ - offset,
                 "a part runs past its whole's end");
  auto made = withoutMemory(*whole.device_, bytes, whole.kind_, name);
  if (!made) return made;
  Buffer& self = *made;
  self.alignment_ = whole.alignment_;
  self.memory_ = whole.memory_;
  self.counted_ = whole.counted_;
  if (Status status = self.bind(offset); !status) return status.error();
  if (whole.mapped_) self.mapped_ = whole.mapped_ + offset;
  return made;
}

Status Buffer::upload(std::span<const std::byte> data, std::uint64_t offset) {
  RINGLET_ASSERT(offset <= bytes_ && data.size() <= bytes_ - offset, "an upload runs past the buffer's end");
  if (data.empty()) return {};
  if (mapped_) {
    std::memcpy(mapped_ + offset, data.data(), data.size());
    return {};
  }

  auto staging = create(*device_, std::min<std::uint64_t>(data.size(), kStagingBytes), BufferKind::stream,
                        "staging for " + name_);
  if (!staging) return staging.error();
  auto recorder = Recorder::create(*device_, "upload of " + name_);
  if (!recorder) return recorder.error();
  for (std::size_t done = 0; done < data.size();) {
    const std::size_t piece = std::min(data.size() - done, staging->mapped().size());
    std::memcpy(staging->mapped().data(), data.data() + done, piece);
    if (Status status = recorder->begin(); !status) return status;
    recorder->copyBuffer(*staging, *this, piece, 0, offset + done);
    if (Status status = recorder->submitAndWait(); !status) return status;
    done += piece;
  }
  return {};
}

Status Buffer::download(std::span<std::byte> data, std::uint64_t offset) const {
  RINGLET_ASSERT(offset <= bytes_ && data.size() <= bytes_ - offset, "a download runs past the buffer's end");
  if (data.empty()) return {};
  if (mapped_) {
    std::memcpy(data.data(), mapped_ + offset, data.size());
    return {};
  }

  auto staging = create(*device_, std::min<std::uint64_t>(data.size(), kStagingBytes), BufferKind::stream,
                        "staging for " + name_);
  if (!staging) return staging.error();
  auto recorder = Recorder::create(*device_, "download of " + name_);
  if (!recorder) return recorder.error();
  for (std::size_t done = 0; done < data.size();) {
    const std::size_t piece = std::min(data.size() - done, staging->mapped().size());
    if (Status status = recorder->begin(); !status) return status;
    recorder->copyBuffer(*this, *staging, piece, offset + done);
    if (Status status = recorder->submitAndWait(); !status) return status;
    std::memcpy(data.data() + done, staging->mapped().data(), piece);
    done += piece;
  }
  return {};
}

Status Buffer::fillZero() {
  if (mapped_) {
    std::memset(mapped_, 0, capacity_);
    return {};
  }
  auto recorder = Recorder::create(*device_, "zeros for " + name_);
  if (!recorder) return recorder.error();
  if (Status status = recorder->begin(); !status) return status;
  recorder->fillZero(*this);
  return recorder->submitAndWait();
}

std::uint64_t availableStorageBytes(const Device& device) {
  const auto heap = bestHeap(device, BufferKind::storage);
  return heap ? device.availableBytes(*heap) : 0;
}

bool isOneMemory(const Device& device) {
  return bestHeap(device, BufferKind::storage) == bestHeap(device, BufferKind::stream);
}

}  // namespace ringlet::gpu
