// Which buffers a compute shader binds, read from its SPIR-V.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ringlet::gpu {

/// texels: a storage buffer's 16-byte records, for reading only, as a `usamplerBuffer` (R32G32B32A32_UINT:
/// bits are kept). Some devices read them much faster than storage: lavapipe in a fifth of the time. Their
/// number is bounded by DeviceProperties::maxTexelRecords; what lies beyond is not seen.
enum class BindingKind { storage, uniform, texels };

/// `layout(set = 0, binding = number)`.
struct KernelBinding {
  std::uint32_t number = 0;
  BindingKind kind = BindingKind::storage;

  bool operator==(const KernelBinding&) const = default;
};

/// The bindings that functions reachable from the shader's one entry point refer to, by number. These, and no
/// others, must be in a pipeline's layout. Code behind a specialization constant counts, whatever its value.
std::vector<KernelBinding> bindingsOf(std::span<const std::uint32_t> spirv);

}  // namespace ringlet::gpu
