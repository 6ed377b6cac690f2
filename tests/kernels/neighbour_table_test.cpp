// solver/contacts/neighbour_table.h: what contact_query.comp looks up in it is what the graph allows.
#include "ringlet/solver/contacts/neighbour_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "layout/contacts.h"

namespace ringlet::test::neighbour_table_test {
namespace {

using Table = std::vector<std::array<std::uint32_t, 4>>;

// As contact_query.comp.
bool mayTouch(const Table& table, std::uint32_t a, std::uint32_t b) {
  const auto [first, mask, unused, none] = table[a];
  std::uint32_t bucket = b * 2654435761u >> 16;
  for (std::uint32_t tried = 0; tried <= mask; ++tried, ++bucket) {
    const auto& four = table.at(first + (bucket & mask));
    if (std::ranges::find(four, b) != four.end()) return true;
    if (std::ranges::find(four, layout::kNoStrand) != four.end()) return false;
  }
  return false;
}

ContactGraph graphOf(std::uint32_t strandCount,
                     const std::set<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  ContactGraph graph;
  for (std::uint32_t a = 0; a < strandCount; ++a) {
    graph.firstNeighbour.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
    for (std::uint32_t b = 0; b < strandCount; ++b) {
      if (pairs.contains({std::min(a, b), std::max(a, b)})) graph.neighbours.push_back(b);
    }
  }
  graph.firstNeighbour.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
  return graph;
}

// Each strand a group by itself, but the last: that is in the first one's.
VolumeStrands alone(std::uint32_t strandCount) {
  VolumeStrands volume;
  for (std::uint32_t s = 0; s < strandCount; ++s) volume.groups.push_back(s);
  volume.groups.back() = 0;
  volume.isIn.assign(strandCount, false);
  return volume;
}

TEST(NeighbourTable, HoldsGroups) {
  for (const bool everyPair : {false, true}) {
    ContactGraph graph = graphOf(5, {{0, 3}});
    graph.everyPair = everyPair;
    const Table table = neighbourTable(graph, alone(5));
    for (std::uint32_t s = 0; s < 5; ++s) {
      EXPECT_EQ(table[s][2], s == 4 ? 0 : s);
    }
  }
}

TEST(NeighbourTable, HoldsWhatTheGraphAllows) {
  std::mt19937 random(9);
  for (const double density : {0.0, 0.01, 0.3, 1.0}) {
    constexpr std::uint32_t kStrands = 150;
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t a = 0; a < kStrands; ++a) {
      for (std::uint32_t b = a + 1; b < kStrands; ++b) {
        if (std::bernoulli_distribution(density)(random)) pairs.insert({a, b});
      }
    }
    const ContactGraph graph = graphOf(kStrands, pairs);
    const Table table =
        neighbourTable(graph, alone(static_cast<std::uint32_t>(graph.firstNeighbour.size() - 1)));
    EXPECT_LE(table.size(), kStrands + 2 * kStrands + graph.neighbours.size());
    for (std::uint32_t a = 0; a < kStrands; ++a) {
      for (std::uint32_t b = 0; b < kStrands; ++b) {
        if (a == b) continue;
        EXPECT_EQ(mayTouch(table, a, b), graph.allows(a, b)) << a << ", " << b;
      }
    }
  }
}

// Strands whose hashes are alike fill bucket after bucket.
TEST(NeighbourTable, StandsAlikeHashes) {
  ContactGraph graph;
  graph.firstNeighbour = {0, 0};
  for (std::uint32_t b = 1; graph.neighbours.size() < 64; ++b) {
    if ((b * 2654435761u >> 16 & 31) == 7) graph.neighbours.push_back(b);
  }
  graph.firstNeighbour[1] = 64;
  const Table table =
      neighbourTable(graph, alone(static_cast<std::uint32_t>(graph.firstNeighbour.size() - 1)));
  for (const std::uint32_t b : graph.neighbours) EXPECT_TRUE(mayTouch(table, 0, b)) << b;
  EXPECT_FALSE(mayTouch(table, 0, graph.neighbours.back() + 1));
}

}  // namespace
}  // namespace ringlet::test::neighbour_table_test
