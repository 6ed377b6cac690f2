// BoundKernel: a kernel with the buffers it works on.
#pragma once

#include <memory>
#include <utility>

#include "ringlet/base/result.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"

namespace ringlet::gpu {

class BoundKernel {
 public:
  /// As Kernel::create and Bindings::create.
  static Result<BoundKernel> create(Device& device, const KernelDescription& description,
                                    const BufferTable& buffers) {
    auto kernel = Kernel::create(device, description);
    if (!kernel) return kernel.error();
    auto bindings = Bindings::create(**kernel, buffers);
    if (!bindings) return bindings.error();
    return BoundKernel(std::move(*kernel), std::move(*bindings));
  }

  std::uint32_t groupSize() const { return kernel_->groupSize(); }

  /// Dispatches as many workgroups as this number of invocations needs.
  template <PushConstants T>
  void dispatch(CommandList& list, const T& pushConstants, std::uint32_t invocations) const {
    const std::uint32_t size = groupSize();
    list.dispatch(*kernel_, bindings_, pushConstants, invocations / size + (invocations % size != 0));
  }
  /// As many as the device finds at `offset` of `groupCounts` (CommandList::dispatchIndirect).
  template <PushConstants T>
  void dispatchIndirect(CommandList& list, const T& pushConstants, const Buffer& groupCounts,
                        std::uint64_t offset) const {
    list.dispatchIndirect(*kernel_, bindings_, pushConstants, groupCounts, offset);
  }

 private:
  BoundKernel(std::shared_ptr<const Kernel> kernel, Bindings bindings)
      : kernel_(std::move(kernel)), bindings_(std::move(bindings)) {}

  std::shared_ptr<const Kernel> kernel_;
  Bindings bindings_;
};

}  // namespace ringlet::gpu
