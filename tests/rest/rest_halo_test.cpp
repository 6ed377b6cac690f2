// rest/rest_halo.h and rest/rest_part.h: what parts of hair know of each other agrees, and is enough.
#include "ringlet/rest/rest_halo.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/rest_part.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::test::rest_halo_test {
namespace {

struct Whole {
  RestState rest;
  RestContacts contacts;
  std::vector<std::size_t> partOf;
};

constexpr std::size_t kParts = 3, kStrands = 180;

// A head whose strands are in three parts, side by side.
Whole dividedHead(bool prunes) {
  HeadParameters head{.strandCount = kStrands};
  head.curl.particleCount = 16;
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.prunePairs = prunes;
  settings.contacts.minOverlaps = 1;
  Whole whole{*buildRestState(*makeHead(head), {}, settings), {}, {}};
  whole.contacts = buildRestContacts(whole.rest, settings.contacts);
  for (const layout::StrandRest& strand : whole.rest.strands) {
    const float x = whole.rest.points[strand.firstParticle].x;
    whole.partOf.push_back(x < -0.03f ? 0 : x < 0.03f ? 1 : 2);
  }
  return whole;
}

std::vector<std::uint32_t> inGroom(const RestState& rest, const std::vector<std::uint32_t>& strands) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t s : strands) all.push_back(rest.strandInGroom[s]);
  return all;
}

TEST(RestHalo, HoldsWhatOwnStrandsMayTouch) {
  for (const bool prunes : {true, false}) {
    const Whole whole = dividedHead(prunes);
    std::size_t known = 0;
    for (std::size_t own = 0; own < kParts; ++own) {
      const RestHalo halo = haloOf(whole.contacts, whole.partOf, own);
      for (std::uint32_t a = 0; a < whole.partOf.size(); ++a) {
        bool isNear = false;
        for (std::uint32_t b = 0; b < whole.partOf.size(); ++b)
          isNear = isNear || (b != a && whole.partOf[b] == own && whole.contacts.graph.allows(b, a));
        const bool isHere = whole.partOf[a] == own;
        EXPECT_EQ(std::ranges::count(halo.here, a), isHere) << "strand " << a;
        EXPECT_EQ(std::ranges::count(halo.around, a), isNear && !isHere) << "strand " << a;
        known += isHere || isNear;
      }
    }
    EXPECT_GT(known, whole.partOf.size());
    EXPECT_EQ(known < kParts * whole.partOf.size(), prunes);
  }
}

TEST(RestHalo, PartsExpectWhatTheOthersSend) {
  const Whole whole = dividedHead(true);
  std::vector<RestHalo> halos;
  for (std::size_t own = 0; own < kParts; ++own) halos.push_back(haloOf(whole.contacts, whole.partOf, own));
  std::size_t messages = 0;
  for (std::size_t own = 0; own < kParts; ++own) {
    for (const RestHalo::Peer& peer : halos[own].peers) {
      const auto theirs = std::ranges::find(halos[peer.part].peers, own, &RestHalo::Peer::part);
      ASSERT_NE(theirs, halos[peer.part].peers.end());
      EXPECT_EQ(theirs->in, peer.out);
      EXPECT_EQ(theirs->out, peer.in);
      for (const std::uint32_t s : peer.out) EXPECT_EQ(whole.partOf[s], own);
      ++messages;
    }
  }
  EXPECT_GT(messages, 0u);
}

// Those that others may touch come first: they are stepped first, and their rows sent.
TEST(RestHalo, TheBorderComesFirst) {
  const Whole whole = dividedHead(true);
  for (std::size_t own = 0; own < kParts; ++own) {
    const RestHalo halo = haloOf(whole.contacts, whole.partOf, own);
    std::set<std::uint32_t> sent;
    for (const RestHalo::Peer& peer : halo.peers) sent.insert(peer.out.begin(), peer.out.end());
    const std::span all(halo.here);
    const auto border = all.first(halo.borderCount), inner = all.subspan(halo.borderCount);
    EXPECT_TRUE(std::ranges::equal(border, sent));
    EXPECT_TRUE(std::ranges::is_sorted(inner));
    EXPECT_FALSE(border.empty() || inner.empty());
  }
}

// In a part strands, particles and neighbours have other numbers; they are the same.
TEST(RestHalo, WhatIsKeptIsTheWholes) {
  const Whole whole = dividedHead(true);
  for (std::size_t own = 0; own < kParts; ++own) {
    const RestHalo before = haloOf(whole.contacts, whole.partOf, own);
    Whole part = whole;
    std::optional<RestVolume> none;
    RestHalo halo = before;
    restrictTo({part.rest, part.contacts, none}, halo);
    ASSERT_EQ(halo.here.size() + halo.around.size(), part.rest.strands.size());
    ASSERT_EQ(halo.around.size(), part.rest.haloCount);
    const ContactParticles &all = whole.contacts.particles, &kept = part.contacts.particles;
    for (std::size_t c = 0; c < kept.particles.size(); ++c) {
      const std::uint32_t in = part.contacts.inWhole[c];
      EXPECT_EQ(part.rest.points[kept.particles[c]], whole.rest.points[all.particles[in]]);
      EXPECT_EQ(part.rest.strandInGroom[kept.strands[c]], whole.rest.strandInGroom[all.strands[in]]);
      EXPECT_EQ(kept.radii[kept.strands[c]], all.radii[all.strands[in]]);
    }
    EXPECT_EQ(inGroom(part.rest, halo.here), inGroom(whole.rest, before.here));
    EXPECT_EQ(inGroom(part.rest, halo.around), inGroom(whole.rest, before.around));
    const auto neighbours = [&](const Whole& hair, std::uint32_t strand) {
      const ContactGraph& graph = hair.contacts.graph;
      auto some = inGroom(hair.rest, {graph.neighbours.begin() + graph.firstNeighbour[strand],
                                      graph.neighbours.begin() + graph.firstNeighbour[strand + 1]});
      std::ranges::sort(some);
      return some;
    };
    for (std::size_t k = 0; k < halo.here.size(); ++k)
      EXPECT_EQ(neighbours(part, halo.here[k]), neighbours(whole, before.here[k]));
    for (const std::uint32_t s : halo.around) EXPECT_TRUE(neighbours(part, s).empty());
    for (std::size_t k = 0; k < halo.peers.size(); ++k)
      EXPECT_EQ(inGroom(part.rest, halo.peers[k].in), inGroom(whole.rest, before.peers[k].in));
  }
}

TEST(RestHalo, EveryStrandIsInOnePart) {
  const Whole whole = dividedHead(true);
  std::vector<std::vector<std::uint32_t>> parts(2);
  for (std::uint32_t s = 0; s < kStrands; ++s) parts[s % 2].push_back(s);
  EXPECT_TRUE(partOfEach(parts, whole.rest));
  parts[0].push_back(1);
  EXPECT_NE(partOfEach(parts, whole.rest).error().message.find("strand 1 is in 2 parts"), std::string::npos);
  parts[0].pop_back(), parts[0].pop_back();
  EXPECT_NE(partOfEach(parts, whole.rest)
                .error()
                .message.find(fmt::format("strand {} is in 0 parts", kStrands - 2)),
            std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::rest_halo_test
