// Measured costs of strand shapes.
#include "ringlet/solver/plan/shape_cost_file.h"

#include "tests/fuzz/memory_file.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 4 << 20, .perByte = 4096};

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  const auto devices = readShapeCosts(file.path());
  if (!devices) return;
  for (const DeviceCosts& device : *devices) {
    demand(!device.costs.empty(), "a device has costs");
    for (const ShapeCost& cost : device.costs)
      demand(std::isfinite(cost.nanoseconds) && cost.nanoseconds > 0, "a cost is above 0");
  }
}

}  // namespace ringlet::fuzz
