// The fingerprint of positions, against published values of FNV-1a, and what must change it.
#include "ringlet/output/positions_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ringlet::positions_hash_test {
namespace {

TEST(PositionsHash, MatchesPublishedValues) {
  // draft-eastlake-fnv, appendix C.
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325u);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8u);
}

TEST(PositionsHash, ShowsASingleBit) {
  std::vector<Vec3f> points{{1, 2, 3}, {4, 5, 6}};
  const std::string before = positionsHash(points);
  EXPECT_EQ(before.size(), 16u);
  EXPECT_EQ(before, positionsHash(std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}));
  points[1].z = std::nextafter(points[1].z, 7.0f);
  EXPECT_NE(before, positionsHash(points));
  EXPECT_NE(positionsHash(std::vector<Vec3f>{{0, 0, 0}}), positionsHash(std::vector<Vec3f>{{-0.0f, 0, 0}}));
}

}  // namespace
}  // namespace ringlet::positions_hash_test
