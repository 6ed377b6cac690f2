// groom/edge_chains.h: single edges in any order become strands, and what is no strand is refused.
#include "ringlet/groom/edge_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/groom/groom_samples.h"

namespace ringlet::edge_chains_test {
namespace {

using Points = std::vector<std::uint32_t>;

std::vector<ListedEdge> listed(std::initializer_list<std::pair<int, int>> pairs) {
  std::vector<ListedEdge> edges;
  for (auto [from, to] : pairs) {
    edges.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), edges.size() + 1});
  }
  return edges;
}

TEST(EdgeChains, JoinsConsecutiveEdges) {
  const auto [chains, leftOut] = joinEdges(listed({{0, 1}, {1, 2}, {2, 3}, {5, 4}, {4, 6}}), 7);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].points, (Points{0, 1, 2, 3}));
  EXPECT_EQ(chains[1].points, (Points{5, 4, 6}));
  EXPECT_EQ(chains[1].firstLine, 4u);
  EXPECT_TRUE(chains[1].isOneDirection);
}

TEST(EdgeChains, JoinsShuffledEdgesOfManyStrands) {
  // Strand s is the points s, s + 50, s + 100, ...: known beforehand, whatever the order of its edges.
  std::vector<ListedEdge> edges;
  for (std::uint32_t s = 0; s < 50; ++s) {
    for (std::uint32_t i = 0; i < 9; ++i) edges.push_back({s + 50 * i, s + 50 * (i + 1), 0});
  }
  std::mt19937 random(3);
  for (std::size_t i = edges.size() - 1; i > 0; --i) std::swap(edges[i], edges[random() % (i + 1)]);
  for (std::size_t i = 0; i < edges.size(); ++i) edges[i].line = i + 1;

  const auto [chains, leftOut] = joinEdges(edges, 500);
  ASSERT_EQ(chains.size(), 50u);
  std::size_t lastLine = 0;
  for (const EdgeChain& chain : chains) {
    ASSERT_EQ(chain.points.size(), 10u);
    EXPECT_LT(chain.points.front(), 50u);
    for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(chain.points[i], chain.points[0] + 50 * i);
    EXPECT_GT(chain.firstLine, lastLine);  // in the order of first mention
    lastLine = chain.firstLine;
  }
}

TEST(EdgeChains, MostEdgesDecideTheDirection) {
  const auto [chains, leftOut] = joinEdges(listed({{1, 0}, {1, 2}, {2, 3}, {4, 5}, {6, 5}}), 7);
  EXPECT_EQ(chains[0].points, (Points{0, 1, 2, 3}));
  EXPECT_FALSE(chains[0].isOneDirection);
  EXPECT_EQ(chains[1].points, (Points{4, 5, 6}));  // a tie: as the first listed edge runs

  // Whichever way that is from the end which the file names first.
  const auto [ties, none] = joinEdges(listed({{1, 0}, {1, 2}, {3, 4}, {5, 4}, {7, 6}, {7, 8}}), 9);
  ASSERT_EQ(ties.size(), 3u);
  EXPECT_EQ(ties[0].points, (Points{2, 1, 0}));
  EXPECT_EQ(ties[1].points, (Points{3, 4, 5}));
  EXPECT_EQ(ties[2].points, (Points{8, 7, 6}));
}

TEST(EdgeChains, LeavesOutBranchesAndLoopsWithTheLineOfTheFirst) {
  // What hangs together goes together; the strand 7, 8, 9 stays.
  const struct {
    std::vector<std::pair<int, int>> edges;
    const char* says;
  } kCases[] = {{{{0, 1}, {1, 2}, {1, 3}}, "line 3: found a third edge at point 2"},
                {{{1, 3}, {0, 1}, {3, 4}, {1, 2}, {5, 4}}, "line 4: found a third edge at point 2"},
                {{{0, 1}, {1, 2}, {2, 0}}, "line 1: found an edge of a closed loop"},
                {{{0, 1}, {1, 0}}, "line 1: found an edge of a closed loop"},
                {{{2, 2}}, "line 1: found an edge from point 3 to itself"}};
  for (const auto& one : kCases) {
    std::vector<ListedEdge> edges;
    for (const auto& [from, to] : one.edges)
      edges.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), edges.size() + 1});
    edges.push_back({7, 8, edges.size() + 1});
    edges.push_back({8, 9, edges.size() + 1});
    const auto [chains, leftOut] = joinEdges(edges, 10);
    ASSERT_EQ(chains.size(), 1u) << one.says;
    EXPECT_EQ(chains[0].points, (Points{7, 8, 9})) << one.says;
    EXPECT_EQ(leftOut.count, 1u) << one.says;
    EXPECT_TRUE(test::contains(leftOut.first, one.says)) << leftOut.first;
  }
  // The first is the topmost of the file, whatever it is; of one part, once.
  const auto [none, all] = joinEdges(listed({{0, 1}, {1, 0}, {2, 3}, {3, 4}, {3, 5}, {3, 6}, {7, 7}}), 8);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(all.count, 3u);
  EXPECT_TRUE(test::contains(all.first, "line 1: found an edge of a closed loop")) << all.first;
}

TEST(EdgeChains, NothingGivesNothing) {
  const auto [chains, leftOut] = joinEdges({}, 0);
  EXPECT_TRUE(chains.empty());
}

}  // namespace
}  // namespace ringlet::edge_chains_test
