// run/strand_parts.h: each strand is in one part, parts are of equal weight, and strands that may touch go
// together.
#include "ringlet/run/strand_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/rest_halo.h"
#include "ringlet/rest/rest_part.h"
#include "ringlet/rest/strand_order.h"

namespace ringlet::strand_parts_test {
namespace {

Groom head(int strandCount, double varyLength = 0) {
  HeadParameters parameters{.strandCount = strandCount};
  parameters.curl.particleCount = 24;
  parameters.variation.length = varyLength;
  return *makeHead(parameters);
}

Settings contacts(ContactMethod method, bool prunes) {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = method;
  settings.contacts.prunePairs = prunes;
  return settings;
}

// Strands of other parts that some part's strands may touch, over all strands.
double haloShare(const Groom& groom, const Settings& settings,
                 const std::vector<std::vector<std::uint32_t>>& parts) {
  const auto rest = *buildRestState(groom, {}, settings, orderAlongCurve(groom));
  const RestContacts atRest = buildRestContacts(rest, settings.contacts);
  const auto partOf = *partOfEach(parts, rest);
  double around = 0;
  for (std::size_t part = 0; part < parts.size(); ++part)
    around += static_cast<double>(haloOf(atRest, partOf, part).around.size());
  return around / static_cast<double>(groom.strandCount());
}

Result<std::vector<std::vector<std::uint32_t>>> divide(const Groom& groom, const Settings& settings,
                                                       std::size_t count) {
  return divideStrands(groom, settings, *buildWholeRest(groom, {}, settings), count);
}

TEST(StrandParts, EachStrandIsInOnePart) {
  const Groom groom = head(90, 0.5);
  std::vector<Settings> all{Settings{}};
  for (const ContactMethod method :
       {ContactMethod::automatic, ContactMethod::explicitPairs, ContactMethod::volume})
    for (const bool prunes : {true, false}) all.push_back(contacts(method, prunes));
  for (const Settings& settings : all) {
    for (const std::size_t count : {1, 2, 5, 90}) {
      const auto parts = divide(groom, settings, count);
      ASSERT_TRUE(parts) << parts.error().message;
      ASSERT_EQ(parts->size(), count);
      std::multiset<std::uint32_t> strands;
      for (const auto& part : *parts) {
        EXPECT_FALSE(part.empty());
        strands.insert(part.begin(), part.end());
      }
      EXPECT_EQ(strands.size(), groom.strandCount());
      EXPECT_EQ(std::set<std::uint32_t>(strands.begin(), strands.end()).size(), groom.strandCount());
      EXPECT_EQ(*parts, *divide(groom, settings, count)) << "another time, other parts";
    }
  }
}

TEST(StrandParts, StrandsThatMayTouchGoTogether) {
  if (!hasMetis()) GTEST_SKIP() << "SKIPPED: built without METIS (Debian: libmetis-dev)";
  const Groom groom = head(300);
  for (const bool prunes : {true, false}) {
    const Settings settings = contacts(ContactMethod::explicitPairs, true);
    const auto parts = *divide(groom, contacts(ContactMethod::explicitPairs, prunes), 4);
    std::vector<std::vector<std::uint32_t>> dealt(4);
    for (std::uint32_t s = 0; s < 300; ++s) dealt[s % 4].push_back(s);
    EXPECT_LT(haloShare(groom, settings, parts), 0.4 * haloShare(groom, settings, dealt));
  }
}

TEST(StrandParts, WeighTheSame) {
  const Groom groom = head(300, 0.6);
  const Settings settings = contacts(ContactMethod::explicitPairs, true);
  const auto rest = *buildRestState(groom, {}, settings, orderAlongCurve(groom));
  const StrandGraph graph = strandGraph(rest, buildRestContacts(rest, settings.contacts));
  for (const int count : {2, 4, 8}) {
    const auto parts = *divide(groom, settings, static_cast<std::size_t>(count));
    const auto partOf = *partOfEach(parts, rest);
    const std::vector<std::int32_t> of(partOf.begin(), partOf.end());
    EXPECT_LE(imbalance(graph, of, count), 1.08) << count << " parts";
  }
}

// Two strands side by side and one far away, all of the same particles: what the two cost more are their
// overlaps, 60 ns a side.
TEST(StrandParts, AContactWeighsOnBothItsStrands) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (const float x : {0.f, 0.002f, 1.f}) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 30; ++i) strand.push_back({x, -0.005f * static_cast<float>(i), 0});
    groom.addStrand(strand);
  }
  Settings settings = contacts(ContactMethod::explicitPairs, true);
  settings.contacts.radius = 0.003;
  const auto rest = *buildRestState(groom, {}, settings, orderAlongCurve(groom));
  const StrandGraph graph = strandGraph(rest, buildRestContacts(rest, settings.contacts));
  std::int32_t alone = 0;
  for (std::size_t s = 0; s < 3; ++s)
    if (graph.neighboursOf(s).empty()) alone = graph.weights[s];
  ASSERT_EQ(graph.overlaps.size(), 2u);
  for (std::size_t s = 0; s < 3; ++s) {
    if (graph.neighboursOf(s).empty()) continue;
    const std::int32_t overlaps = graph.overlaps[static_cast<std::size_t>(graph.first[s])];
    EXPECT_GT(overlaps, 20);
    EXPECT_NEAR(graph.weights[s] - alone, 0.6 * overlaps, 1);
  }
}

TEST(StrandParts, MoreThanStrandsAreRefused) {
  const auto parts = divide(head(3), Settings{}, 4);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error().message, "4 parts are more than the groom's 3 strands");
}

}  // namespace
}  // namespace ringlet::strand_parts_test
