// What is made of a groom at rest is the same, bit for bit, with any number of threads.
#include <gtest/gtest.h>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/dense_strands.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/rest/strand_order.h"
#include "tests/rest/contact_samples.h"

namespace ringlet::rest_threads_test {
namespace {

using namespace test;

constexpr unsigned kThreadCounts[] = {1, 2, 3, 8};

// A head's strands, of which many are in every cell, and enough of them that every thread has a part in any.
Groom hair(int strandCount) {
  HeadParameters head;
  head.strandCount = strandCount;
  head.curl.turns = 5;
  auto groom = makeHead(head);
  RINGLET_ASSERT(groom, "the head is right");
  return std::move(*groom);
}

TEST(RestThreads, LeaveNoTraceInOverlaps) {
  const RestState rest = restOf(hair(2000));
  const ContactParticles particles = chooseContactParticles(rest, {});
  const auto overlaps = countOverlaps(rest, particles, 1.5, 1);
  ASSERT_GT(overlaps.size(), 20000u);
  for (const unsigned threads : kThreadCounts)
    EXPECT_EQ(countOverlaps(rest, particles, 1.5, threads), overlaps) << threads << " threads";
}

TEST(RestThreads, LeaveNoTraceInDensities) {
  const RestState rest = restOf(hair(2000));
  ContactSettings settings;
  settings.method = ContactMethod::automatic;
  const RestContacts contacts = buildRestContacts(rest, settings, 1);
  ASSERT_GT(contacts.volume.count, rest.strands.size() / 2);
  const RestVolume volume = buildRestVolume(rest, contacts, 1);
  for (const unsigned threads : kThreadCounts) {
    SCOPED_TRACE(testing::Message() << threads << " threads");
    const RestContacts again = buildRestContacts(rest, settings, threads);
    EXPECT_EQ(again.volume.groups, contacts.volume.groups);
    EXPECT_EQ(again.volume.isIn, contacts.volume.isIn);
    EXPECT_EQ(again.overlapsPerParticle, contacts.overlapsPerParticle);
    const RestVolume volumeAgain = buildRestVolume(rest, again, threads);
    EXPECT_EQ(volumeAgain.firsts, volume.firsts);
    EXPECT_EQ(volumeAgain.counts, volume.counts);
    EXPECT_EQ(volumeAgain.masses, volume.masses);
    EXPECT_EQ(volumeAgain.densities, volume.densities);
    EXPECT_EQ(volumeAgain.ownDensities, volume.ownDensities);
  }
}

TEST(RestThreads, LeaveNoTraceInGeometry) {
  const Groom groom = hair(600);
  const auto geometry = measureGeometry(groom, 1);
  ASSERT_TRUE(geometry) << geometry.error().message;
  for (const unsigned threads : kThreadCounts) {
    const auto again = measureGeometry(groom, threads);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(again->size(), geometry->size());
    for (std::size_t s = 0; s < geometry->size(); ++s) {
      EXPECT_EQ((*again)[s].arcLength, (*geometry)[s].arcLength);
      EXPECT_EQ((*again)[s].meanEdgeLength, (*geometry)[s].meanEdgeLength);
      EXPECT_EQ((*again)[s].smoothingLength, (*geometry)[s].smoothingLength);
      EXPECT_EQ((*again)[s].hasPerversions, (*geometry)[s].hasPerversions);
    }
  }
}

}  // namespace
}  // namespace ringlet::rest_threads_test
