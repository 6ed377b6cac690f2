// Implements gpu/device_lack.h.
#include "ringlet/gpu/device_lack.h"

#include <fmt/format.h>

#include <cstdint>

namespace ringlet::gpu {

std::string findLack(const DeviceProperties& p, const DeviceOptions& options) {
  std::string lack;
  if (p.memoryBytes == 0 && !options.allowNull) lack = "it has no memory";
  const auto need = [&](const char* limit, std::uint32_t needed, std::uint32_t found) {
    if (found < needed)
      lack += fmt::format("{}{} is {}, needed are {}", lack.empty() ? "" : "; ", limit, found, needed);
  };
  need("maxPerStageDescriptorStorageBuffers", kNeededStorageBuffers, p.maxStorageBuffers);
  need("maxComputeWorkGroupInvocations", kNeededGroupInvocations, p.maxGroupInvocations);
  need("maxPushConstantsSize", kNeededPushConstantBytes, p.maxPushConstantBytes);
  return lack;
}

}  // namespace ringlet::gpu
