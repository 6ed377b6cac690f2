// KernelSpy: what reaches a device through Vulkan: the commands of each submission, and what is in the
// buffers that its kernels see. For a device that the test opened itself; it takes the place of some
// functions of the device's table, on which nothing was made yet. One at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/gpu/device.h"

namespace ringlet::test {

struct SpiedCommand {
  enum class Kind { dispatch, transfer, barrier };
  Kind kind = Kind::dispatch;
  // Of a dispatch; the set may be another by the time of the submission.
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  std::vector<std::byte> pushConstants{};
  // Of a barrier.
  VkPipelineStageFlags from = 0, to = 0;
  VkAccessFlags written = 0, read = 0;
};
using SpiedCommands = std::vector<SpiedCommand>;

class KernelSpy {
 public:
  explicit KernelSpy(gpu::Device& device);
  ~KernelSpy();
  KernelSpy(const KernelSpy&) = delete;

  /// A command buffer on its way to the queue. `isLast`: of those that one fence is for.
  std::function<void(const SpiedCommands&, bool isLast)> onSubmit{};
  /// A submission whose fence was waited for: all its command buffers.
  std::function<void(const SpiedCommands&)> onDone{};

  /// What was recorded into a command buffer so far.
  const SpiedCommands& recorded(VkCommandBuffer commands) const;
  /// The labels of all command buffers: its name where one begins, nothing where it ends.
  const std::vector<std::string>& labels() const;
  /// SPIR-V.
  const std::vector<std::uint32_t>& codeOf(VkPipeline pipeline) const;
  /// Of its storage and uniform buffers those that the host sees, by binding.
  std::map<std::uint32_t, std::span<const std::byte>> buffersOf(VkDescriptorSet set) const;

 private:
  struct State;
  friend struct SpyCalls;
  std::unique_ptr<State> self_;
};

}  // namespace ringlet::test
