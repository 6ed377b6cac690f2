// Kernel: a compiled compute shader; Bindings: the buffers one dispatch of it sees.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/owned.h"
#include "ringlet/gpu/spirv_bindings.h"

namespace ringlet::gpu {

/// `layout(constant_id = id) const uint/int/bool/float x`: the value's 32 bits.
struct SpecializationConstant {
  std::uint32_t id = 0;
  std::uint32_t value = 0;
};

struct KernelDescription {
  std::string name;                      // for messages and stages
  std::span<const std::uint32_t> spirv;  // needed only until create returns
  std::uint32_t pushConstantBytes = 0;   // a multiple of 4
  std::vector<SpecializationConstant> constants;
  std::uint32_t groupSize = 64;     // invocations of a workgroup, along x, as the shader will have it
  std::string remedy{};             // what to do where the device lacks storage buffers, a clause
  bool wantsFullSubgroups = false;  // subgroups without gaps and of one width, where the device can promise
                                    // it and groupSize is a multiple of them
  std::uint32_t subgroupSize = 0;   // that width, one of those the device has; 0: its default
};

class Kernel {
 public:
  /// Compiles the kernel, once a device: whoever describes the same kernel again shares it, whatever its name
  /// (kernel_cache.h). Holds the device open, as long as it is kept.
  static Result<std::shared_ptr<const Kernel>> create(Device& device, const KernelDescription& description);
  /// Whether the kernel is compiled already, so that create compiles nothing.
  static bool isCompiled(const Device& device, const KernelDescription& description);
  Kernel(const Kernel&) = delete;

  const std::string& name() const { return name_; }
  /// What its code refers to (spirv_bindings.h).
  const std::vector<KernelBinding>& bindings() const { return bindings_; }
  std::uint32_t pushConstantBytes() const { return pushConstantBytes_; }
  std::uint32_t groupSize() const { return groupSize_; }
  /// Wanted and promised by the device: no gaps, and subgroupSize() invocations in each.
  bool hasFullSubgroups() const { return hasFullSubgroups_; }
  /// The width asked for; where the device cannot be asked, the one it reports.
  std::uint32_t subgroupSize() const { return subgroupSize_; }

  // For the other files of gpu/.
  Device& device() const { return *device_; }
  VkDescriptorSetLayout setLayout() const { return setLayout_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }
  VkPipeline pipeline() const { return pipeline_.get(); }

 private:
  Kernel() = default;
  static Result<std::shared_ptr<const Kernel>> compile(Device& device, const KernelDescription& description);
  Status makeLayout(const KernelDescription& description);
  Status makePipeline(const KernelDescription& description, bool asksForWidth);

  Device* device_ = nullptr;  // which keeps this
  OwnedSetLayout setLayout_;
  OwnedPipelineLayout layout_;
  OwnedPipeline pipeline_;
  std::string name_;
  std::vector<KernelBinding> bindings_;
  std::uint32_t pushConstantBytes_ = 0;
  std::uint32_t groupSize_ = 0;
  std::uint32_t subgroupSize_ = 1;
  bool hasFullSubgroups_ = false;
};

/// Buffers by binding number.
using BufferTable = std::map<std::uint32_t, std::reference_wrapper<const Buffer>>;

/// Made once for a kernel and its buffers; good for every kernel with the same bindings. The buffers must
/// live as long, and may be moved meanwhile.
class Bindings {
 public:
  /// The table has a buffer for each binding of the kernel. Others in it are left out.
  static Result<Bindings> create(const Kernel& kernel, const BufferTable& buffers);
  Bindings(Bindings&&) = default;
  Bindings& operator=(Bindings&&) = default;

  const std::vector<KernelBinding>& bindings() const { return bindings_; }
  VkDescriptorSet set() const { return set_; }  // for the other files of gpu/

 private:
  Bindings() = default;

  OwnedDescriptorPool pool_;
  std::vector<OwnedBufferView> views_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<KernelBinding> bindings_;
};

}  // namespace ringlet::gpu
