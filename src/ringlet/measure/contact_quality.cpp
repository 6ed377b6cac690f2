// Implements measure/contact_quality.h.
#include "ringlet/measure/contact_quality.h"

#include <algorithm>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/box_pairs.h"

namespace ringlet {

namespace {

// Calls visit(a, b, overlap) for every pair closer than R, with its strands in device order and its overlap
// beyond rest.
template <class Visit>
void visitOverlaps(const RestState& rest, const RestContacts& contacts, std::span<const Vec3f> positions,
                   const Visit& visit) {
  const auto& particles = contacts.allParticles();
  RINGLET_ASSERT(positions.size() == rest.groomParticleCount, "one position per particle");
  std::vector<Box> boxes;
  std::vector<Vec3d> restPoints;
  for (std::size_t i = 0; i < particles.particles.size(); ++i) {
    const std::uint32_t strand = particles.strands[i], particle = particles.particles[i];
    const std::uint32_t inGroom = rest.firstInGroom[strand] + particle - rest.strands[strand].firstParticle;
    const double radius = particles.radii[strand];
    boxes.push_back({static_cast<Vec3d>(positions[inGroom]), {radius, radius, radius}});
    restPoints.push_back(static_cast<Vec3d>(rest.points[particle]));
  }
  const BoxPairs pairs(boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    pairs.visitPartners(i, [&](std::size_t j) {
      const std::uint32_t a = particles.strands[i], b = particles.strands[j];
      const double R = double{particles.radii[a]} + double{particles.radii[b]};
      const double d = length(boxes[i].centre - boxes[j].centre);
      if (a == b || !(d < R) || contacts.volume.inOneBundle(a, b)) return;
      const double restLength = std::min(R, length(restPoints[i] - restPoints[j]));
      visit(a, b, std::max(0.0, restLength - d) / R);
    });
  }
}

}  // namespace

ContactQuality measureContacts(const RestState& rest, const RestContacts& contacts,
                               std::span<const Vec3f> positions) {
  ContactQuality quality;
  std::uint64_t allowed = 0;
  visitOverlaps(rest, contacts, positions, [&](std::uint32_t a, std::uint32_t b, double overlap) {
    ++quality.overlapping;
    allowed += contacts.graph.allows(a, b);
    quality.overlapBeyondRestSum += overlap;
    quality.deepestOverlap = std::max(quality.deepestOverlap, overlap);
  });
  if (quality.overlapping > 0) {
    quality.rawRecall = static_cast<double>(allowed) / static_cast<double>(quality.overlapping);
  }
  return quality;
}

std::vector<float> overlapOfStrands(const RestState& rest, const RestContacts& contacts,
                                    std::span<const Vec3f> positions) {
  std::vector<float> deepest(rest.groomStrandCount);
  visitOverlaps(rest, contacts, positions, [&](std::uint32_t a, std::uint32_t b, double overlap) {
    for (const std::uint32_t strand : {a, b}) {
      float& its = deepest[rest.strandInGroom[strand]];
      its = std::max(its, static_cast<float>(overlap));
    }
  });
  return deepest;
}

Result<ContactRuler> ContactRuler::make(const Groom& groom, const Material& material,
                                        const Settings& settings) {
  auto rest = buildRestState(groom, material, settings);
  if (!rest) return rest.error();
  RestContacts contacts = buildRestContacts(*rest, settings.contacts);
  if (settings.contacts.on) std::ranges::copy(contacts.warnings(), std::back_inserter(rest->warnings));
  return ContactRuler(std::move(*rest), std::move(contacts));
}

}  // namespace ringlet
