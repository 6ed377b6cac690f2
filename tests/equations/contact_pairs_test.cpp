// Tests reference/kernels/contact_pairs.h: the grid against all pairs.
#include "reference/kernels/contact_pairs.h"

#include <gtest/gtest.h>

#include "tests/equations/strand_fixtures.h"

namespace ringlet::reference::test::contact_pairs_test {
namespace {

// Two particles a strand, the first of every fifth strand pinned.
std::vector<ContactParticle> particlesOf(std::size_t count) {
  std::vector<ContactParticle> particles;
  for (std::uint32_t k = 0; k < count; ++k) {
    particles.push_back({.index = k, .strand = k / 2, .isPinned = k % 10 == 0});
  }
  return particles;
}

std::vector<ContactPair> allPairs(const RestContacts& rest, const std::vector<ContactParticle>& particles,
                                  const Field<double>& places, const Scalars<double>& reaches) {
  std::vector<ContactPair> pairs;
  for (std::uint32_t a = 0; a < particles.size(); ++a) {
    for (std::uint32_t b = a + 1; b < particles.size(); ++b) {
      if ((places[a] - places[b]).norm() > reaches[a] + reaches[b]) continue;
      if (mayTouch(rest, particles[a], particles[b])) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(ContactPairs, TheGridFindsAllPairs) {
  std::mt19937 random(7);
  const std::size_t count = 600;
  const auto particles = particlesOf(count);
  RestContacts all{.prunesPairs = false};
  RestContacts odd{.prunesPairs = true};  // even strands may touch odd ones
  const std::uint32_t strandCount = count / 2;
  for (std::uint32_t s = 0; s < strandCount; ++s) {
    odd.neighbours.emplace_back();
    for (std::uint32_t t = 1 - s % 2; t < strandCount; t += 2) odd.neighbours[s].push_back(t);
  }
  const Vector3<double> faraway(1e4, -2e3, 5e5);
  const Field<double> cloud = randomField(random, count, 0.2);
  Field<double> line, cluster, far;
  for (const Vector3<double>& p : cloud) {
    line.push_back({p.x(), 0, 0});
    cluster.push_back(p.x() > 0 ? p : Vector3<double>(0.001 * p));
    far.push_back(p + faraway);
  }
  for (const auto& places : {cloud, line, cluster, far, Field<double>(count, Vector3<double>::Zero())}) {
    Scalars<double> reaches;
    for (std::size_t k = 0; k < count; ++k) reaches.push_back(0.01 + 0.01 * (k % 7 == 0));
    for (const RestContacts& rest : {all, odd}) {
      const auto found = nearPairs(rest, particles, places, reaches).pairs;
      EXPECT_EQ(found, allPairs(rest, particles, places, reaches));
      EXPECT_GT(found.size(), 0u);
    }
  }
}

TEST(ContactPairs, WhatIsNotFiniteOrHasNoReachHasNoPairs) {
  const auto particles = particlesOf(8);
  Field<double> places(8, Vector3<double>::Zero());
  Scalars<double> reaches(8, 0.01);
  reaches[6] = reaches[7] = 0;
  places[2].x() = std::nan("");
  reaches[4] = std::numeric_limits<double>::infinity();
  const std::vector<ContactPair> expected{{0, 3}, {0, 5}, {1, 3}, {1, 5}, {3, 5}};
  EXPECT_EQ(nearPairs(RestContacts{.prunesPairs = false}, particles, places, reaches).pairs, expected);
}

TEST(ContactPairs, PinnedParticlesDoNotTouchEachOther) {
  auto particles = particlesOf(4);
  particles[2].isPinned = true;
  const Field<double> places(4, Vector3<double>::Zero());
  const std::vector<ContactPair> expected{{0, 3}, {1, 2}, {1, 3}};
  EXPECT_EQ(nearPairs(RestContacts{.prunesPairs = false}, particles, places, Scalars<double>(4, 0.01)).pairs,
            expected);
}

}  // namespace
}  // namespace ringlet::reference::test::contact_pairs_test
