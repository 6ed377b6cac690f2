// Implements conform_facts.h.
#include "program/device/conform_facts.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <span>
#include <string>

#include "ringlet/gpu/device.h"
#include "ringlet/solver/strand_shape.h"
#include "ringlet/version.h"

namespace ringlet::program {
namespace {

using Json = nlohmann::ordered_json;

// "Debian GNU/Linux 12 (bookworm), Linux 6.1.0 x86_64".
std::string operatingSystem() {
  std::string text;
  std::ifstream file("/etc/os-release");
  const std::string key = "PRETTY_NAME=\"";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key)) text = line.substr(key.size(), line.size() - key.size() - 1) + ", ";
  }
  utsname kernel{};
  if (uname(&kernel) == 0) text += fmt::format("{} {} {}", kernel.sysname, kernel.release, kernel.machine);
  return text;
}

Json limit(std::uint64_t has, std::uint64_t needed) { return Json{{"has", has}, {"needed", needed}}; }

Json heapsOf(const gpu::Device& device) {
  Json heaps = Json::array();
  const VkPhysicalDeviceMemoryProperties& memory = device.memory();
  for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount)) {
    heaps.push_back({{"bytes", heap.size},
                     {"available_bytes", device.availableBytes(static_cast<std::uint32_t>(heaps.size()))},
                     {"is_device_local", (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0}});
  }
  return heaps;
}

}  // namespace

Json factsOf(const ComputeDevice& device) {
  const gpu::DeviceProperties& p = device.gpu().properties();
  Json facts;
  facts["ringlet"] = RINGLET_VERSION;
  facts["commit"] = RINGLET_COMMIT;
  facts["strand_kernels"] = strandKernelHash();
  facts["os"] = operatingSystem();
  facts["device"] = p.name;
  facts["driver"] = p.driver;
  facts["ids"] = {{"driver", p.driverId},
                  {"driver_version", p.driverVersion},
                  {"vendor", p.vendorId},
                  {"device", p.deviceId}};
  facts["type"] = p.type;
  facts["vulkan"] = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion),
                                VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion));
  facts["subgroup"] = {{"reported", p.reportedSubgroupSize},
                       {"least", p.minSubgroupSize},
                       {"most", p.maxSubgroupSize},
                       {"can_choose", p.canChooseSubgroupSize},
                       {"asked", p.subgroupSize},
                       {"can_insist_on_full", p.hasFullSubgroups},
                       {"has_shuffle", p.hasSubgroupShuffle}};
  facts["storage_buffers"] = limit(p.maxStorageBuffers, gpu::kNeededStorageBuffers);
  facts["workgroup_invocations"] = limit(p.maxGroupInvocations, gpu::kNeededGroupInvocations);
  facts["push_constant_bytes"] = limit(p.maxPushConstantBytes, gpu::kNeededPushConstantBytes);
  facts["workgroups"] = p.maxGroupCount;
  facts["storage_buffer_bytes"] = p.maxStorageBufferRange;
  facts["uniform_buffer_bytes"] = p.maxUniformBufferRange;
  facts["texel_records"] = p.maxTexelRecords;
  facts["allocation_bytes"] = p.maxAllocationBytes;
  facts["shared_memory_bytes"] = p.maxSharedMemoryBytes;
  facts["heaps"] = heapsOf(device.gpu());
  facts["timestamps"] = {
      {"usable", p.hasTimestamps}, {"bits", p.timestampBits}, {"ns_a_tick", p.timestampPeriod}};
  return facts;
}

std::string factsText(const Json& facts) {
  const auto valueText = [](const Json& value) {
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  const auto pairsText = [&](const Json& object) {
    std::string text;
    for (const auto& [key, value] : object.items())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, valueText(value));
    return text;
  };
  std::string text;
  for (const auto& [key, value] : facts.items()) {
    if (value.is_array()) {
      for (const Json& one : value) text += fmt::format("  {:<22} {}\n", key, pairsText(one));
    } else {
      text += fmt::format("  {:<22} {}\n", key, value.is_object() ? pairsText(value) : valueText(value));
    }
  }
  return text;
}

}  // namespace ringlet::program
