// Tests cuts of scene/keyframes.h: a head that jumps goes on as it came until it is elsewhere.
#include <gtest/gtest.h>

#include "ringlet/scene/keyframes.h"

namespace ringlet::test::keyframe_cut_test {
namespace {

// 1 m/s along X, a jump of 10 m along Z between the fourth key and the fifth, and on at 2 m/s.
Keyframes jumping(bool withTimes) {
  Keyframes keys{.secondsPerKey = 0.1, .poses = {}, .cutSpeed = 24};
  for (int k = 0; k < 8; ++k) {
    const double x = k < 4 ? 0.1 * k : 0.2 * k;
    keys.poses.push_back({{x, 0, k < 4 ? 0.0 : 10.0}, {}});
    if (withTimes) keys.times.push_back(0.1 * k);
  }
  return keys;
}

TEST(KeyframeCut, GoesOnAsItCame) {
  for (const bool withTimes : {false, true}) {
    const Keyframes keys = jumping(withTimes);
    for (std::size_t k = 0; k + 1 < 8; ++k) EXPECT_EQ(keys.isCut(k), k == 3) << k;
    for (double t = 0; t < 0.399; t += 0.013) {
      EXPECT_NEAR(keys.poseAt(t).position.x, t, 1e-12) << withTimes << " " << t;
      EXPECT_EQ(keys.poseAt(t).position.z, 0) << t;
    }
    for (double t = 0.4001; t < 0.7; t += 0.013) {
      EXPECT_NEAR(keys.poseAt(t).position.x, 2 * t, 1e-12) << withTimes << " " << t;
      EXPECT_EQ(keys.poseAt(t).position.z, 10) << t;
    }
    // Without cuts the way between is smooth.
    Keyframes smooth = keys;
    smooth.cutSpeed = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(smooth.poseAt(0.35).position.z, 5, 0.5);
  }
}

}  // namespace
}  // namespace ringlet::test::keyframe_cut_test
