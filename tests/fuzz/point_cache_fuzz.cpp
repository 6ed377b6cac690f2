// Point caches, PC2 where they begin as one does and MDD else, and meshes over them.
#include "ringlet/motion/point_cache.h"

#include "ringlet/motion/sampled_mesh.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 32};

void tryBytes(std::span<const std::byte> bytes) {
  const bool isPc2 = textOf(bytes).starts_with("POINT");
  auto samples = readPointCache(bytes, isPc2 ? "fuzz.pc2" : "fuzz.mdd", 24);
  if (!samples) return;
  demand(samples->pointCount > 0 && !samples->seconds.empty(), "a cache has points");
  demand(samples->points.size() == samples->pointCount * samples->seconds.size(), "a sample has its points");
  const auto last = static_cast<std::uint32_t>(samples->pointCount - 1);
  const auto mesh = SampledMesh::of({{0, last, last / 2}}, std::move(*samples));
  if (!mesh) return;
  for (const double t : {-1.0, 0.0, 0.01, mesh->lastSeconds(), 1e9})
    for (const Vec3d& point : mesh->pointsAt(t)) demand(isFinite(point), "points are finite");
}

}  // namespace ringlet::fuzz
