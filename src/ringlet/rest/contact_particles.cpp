// Implements rest/contact_particles.h.
#include "ringlet/rest/contact_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "layout/strands.h"
#include "ringlet/groom/seeded_random.h"
#include "ringlet/rest/root_spacing.h"

namespace ringlet {
namespace {

// Roots closer than this on average [m] count as being in one place; no radius is smaller.
constexpr double kSmallestRadius = 1e-6;

std::span<const Vec3f> pointsOf(const RestState& rest, std::size_t strand) {
  const layout::StrandRest& s = rest.strands[strand];
  return std::span(rest.points).subspan(s.firstParticle, s.particleCount);
}

double distance(Vec3f a, Vec3f b) { return length(static_cast<Vec3d>(a) - static_cast<Vec3d>(b)); }

double meanEdgeLength(const RestState& rest) {
  double sum = 0;
  std::size_t edgeCount = 0;
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const auto points = pointsOf(rest, s);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) sum += distance(points[i], points[i + 1]);
    edgeCount += points.size() - 1;
  }
  return sum / static_cast<double>(edgeCount);
}

// The particles that are kept, and the largest distance between consecutive ones [m].
struct Pruned {
  std::vector<std::uint32_t> kept;
  double widestGap = 0;
};

Pruned pruneAlong(std::span<const Vec3f> points, double radius, double spacing) {
  const double R = 2 * radius;
  Pruned result{{0}, 0};
  const auto keep = [&](std::size_t j) {
    result.widestGap = std::max(result.widestGap, distance(points[result.kept.back()], points[j]));
    result.kept.push_back(static_cast<std::uint32_t>(j));
  };
  for (std::size_t j = 1; j < points.size(); ++j) {
    const std::size_t last = result.kept.back();
    const double apart = distance(points[last], points[j]);
    if (apart < spacing * R) continue;
    if (apart > R && j - 1 > last) {
      keep(j - 1);
      --j;  // and measure again from there
    } else {
      keep(j);
    }
  }
  return result;
}

float roundedUp(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

double massOf(const RestState& rest, std::size_t strand) {
  const layout::StrandRest& s = rest.strands[strand];
  double units = 0;
  for (std::uint32_t i = 0; i < s.particleCount; ++i) units += rest.particles[s.firstParticle + i].mass;
  return units * s.massUnit;
}

}  // namespace

double radiusOfRoots(const RestState& rest) {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    roots.push_back(static_cast<Vec3d>(pointsOf(rest, s)[0]));
  }
  const double half = meanNearestDistance(roots) / 2;
  return std::max(half >= kSmallestRadius ? half : meanEdgeLength(rest) / 2, kSmallestRadius);
}

ContactParticles chooseContactParticles(const RestState& rest, const ContactSettings& settings) {
  ContactParticles contacts;
  contacts.baseRadius = settings.radius.value_or(radiusOfRoots(rest));
  contacts.firstOfStrand.push_back(0);
  std::size_t gappyCount = 0, coarsest = 0;
  double widestGap = 0;
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const auto points = pointsOf(rest, s);
    float radius = roundedUp(contacts.baseRadius * settings.radiusFactor(rest.strandInGroom[s]));
    Pruned pruned = pruneAlong(points, radius, settings.spacing);
    const bool hasGaps = pruned.widestGap > 2.0 * radius;
    widestGap = std::max(widestGap, pruned.widestGap);
    // Each turn raises the radius to half the length of another edge, so the loop ends, usually after one or
    // two turns.
    while (settings.fillGaps && pruned.widestGap > 2.0 * radius) {
      radius = roundedUp(pruned.widestGap / 2);
      pruned = pruneAlong(points, radius, settings.spacing);
    }
    if (hasGaps && (gappyCount++ == 0 || radius > contacts.radii[coarsest])) coarsest = s;
    for (std::uint32_t i : pruned.kept) {
      contacts.particles.push_back(rest.strands[s].firstParticle + i);
      contacts.strands.push_back(static_cast<std::uint32_t>(s));
    }
    contacts.firstOfStrand.push_back(static_cast<std::uint32_t>(contacts.particles.size()));
    contacts.radii.push_back(radius);
    contacts.masses.push_back(static_cast<float>(massOf(rest, s) / static_cast<double>(pruned.kept.size())));
  }
  if (gappyCount > 0 && !settings.fillGaps) {
    contacts.warnings.push_back(fmt::format(
        "the particles of {} of {} strands stand further apart (to {:.3g} mm) than twice the contact radius "
        "of {:.3g} mm: hair may slip through between them; cut it finer, set a larger radius, or have gaps "
        "filled",
        gappyCount, rest.strands.size(), 1000 * widestGap, 1000 * contacts.baseRadius));
  } else if (gappyCount > 0) {
    contacts.warnings.push_back(fmt::format(
        "the contact radius of {} of {} strands is raised from {:.3g} mm, to {:.3g} mm at most (strand {}), "
        "because their particles stand further apart than twice the radius; cut them finer, or set a larger "
        "radius",
        gappyCount, rest.strands.size(), 1000 * contacts.baseRadius, 1000 * contacts.radii[coarsest],
        rest.strandInGroom[coarsest]));
  }
  return contacts;
}

ContactParticles thinWhereDense(const ContactParticles& all, const RestState& rest, const DenseStrands& dense,
                                const ContactSettings& settings) {
  const auto asked = static_cast<std::uint32_t>(std::lround(1 / settings.detail));
  ContactParticles thinned = all;
  thinned.particles.clear();
  thinned.strands.clear();
  for (std::uint32_t s = 0; s < all.strandCount(); ++s) {
    const std::uint32_t first = all.firstOfStrand[s], end = all.firstOfStrand[s + 1];
    const std::uint32_t q = dense.isIn[s] ? std::clamp((end - first) / 2, 1u, asked) : 1;
    const auto phase =
        static_cast<std::uint32_t>(q * SeededRandom(settings.seed, rest.strandInGroom[s]).uniform());
    for (std::uint32_t c = first + phase; c < end; c += q) {
      thinned.particles.push_back(all.particles[c]);
      thinned.strands.push_back(s);
    }
    thinned.firstOfStrand[s + 1] = static_cast<std::uint32_t>(thinned.particles.size());
    thinned.radii[s] = static_cast<float>(all.radii[s] * std::pow(q, kThinnedRadiusPower));
    thinned.masses[s] = static_cast<float>(q * q) * all.masses[s];
  }
  return thinned;
}

}  // namespace ringlet
