// Mirrors ringlet/rest/dense_strands.h: which strands are dense, and which hang together, as the reference
// finds it.
#include "ringlet/rest/dense_strands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "parity/contacts.h"
#include "reference/rest_contacts.h"
#include "reference/step.h"
#include "ringlet/groom/generate.h"
#include "ringlet/rest/strand_order.h"

namespace ringlet::test::dense_strands_test {
namespace {

// Two dense locks and strands that stand alone.
Groom locksAndStrands() {
  Groom groom;
  groom.metresPerUnit = 1;
  const auto add = [&](double x, double z) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 24; ++i) strand.push_back(static_cast<Vec3f>(Vec3d{x, -0.006 * i, z}));
    groom.addStrand(strand);
  };
  for (const double lock : {0.0, 0.3})
    for (int k = 0; k < 40; ++k) add(lock + 0.0015 * (k % 7), 0.0015 * (k / 7));
  for (int k = 0; k < 5; ++k) add(0.6 + 0.1 * k, 0);
  return groom;
}

TEST(DenseStrands, AreThoseOfTheReferenceWhateverTheRadius) {
  using reference::RestContacts;
  const Groom groom = locksAndStrands();
  for (const std::optional<double> radius : {std::optional<double>{}, {0.001}, {0.004}, {0.02}}) {
    SCOPED_TRACE(radius.value_or(0));
    Settings settings;
    settings.contacts.on = true;
    settings.contacts.radius = radius;
    const auto rest = buildRestState(groom, {}, settings, orderAlongCurve(groom));
    ASSERT_TRUE(rest) << rest.error().message;
    const DenseStrands found = findDenseStrands(*rest);
    const reference::Simulation<double> simulation(groom, {}, settings);
    const RestContacts expected = reference::makeRestContacts(simulation.restStrands(), settings.contacts);
    ASSERT_EQ(expected.volumeGroups.size(), groom.strandCount());
    const auto groupOf = [&](std::uint32_t s) { return expected.volumeGroups[rest->strandInGroom[s]]; };
    for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
      EXPECT_EQ(found.isIn[s], groupOf(s) != RestContacts::kNoGroup) << s;
      EXPECT_EQ(found.isIn[s], rest->strandInGroom[s] < 80) << s;
      for (std::uint32_t t = 0; t < s; ++t)
        if (found.isIn[s] && found.isIn[t]) {
          EXPECT_EQ(found.groups[s] == found.groups[t], groupOf(s) == groupOf(t)) << s << " and " << t;
        }
    }
  }
}

}  // namespace
}  // namespace ringlet::test::dense_strands_test
