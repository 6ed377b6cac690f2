// Grooms for the tests of contacts: from the everyday to the degenerate, all in metres, from fixed seeds.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/rest/contact_particles.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet::test {

/// A straight strand [m].
inline std::vector<Vec3f> line(Vec3d from, Vec3d to, int particles) {
  std::vector<Vec3f> points;
  for (int i = 0; i < particles; ++i)
    points.push_back(static_cast<Vec3f>(from + (to - from) * (static_cast<double>(i) / (particles - 1))));
  return points;
}

inline Groom metres() {
  Groom groom;
  groom.metresPerUnit = 1;
  return groom;
}

/// Strands that wander down from roots spread over a box, in edges of about `edge` [m] of any direction.
inline void addWandering(Groom& groom, int strandCount, int mostParticles, Vec3d about, Vec3d spread,
                         double edge, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-0.5, 0.5), share(0.2, 1);
  std::uniform_int_distribution<int> particles(2, mostParticles);
  for (int s = 0; s < strandCount; ++s) {
    Vec3d at = about + Vec3d{spread.x * side(random), spread.y * side(random), spread.z * side(random)};
    std::vector<Vec3f> strand{static_cast<Vec3f>(at)};
    for (int i = particles(random); i > 1; --i) {
      at += Vec3d{side(random), side(random) - 0.4, side(random)} * (2 * edge * share(random));
      strand.push_back(static_cast<Vec3f>(at));
    }
    groom.addStrand(strand);
  }
}

struct ContactSample {
  std::string name;
  Groom groom;
};

/// What detection must get right: spread, clustered, in one cell, in one line, far from the origin, of any
/// edge lengths, of two particles, one in another.
inline std::vector<ContactSample> contactSamples() {
  std::vector<ContactSample> samples;
  const auto add = [&](const char* name) -> Groom& {
    samples.push_back({name, metres()});
    return samples.back().groom;
  };
  addWandering(add("one strand"), 1, 40, {}, {}, 0.005, 1);
  addWandering(add("two strands"), 2, 40, {}, {0.01, 0, 0.01}, 0.005, 2);
  addWandering(add("spread"), 120, 40, {}, {0.15, 0, 0.15}, 0.005, 3);
  Groom& clustered = add("clustered");
  for (unsigned k = 0; k < 4; ++k)
    addWandering(clustered, 30, 30, {0.7 * k * k, 0, -2.0 * k}, {0.02, 0.01, 0.02}, 0.004, 40 + k);
  addWandering(add("one cell"), 60, 20, {}, {1e-4, 1e-4, 1e-4}, 1e-5, 5);
  Groom& rows = add("one line");
  for (int s = 0; s < 60; ++s) rows.addStrand(line({0.01 * s, 0, 0}, {0.01 * s + 0.1, 0, 0}, 20));
  addWandering(add("far from the origin"), 120, 40, {900, -1500, 300}, {0.15, 0, 0.15}, 0.005, 6);
  Groom& mixed = add("any edges");
  addWandering(mixed, 80, 60, {}, {0.15, 0, 0.15}, 0.003, 7);
  addWandering(mixed, 20, 8, {}, {0.15, 0, 0.15}, 0.04, 8);
  mixed.addStrand(line({-0.3, 0, 0}, {0.3, -0.1, 0}, 2));  // one edge across all the others
  Groom& same = add("one in another");
  for (int s = 0; s < 5; ++s) addWandering(same, 6, 20, {}, {0.03, 0, 0.03}, 0.005, 9);
  Groom& folded = add("folded, with particles in one place");
  for (int s = 0; s < 20; ++s) {
    const double x = 0.004 * s;
    std::vector<Vec3f> strand = line({x, 0, 0}, {x, -0.05, 0}, 12);
    strand.insert(strand.begin() + 4, 3, strand[4]);
    for (Vec3f p : line({x, -0.05, 0}, {x, -0.01, 0.001f}, 10)) strand.push_back(p);
    folded.addStrand(strand);
  }
  return samples;
}

/// The rest state of a groom that is right.
inline RestState restOf(const Groom& groom, std::span<const std::uint32_t> order = {}) {
  auto rest = buildRestState(groom, {}, {}, order);
  RINGLET_ASSERT(rest, "the sample groom is right");
  return std::move(*rest);
}

}  // namespace ringlet::test
