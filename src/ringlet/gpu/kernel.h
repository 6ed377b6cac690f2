// Kernel: a compiled compute shader; Bindings: the buffers one dispatch of it sees.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/owned.h"

namespace ringlet::gpu {

/// texels: a storage buffer's 16-byte records, for reading only, as a `usamplerBuffer` (R32G32B32A32_UINT:
/// bits are kept). Some devices read them much faster than storage: lavapipe in a fifth of the time. Their
/// number is bounded by DeviceProperties::maxTexelRecords; what lies beyond is not seen.
enum class BindingKind { storage, uniform, texels };

/// `layout(constant_id = id) const uint/int/bool/float x`: the value's 32 bits.
struct SpecializationConstant {
  std::uint32_t id = 0;
  std::uint32_t value = 0;
};

struct KernelDescription {
  std::string name;                      // for messages and stages
  std::span<const std::uint32_t> spirv;  // needed only until create returns
  std::vector<BindingKind> bindings;     // binding 0, 1, ... of set 0
  std::uint32_t pushConstantBytes = 0;   // a multiple of 4
  std::vector<SpecializationConstant> constants;
  std::uint32_t groupSize = 64;     // invocations of a workgroup, along x, as the shader will have it
  bool wantsFullSubgroups = false;  // subgroups without gaps and of one width, where the device can promise
                                    // it and groupSize is a multiple of them
  std::uint32_t subgroupSize = 0;   // that width, one of those the device has; 0: its default
};

class Kernel {
 public:
  static Result<Kernel> create(Device& device, const KernelDescription& description);
  Kernel(Kernel&&) = default;
  Kernel& operator=(Kernel&&) = default;

  const std::string& name() const { return name_; }
  const std::vector<BindingKind>& bindings() const { return bindings_; }
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

  Device* device_ = nullptr;  // held open by what follows
  OwnedSetLayout setLayout_;
  OwnedPipelineLayout layout_;
  OwnedPipeline pipeline_;
  std::string name_;
  std::vector<BindingKind> bindings_;
  std::uint32_t pushConstantBytes_ = 0;
  std::uint32_t groupSize_ = 0;
  std::uint32_t subgroupSize_ = 1;
  bool hasFullSubgroups_ = false;
};

/// Made once for a kernel and its buffers; good for every kernel with the same list of binding kinds. The
/// buffers must live as long, and may be moved meanwhile.
class Bindings {
 public:
  /// One buffer a binding, in order.
  static Result<Bindings> create(const Kernel& kernel,
                                 const std::vector<std::reference_wrapper<const Buffer>>& buffers);
  Bindings(Bindings&&) = default;
  Bindings& operator=(Bindings&&) = default;

  const std::vector<BindingKind>& kinds() const { return kinds_; }
  VkDescriptorSet set() const { return set_; }  // for the other files of gpu/

 private:
  Bindings() = default;

  OwnedDescriptorPool pool_;
  std::vector<OwnedBufferView> views_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  std::vector<BindingKind> kinds_;
};

}  // namespace ringlet::gpu
