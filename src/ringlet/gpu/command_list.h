// CommandList: work for a device, in order, before it goes into a command buffer: a recorder's (recorder.h)
// or a host's. Work that does not depend on what stands before it may stand beside it; then the two share
// their barriers, and the device runs them at the same time.
//
//   { beginStage, dispatch, barrier, copyBuffer, ..., endStage }*  beside  { ... }*
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"

namespace ringlet::gpu {

/// A struct, rather than bytes already.
template <class T>
concept PushConstants =
    std::is_trivially_copyable_v<T> && !std::is_convertible_v<const T&, std::span<const std::byte>>;

/// What a list is made of.
namespace command {
struct Dispatch {
  const Kernel* kernel = nullptr;
  VkDescriptorSet set = VK_NULL_HANDLE;
  std::vector<std::byte> pushConstants;
  std::uint32_t groupCount = 0;
  VkBuffer groupCounts = VK_NULL_HANDLE;  // or none: then it is groupCount
  VkDeviceSize offset = 0;                // in groupCounts [bytes]
};
struct Copy {
  VkBuffer from = VK_NULL_HANDLE, to = VK_NULL_HANDLE;
  VkBufferCopy region{};
};
struct Fill {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize bytes = 0, offset = 0;
};
struct Barrier {};
struct Cut {};
struct BeginStage {
  std::string name;
};
struct EndStage {};
}  // namespace command
using Command = std::variant<command::Dispatch, command::Copy, command::Fill, command::Barrier, command::Cut,
                             command::BeginStage, command::EndStage>;

/// For one thread at a time. Kernels, bindings and buffers in it must live until the device is done with it.
class CommandList {
 public:
  /// Runs `groupCount` workgroups, at most DeviceProperties::maxGroupCount: the caller splits. None is fine.
  void dispatch(const Kernel& kernel, const Bindings& bindings, std::span<const std::byte> pushConstants,
                std::uint32_t groupCount);
  /// The same with a struct as push constants, laid out as in the shader.
  template <PushConstants T>
  void dispatch(const Kernel& kernel, const Bindings& bindings, const T& pushConstants,
                std::uint32_t groupCount) {
    dispatch(kernel, bindings, std::as_bytes(std::span(&pushConstants, 1)), groupCount);
  }

  /// The same, with the three group counts the device finds at `offset` [bytes, a multiple of 4] of
  /// `groupCounts`: earlier work decides how much is done, and no host waits for it. Each at most
  /// maxGroupCount.
  void dispatchIndirect(const Kernel& kernel, const Bindings& bindings,
                        std::span<const std::byte> pushConstants, const Buffer& groupCounts,
                        std::uint64_t offset);
  template <PushConstants T>
  void dispatchIndirect(const Kernel& kernel, const Bindings& bindings, const T& pushConstants,
                        const Buffer& groupCounts, std::uint64_t offset) {
    dispatchIndirect(kernel, bindings, std::as_bytes(std::span(&pushConstants, 1)), groupCounts, offset);
  }

  /// No workgroup at all; but drivers that compile a kernel at its first dispatch do it here.
  void dispatchNothing(const Kernel& kernel, const Bindings& bindings);

  /// What stands before is finished and visible to what follows: kernels, their group counts, and copies,
  /// reads and writes.
  /// The validation layer notices a barrier left out only where one of the two kernels declares the
  /// buffer `readonly` (copies are always watched); so declare it wherever it is true.
  void barrier();

  void copyBuffer(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t fromOffset = 0,
                  std::uint64_t toOffset = 0);
  /// From a VkBuffer of a host's, whose size nobody here knows.
  void copyFromHost(void* from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t bytes,
                    std::uint64_t toOffset);
  void fillZero(const Buffer& buffer);
  /// `bytes` from `offset` on, both multiples of 4.
  void fillZero(const Buffer& buffer, std::uint64_t bytes, std::uint64_t offset);

  /// What follows is a submission of its own, which sees the finished work of what stands before. Not within
  /// a stage.
  void cut();

  /// Times the commands up to endStage; stages do not nest.
  void beginStage(const std::string& name);
  void endStage();

  /// Declares the following commands independent of all earlier ones. The n-th barrier from here on is the
  /// same barrier as the n-th of the earlier commands. Stages and cuts are ignored from then on: the list is
  /// one submission and is not timed.
  void beside();

  /// In the order in which it goes into a command buffer.
  std::vector<const Command*> inOrder() const;
  /// The same for tests: kernels by name, kBarrier, kCopy or kFill.
  static constexpr const char *kBarrier = "barrier", *kCopy = "copy", *kFill = "fill";
  std::vector<std::string> recorded() const;

  /// Into a command buffer of a host's, which is being recorded and goes to a queue that computes. It begins
  /// and ends with a barrier between compute, copies and, at the end, the host. Stages are labels there; cuts
  /// do not count.
  void recordInto(const Device& device, VkCommandBuffer commands) const;

 protected:
  void clear();
  bool isStageOpen() const { return isStageOpen_; }
  bool isOpen_ = true;  // to be added to

 private:
  void add(Command command);

  std::vector<std::vector<Command>> besides_ = std::vector<std::vector<Command>>(1);  // never empty
  bool isStageOpen_ = false;
};

/// Into a command buffer; stages and cuts are the caller's.
void recordCommand(const VolkDeviceTable& vk, VkCommandBuffer commands, const Command& command);
/// All that stands before is done, and seen by the host.
void recordHostBarrier(const VolkDeviceTable& vk, VkCommandBuffer commands);

}  // namespace ringlet::gpu
