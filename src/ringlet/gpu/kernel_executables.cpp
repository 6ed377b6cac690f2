// Implements gpu/kernel_executables.h.
#include "ringlet/gpu/kernel_executables.h"

#include <fmt/format.h>

#include "ringlet/gpu/check.h"

namespace ringlet::gpu {
namespace {

double valueOf(const VkPipelineExecutableStatisticKHR& statistic) {
  switch (statistic.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
      return statistic.value.b32 ? 1 : 0;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
      return static_cast<double>(statistic.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
      return static_cast<double>(statistic.value.u64);
    default:
      return statistic.value.f64;
  }
}

Result<std::vector<KernelStatistic>> statisticsOf(const Kernel& kernel, std::uint32_t index) {
  const auto attempt = fmt::format("read what the driver says of the kernel '{}'", kernel.name());
  const Device& device = kernel.device();
  auto info = zeroed<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
  info.pipeline = kernel.pipeline();
  info.executableIndex = index;
  std::uint32_t count = 0;
  RINGLET_VK_CHECK(device.vk().vkGetPipelineExecutableStatisticsKHR(device.handle(), &info, &count, nullptr),
                   attempt);
  std::vector<VkPipelineExecutableStatisticKHR> found(
      count, zeroed<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
  RINGLET_VK_CHECK(
      device.vk().vkGetPipelineExecutableStatisticsKHR(device.handle(), &info, &count, found.data()),
      attempt);
  std::vector<KernelStatistic> statistics;
  for (const auto& statistic : found) statistics.push_back({statistic.name, valueOf(statistic)});
  return statistics;
}

}  // namespace

Result<std::vector<KernelExecutable>> executablesOf(const Kernel& kernel) {
  const Device& device = kernel.device();
  const Inspection inspection = device.properties().inspection;
  if (inspection == Inspection::none) return std::vector<KernelExecutable>{};
  const auto attempt = fmt::format("read what the driver says of the kernel '{}'", kernel.name());
  auto info = zeroed<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
  info.pipeline = kernel.pipeline();
  std::uint32_t count = 0;
  RINGLET_VK_CHECK(device.vk().vkGetPipelineExecutablePropertiesKHR(device.handle(), &info, &count, nullptr),
                   attempt);
  std::vector<VkPipelineExecutablePropertiesKHR> found(
      count, zeroed<VkPipelineExecutablePropertiesKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR));
  RINGLET_VK_CHECK(
      device.vk().vkGetPipelineExecutablePropertiesKHR(device.handle(), &info, &count, found.data()),
      attempt);
  std::vector<KernelExecutable> executables;
  for (const auto& properties : found) {
    KernelExecutable& one = executables.emplace_back();
    one.name = properties.name;
    one.subgroupSize = properties.subgroupSize;
    if (inspection != Inspection::statistics) continue;
    auto statistics = statisticsOf(kernel, static_cast<std::uint32_t>(executables.size() - 1));
    if (!statistics) return statistics.error();
    one.statistics = std::move(*statistics);
  }
  return executables;
}

}  // namespace ringlet::gpu
