// Implements solver/contacts/contact_momentum.h.
#include "ringlet/solver/contacts/contact_momentum.h"

#include "layout/contacts.h"
#include "layout/strands.h"
#include "ringlet/base/vec3.h"
#include "ringlet/gpu/device_buffers.h"

namespace ringlet {

namespace {

// momentum - 2 D v [mass unit m/s].
Vec3d givenByPairs(const layout::ContactSystem& system, const Vec3d& v) {
  const auto& [d, o, m] = system;
  const Vec3d Dv{d.x * v.x + o.z * v.y + o.y * v.z, o.z * v.x + d.y * v.y + o.x * v.z,
                 o.y * v.x + o.x * v.y + d.z * v.z};
  return Vec3d{m.x, m.y, m.z} - Dv * 2.0;
}

}  // namespace

Result<ContactMomentum> contactMomentum(const DeviceChunk& hair, const RestState& rest, ContactKinds kinds) {
  const std::size_t count = rest.points.size();
  auto systems = downloadAll<layout::ContactSystem>(hair.contactSystems, kinds.pairs ? count : 0);
  if (!systems) return systems.error();
  auto added = downloadAll<layout::vec4>(hair.addedByVolume, kinds.volume ? count : 0);
  if (!added) return added.error();
  auto solved = downloadAll<layout::vec4>(hair.solved, count);
  if (!solved) return solved.error();
  ContactMomentum all;
  for (std::size_t s = 0; s < hereCount(rest); ++s) {
    const layout::StrandRest& strand = rest.strands[s];
    for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i) {
      const Vec3d v{(*solved)[i].x, (*solved)[i].y, (*solved)[i].z};
      Vec3d J{};
      if (kinds.pairs) J = givenByPairs((*systems)[i], v);
      if (kinds.volume) {
        const layout::vec4& g = (*added)[i];
        J = J + Vec3d{g.x, g.y, g.z} - v * static_cast<double>(g.w);
      }
      J = J * static_cast<double>(strand.massUnit);
      all.sum = all.sum + J;
      all.sizes += length(J);
    }
  }
  return all;
}

}  // namespace ringlet
