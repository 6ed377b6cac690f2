// groom/mend_groom.h: what is merged and dropped, and strands resampled along their arc.
#include "ringlet/groom/mend_groom.h"

#include <gtest/gtest.h>

#include <vector>

#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/generate.h"
#include "tests/groom/groom_samples.h"

namespace ringlet::mend_groom_test {
namespace {

Groom groomOf(const std::vector<std::vector<Vec3f>>& strands) {
  Groom groom;
  groom.metresPerUnit = 0.5;
  for (const auto& strand : strands) groom.addStrand(strand);
  return groom;
}

TEST(MendGroom, LeavesAGoodGroomAlone) {
  const Groom groom = groomOf({{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}}, {{1, 0, 0}, {1, 1, 0}}});
  const MendedGroom mended = mendGroom(groom);
  EXPECT_TRUE(test::hasSameBits(mended.groom, groom));
  EXPECT_EQ(mended.groom.metresPerUnit, 0.5);
  EXPECT_EQ(mended.repeatedCount + mended.pointStrandCount + mended.duplicateCount, 0u);
}

TEST(MendGroom, MergesRepeatedParticlesAndKeepsTheTip) {
  // Nothing, next to nothing of the whole, and a tip next to the particle before it.
  const MendedGroom mended = mendGroom(
      groomOf({{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1.0000001f, 0}, {0, 5, 0}, {0, 5.000001f, 0}}}));
  ASSERT_EQ(mended.groom.strandCount(), 1u);
  EXPECT_EQ(mended.groom.points, (std::vector<Vec3f>{{0, 0, 0}, {0, 1, 0}, {0, 5.000001f, 0}}));
  EXPECT_EQ(mended.repeatedCount, 3u);
}

TEST(MendGroom, DropsWhatIsNoStrandAndWhatIsThereTwice) {
  const MendedGroom mended = mendGroom(groomOf({{{0, 0, 0}, {0, 1, 0}},
                                                {{2, 2, 2}, {2, 2, 2}, {2, 2, 2}},
                                                {{1, 0, 0}, {1, 1, 0}},
                                                {{0, 0, 0}, {0, 1, 0}},
                                                {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}},
                                                {{0, 0, 0}, {0, 1, 0}}}));
  EXPECT_EQ(mended.groom.strandCount(), 3u);
  EXPECT_EQ(mended.groom.strand(1)[0].x, 1);
  EXPECT_EQ(mended.pointStrandCount, 1u);
  EXPECT_EQ(mended.duplicateCount, 2u);
  EXPECT_EQ(duplicatesIn(groomOf({{{1, 1, 1}, {1, 1, 2}}, {{1, 1, 1}, {1, 1, 2}}})),
            (std::vector<bool>{false, true}));
}

TEST(MendGroom, ResamplesAtEqualDistances) {
  // Around a corner: 3 and 1 long, cut into four.
  const MendedGroom mended = mendGroom(groomOf({{{0, 0, 0}, {0, 3, 0}, {1, 3, 0}}}), 5);
  ASSERT_EQ(mended.groom.points.size(), 5u);
  const std::vector<Vec3f> wanted{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {1, 3, 0}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LT(length(mended.groom.points[i] - wanted[i]), 1e-6f) << i;
  // Two are root and tip; many on one edge are on that edge.
  EXPECT_EQ(mendGroom(groomOf({{{0, 0, 0}, {0, 3, 0}, {1, 3, 0}}}), 2).groom.points,
            (std::vector<Vec3f>{{0, 0, 0}, {1, 3, 0}}));
  const MendedGroom fine = mendGroom(groomOf({{{0, 0, 0}, {0, 0, 8}}}), 9);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(fine.groom.points[i], (Vec3f{0, 0, float(i)}));
}

TEST(MendGroom, ResamplingKeepsACurl) {
  const auto curl = makeCurl({.radius = 0.01, .turns = 8, .length = 0.25, .particleCount = 400});
  ASSERT_TRUE(curl);
  const MendedGroom mended = mendGroom(*curl, 64);
  std::vector<Vec3d> before, after;
  for (const Vec3f p : curl->points) before.push_back(Vec3d(p));
  for (const Vec3f p : mended.groom.points) after.push_back(Vec3d(p));
  EXPECT_EQ(after.size(), 64u);
  EXPECT_NEAR(measureCurl(after).turns, measureCurl(before).turns, 0.05);
  EXPECT_NEAR(measureCurl(after).radius, measureCurl(before).radius, 0.01 * measureCurl(before).radius);
}

}  // namespace
}  // namespace ringlet::mend_groom_test
