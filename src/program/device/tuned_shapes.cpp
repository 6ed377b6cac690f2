// Implements tuned_shapes.h.
#include "program/device/tuned_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "program/cli/cache_folder.h"
#include "ringlet/solver/plan/shape_cost_file.h"
#include "ringlet/solver/plan/subgroup_choice.h"

namespace ringlet::program {
namespace {

constexpr std::size_t kMostDevices = 32;  // over all drivers and kernels so far; the oldest are dropped

std::filesystem::path shapesFile() {
  const auto folder = cacheFolder();
  return folder.empty() ? folder : folder / "strand_shapes.toml";
}

// A missing file counts as an empty one.
Result<std::vector<DeviceCosts>> readShapesFile() {
  std::error_code code;
  const auto file = shapesFile();
  const auto status = std::filesystem::status(file, code);
  if (file.empty() || status.type() == std::filesystem::file_type::not_found)
    return std::vector<DeviceCosts>{};
  return readShapeCosts(file);
}

}  // namespace

TunedShapes recallShapes(const ComputeDevice& device) {
  TunedShapes tuned;
  const auto devices = readShapesFile();
  if (!devices) {
    tuned.warning =
        fmt::format("what `ringlet tune` measured is left aside: {}; tune again, or delete the file",
                    devices.error().message);
    return tuned;
  }
  const DeviceCosts here{device.name(), device.driver(), strandKernelHash(), {}};
  for (const DeviceCosts& known : *devices) {
    const bool isPossible =
        static_cast<bool>(withSubgroupSize(device.limits(), static_cast<int>(known.subgroupSize)));
    if (known.isOf(here) && isPossible) tuned.costs = known.costs, tuned.subgroupSize = known.subgroupSize;
    tuned.isOutdated = tuned.isOutdated || known.device == here.device;
  }
  tuned.isOutdated = tuned.isOutdated && tuned.costs.empty();
  return tuned;
}

Result<std::filesystem::path> rememberShapes(const ComputeDevice& device, const std::vector<ShapeCost>& costs,
                                             std::uint32_t subgroupSize) {
  const auto file = shapesFile();
  if (file.empty())
    return Error{
        "there is no folder to remember this in: RINGLET_CACHE_DIR, XDG_CACHE_HOME and HOME are not set, or "
        "not absolute paths"};
  auto known = readShapesFile();
  std::vector<DeviceCosts> devices = known ? std::move(*known) : std::vector<DeviceCosts>{};
  const DeviceCosts here{device.name(), device.driver(), strandKernelHash(), costs, subgroupSize};
  std::erase_if(devices, [&](const DeviceCosts& other) { return other.isOf(here); });
  devices.insert(devices.begin(), here);
  devices.resize(std::min(devices.size(), kMostDevices));
  if (Status written = writeShapeCosts(file, devices); !written) return written.error();
  return file;
}

}  // namespace ringlet::program
