// Implements solver/compute_device.h over gpu/device.h.
#include "ringlet/solver/compute_device.h"

#include "ringlet/gpu/device.h"

namespace ringlet {

Result<ComputeDevice> ComputeDevice::open(const std::string& choice,
                                          const std::filesystem::path& cacheFolder) {
  auto opened = gpu::Device::open(choice, {}, cacheFolder);
  if (!opened) return opened.error();
  return over(std::move(*opened));
}

ComputeDevice ComputeDevice::over(std::shared_ptr<gpu::Device> device) {
  ComputeDevice self;
  self.device_ = std::move(device);
  return self;
}

std::vector<DeviceSummary> ComputeDevice::list() {
  std::vector<DeviceSummary> summaries;
  for (const gpu::DeviceListing& listing : gpu::Device::list()) {
    const gpu::DeviceProperties& p = listing.properties;
    summaries.push_back({p.index, p.name, p.type, p.driver, p.memoryBytes, listing.usable, listing.why});
  }
  return summaries;
}

std::string ComputeDevice::name() const { return device_->properties().name; }
std::string ComputeDevice::driver() const { return device_->properties().driver; }
DeviceLimits ComputeDevice::limits() const {
  const gpu::DeviceProperties& p = device_->properties();
  return {p.subgroupSize, p.hasSubgroupShuffle, p.type == "cpu", p.maxGroupCount};
}
std::vector<std::string> ComputeDevice::validationMessages() const { return device_->validationMessages(); }

}  // namespace ringlet
