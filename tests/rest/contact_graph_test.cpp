// rest/contact_graph.h: overlaps against all pairs of particles, pruning against its law.
#include "ringlet/rest/contact_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/strand_order.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::contact_graph_test {
namespace {

using namespace test;

std::vector<StrandOverlap> byAllPairs(const RestState& rest, const ContactParticles& contacts,
                                      double enlargement) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> counts;
  const auto at = [&](std::size_t i) { return static_cast<Vec3d>(rest.points[contacts.particles[i]]); };
  for (std::size_t i = 0; i < contacts.particles.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.particles.size(); ++j) {
      const std::uint32_t a = contacts.strands[i], b = contacts.strands[j];
      const double reach = enlargement * (double{contacts.radii[a]} + double{contacts.radii[b]});
      if (a != b && length(at(i) - at(j)) < reach) ++counts[{a, b}];
    }
  }
  std::vector<StrandOverlap> overlaps;
  for (const auto& [strands, count] : counts) overlaps.push_back({strands.first, strands.second, count});
  return overlaps;
}

struct Prepared {
  RestState rest;
  ContactParticles contacts;
  std::vector<StrandOverlap> overlaps;

  explicit Prepared(const Groom& groom, std::span<const std::uint32_t> order = {})
      : rest(restOf(groom, order)),
        contacts(chooseContactParticles(rest, {})),
        overlaps(countOverlaps(rest, contacts, 1.5)) {}
  ContactGraph pruned(const ContactSettings& settings) const {
    return pruneStrandPairs(overlaps, rest, settings);
  }
};

using GroomPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

// The graph's pairs by places in the groom; checks its arrays on the way.
GroomPairs pairsOf(const ContactGraph& graph, const RestState& rest) {
  GroomPairs pairs;
  EXPECT_EQ(graph.firstNeighbour.size(), rest.strands.size() + 1);
  EXPECT_EQ(graph.firstNeighbour.back(), graph.neighbours.size());
  for (std::uint32_t a = 0; a < rest.strands.size(); ++a) {
    for (std::uint32_t k = graph.firstNeighbour[a]; k < graph.firstNeighbour[a + 1]; ++k) {
      const std::uint32_t b = graph.neighbours[k];
      EXPECT_NE(a, b);
      EXPECT_TRUE(k == graph.firstNeighbour[a] || graph.neighbours[k - 1] < b) << "not ascending";
      EXPECT_TRUE(graph.allows(a, b) && graph.allows(b, a)) << "not symmetric";
      pairs.insert(std::minmax(rest.strandInGroom[a], rest.strandInGroom[b]));
    }
  }
  EXPECT_EQ(pairs.size(), graph.pairs);
  EXPECT_EQ(2 * pairs.size(), graph.neighbours.size());
  return pairs;
}

ContactSettings settingsWith(int minOverlaps, int maxNeighbours = 0, double dropShare = 0,
                             std::uint32_t seed = 1) {
  ContactSettings settings;
  settings.prunePairs = true;
  settings.minOverlaps = minOverlaps;
  settings.maxNeighbours = maxNeighbours;
  settings.dropShare = dropShare;
  settings.seed = seed;
  return settings;
}

TEST(ContactGraph, OverlapsAreThoseOfAllPairs) {
  for (const ContactSample& sample : contactSamples()) {
    const Prepared p(sample.groom);
    for (double enlargement : {1.0, 1.5, 4.0}) {
      const auto overlaps = countOverlaps(p.rest, p.contacts, enlargement);
      EXPECT_EQ(overlaps, byAllPairs(p.rest, p.contacts, enlargement)) << sample.name << " " << enlargement;
      EXPECT_EQ(overlaps.empty(), sample.groom.strandCount() == 1) << sample.name;
    }
  }
}

// Radii from one to some hundred times the least: spheres of several sizes of cells meet.
TEST(ContactGraph, OverlapsOfAnyRadiiAreThoseOfAllPairs) {
  ContactSettings gapless;
  gapless.fillGaps = true;
  gapless.radius = 0.001;
  for (const ContactSample& sample : contactSamples()) {
    const RestState rest = restOf(sample.groom);
    const ContactParticles contacts = chooseContactParticles(rest, gapless);
    for (double enlargement : {1.0, 3.0})
      EXPECT_EQ(countOverlaps(rest, contacts, enlargement), byAllPairs(rest, contacts, enlargement))
          << sample.name << " " << enlargement;
  }
}

TEST(ContactGraph, ParallelLinesOverlapAsCounted) {
  // Spheres h apart along two lines D apart: i and j overlap where D^2 + ((i - j) h)^2 < E^2.
  Groom groom = metres();
  const double h = 0.004, D = 0.006, r = 0.0025, E = 1.5 * 2 * r;
  const int n = 30;
  groom.addStrand(line({}, {0, -h * (n - 1), 0}, n));
  groom.addStrand(line({D, 0, 0}, {D, -h * (n - 1), 0}, n));
  const RestState rest = restOf(groom);
  ContactSettings settings;
  settings.radius = r;
  settings.spacing = 0.75;  // 3.75 mm: every particle
  const ContactParticles contacts = chooseContactParticles(rest, settings);
  ASSERT_EQ(contacts.particles.size(), 2u * n);
  std::uint32_t expected = 0;
  for (int apart = -n; apart <= n; ++apart)
    if (D * D + apart * h * apart * h < E * E) expected += static_cast<std::uint32_t>(n - std::abs(apart));
  EXPECT_EQ(countOverlaps(rest, contacts, 1.5), (std::vector<StrandOverlap>{{0, 1, expected}}));
}

TEST(ContactGraph, KeepsPairsOfEnoughOverlaps) {
  for (const ContactSample& sample : contactSamples()) {
    const Prepared p(sample.groom);
    for (int least : {1, 4, 8, 30}) {
      const ContactGraph graph = p.pruned(settingsWith(least));
      GroomPairs expected;
      std::uint64_t spheres = 0, spheresKept = 0;
      for (const StrandOverlap& o : p.overlaps) {
        spheres += o.count;
        if (o.count < static_cast<std::uint32_t>(least)) continue;
        spheresKept += o.count;
        expected.insert(std::minmax(p.rest.strandInGroom[o.a], p.rest.strandInGroom[o.b]));
      }
      EXPECT_EQ(pairsOf(graph, p.rest), expected) << sample.name;
      EXPECT_EQ(graph.pairsUnpruned, p.overlaps.size());
      EXPECT_EQ(graph.overlapsUnpruned, spheres);
      EXPECT_EQ(graph.overlaps, spheresKept);
    }
  }
}

TEST(ContactGraph, BoundsNeighboursAndKeepsTheStrongest) {
  for (const ContactSample& sample : contactSamples()) {
    const Prepared p(sample.groom);
    for (int most : {1, 3, 10}) {
      const ContactGraph graph = p.pruned(settingsWith(2, most));
      pairsOf(graph, p.rest);
      // A pair's rank at one end: how many of that strand's pairs are stronger, or as strong and with a
      // strand that comes first in the groom.
      const auto rank = [&](const StrandOverlap& pair, std::uint32_t end) {
        const auto other = [&](const StrandOverlap& o) {
          return p.rest.strandInGroom[o.a == end ? o.b : o.a];
        };
        return std::ranges::count_if(p.overlaps, [&](const StrandOverlap& o) {
          if ((o.a != end && o.b != end) || o.count < 2) return false;
          return o.count > pair.count || (o.count == pair.count && other(o) < other(pair));
        });
      };
      for (const StrandOverlap& o : p.overlaps)
        EXPECT_EQ(graph.allows(o.a, o.b), o.count >= 2 && rank(o, o.a) < most && rank(o, o.b) < most);
      for (std::size_t s = 0; s < p.rest.strands.size(); ++s)
        EXPECT_LE(graph.firstNeighbour[s + 1] - graph.firstNeighbour[s], static_cast<std::uint32_t>(most));
    }
  }
}

TEST(ContactGraph, DropsAtRandomByTheSeed) {
  Groom groom = metres();
  addWandering(groom, 500, 40, {}, {0.2, 0, 0.2}, 0.005, 21);
  const Prepared p(groom);
  const GroomPairs all = pairsOf(p.pruned(settingsWith(2)), p.rest);
  ASSERT_GT(all.size(), 1000u);
  GroomPairs before = all;
  for (double share : {0.25, 0.5, 0.75, 1.0}) {
    const GroomPairs left = pairsOf(p.pruned(settingsWith(2, 0, share)), p.rest);
    EXPECT_EQ(left, pairsOf(p.pruned(settingsWith(2, 0, share)), p.rest));
    EXPECT_TRUE(std::ranges::includes(before, left)) << "dropping more brings none back";
    // Within four deviations of so many throws.
    const double count = static_cast<double>(all.size());
    EXPECT_NEAR(static_cast<double>(left.size()), count * (1 - share),
                4 * std::sqrt(count * share * (1 - share)));
    EXPECT_EQ(left == pairsOf(p.pruned(settingsWith(2, 0, share, 2)), p.rest), share == 1) << "another seed";
    before = left;
  }
}

TEST(ContactGraph, DoesNotDependOnTheOrderInMemory) {
  Groom groom = metres();
  addWandering(groom, 200, 12, {}, {0.1, 0, 0.1}, 0.008, 22);
  const Prepared groomOrder(groom), curveOrder(groom, orderAlongCurve(groom));
  ASSERT_NE(groomOrder.rest.strandInGroom, curveOrder.rest.strandInGroom);
  EXPECT_EQ(groomOrder.contacts.baseRadius, curveOrder.contacts.baseRadius);
  for (const ContactSettings& settings : {settingsWith(1), settingsWith(2, 5), settingsWith(1, 8, 0.5)}) {
    EXPECT_EQ(pairsOf(groomOrder.pruned(settings), groomOrder.rest),
              pairsOf(curveOrder.pruned(settings), curveOrder.rest));
  }
}

TEST(ContactGraph, WithoutPruningEveryPairMayTouch) {
  Groom groom = metres();
  groom.addStrand(line({}, {0, -0.1, 0}, 20));
  groom.addStrand(line({5, 0, 0}, {5, -0.1, 0}, 20));
  const Prepared p(groom);
  EXPECT_FALSE(p.pruned(settingsWith(8)).allows(0, 1));
  const ContactGraph all = p.pruned({});
  EXPECT_TRUE(all.everyPair && all.allows(0, 1) && all.allows(1, 0));
  EXPECT_FALSE(all.allows(1, 1));
  EXPECT_TRUE(all.neighbours.empty() && all.warnings.empty());
}

TEST(ContactGraph, SaysWhenNothingCanTouch) {
  Groom groom = metres();
  groom.addStrand(line({}, {0, -0.1, 0}, 20));
  EXPECT_TRUE(Prepared(groom).pruned(settingsWith(8)).warnings.empty()) << "one strand has none to touch";
  groom.addStrand(line({0.5, 0, 0}, {0.5, 0, 0.1}, 20));
  const Prepared p(groom);
  const auto overlaps = countOverlaps(p.rest, p.contacts, 0.1);
  const ContactGraph graph = pruneStrandPairs(overlaps, p.rest, settingsWith(8));
  ASSERT_EQ(graph.warnings.size(), 1u);
  EXPECT_NE(graph.warnings[0].find("no two of 2 strands may touch: of 0 pairs"), std::string::npos)
      << graph.warnings[0];
}

// 100,000 strands, of which some are held against all others. All pairs of spheres would be 10^12; how the
// work grows is counted in box_pairs_test.cpp.
TEST(ContactGraph, OverlapsOfManyStrandsAreExact) {
  SwatchParameters swatch;
  swatch.curl = {.turns = 0, .length = 0.05, .particleCount = 16};
  swatch.columnCount = 400;
  swatch.rowCount = 250;
  swatch.spacing = 0.005;
  const auto groom = makeSwatch(swatch);
  ASSERT_TRUE(groom) << groom.error().message;
  const RestState rest = restOf(*groom);
  const ContactParticles contacts = chooseContactParticles(rest, {});
  const auto overlaps = countOverlaps(rest, contacts, 1.5);
  ASSERT_GT(overlaps.size(), 10000u);
  const auto at = [&](std::size_t i) { return static_cast<Vec3d>(rest.points[contacts.particles[i]]); };
  for (std::uint32_t k : {0u, 1000u, 2000u, 3000u}) {
    const std::uint32_t strand = overlaps[k].a;
    std::map<std::uint32_t, std::uint32_t> expected, found;
    for (std::size_t i = 0; i < contacts.particles.size(); ++i) {
      if (contacts.strands[i] != strand) continue;
      for (std::size_t j = 0; j < contacts.particles.size(); ++j) {
        const double reach =
            1.5 * (double{contacts.radii[strand]} + double{contacts.radii[contacts.strands[j]]});
        if (contacts.strands[j] != strand && length(at(i) - at(j)) < reach) ++expected[contacts.strands[j]];
      }
    }
    for (const StrandOverlap& o : overlaps)
      if (o.a == strand || o.b == strand) found[o.a == strand ? o.b : o.a] = o.count;
    EXPECT_EQ(found, expected) << "strand " << strand;
  }
}

}  // namespace
}  // namespace ringlet::contact_graph_test
