// Implements solver/contact_momentum.h.
#include "ringlet/solver/contact_momentum.h"

#include "ringlet/base/vec3.h"
#include "ringlet/solver/device_buffers.h"

namespace ringlet {

Result<double> contactMomentumError(const DeviceChunk& hair, const RestState& rest) {
  auto systems = downloadAll<layout::ContactSystem>(hair.contactSystems, rest.points.size());
  if (!systems) return systems.error();
  auto solved = downloadAll<layout::vec4>(hair.solved, rest.points.size());
  if (!solved) return solved.error();
  Vec3d sum{};
  double sizes = 0;
  for (const layout::StrandRest& strand : rest.strands) {
    for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i) {
      const auto& [d, o, m, g] = (*systems)[i];
      const layout::vec4 v = (*solved)[i];
      const Vec3d Dv{double(d.x) * v.x + double(o.z) * v.y + double(o.y) * v.z,
                     double(o.z) * v.x + double(d.y) * v.y + double(o.x) * v.z,
                     double(o.y) * v.x + double(o.x) * v.y + double(d.z) * v.z};
      const Vec3d byVolume = Vec3d{g.x, g.y, g.z} - Vec3d{v.x, v.y, v.z} * double(g.w);
      const Vec3d J = (Vec3d{m.x, m.y, m.z} - Dv * 2.0 + byVolume) * double(strand.firstEdge.w);
      sum = sum + J;
      sizes += length(J);
    }
  }
  return sizes > 0 ? length(sum) / sizes : 0;
}

}  // namespace ringlet
