// measure/groom_doubts.h: which axis is up is doubted where hair hangs along another, but not where a head
// that stands has hair combed along that other.
#include "ringlet/measure/groom_doubts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace ringlet::groom_doubts_test {
namespace {

// Hair of the upper half of a head of 9 cm, `up` Y or Z, 18 cm long along the negative `hangs`.
Groom headOf(char up, char hangs) {
  constexpr int kStrands = 60;
  Groom groom;
  groom.metresPerUnit = 0.01;
  for (int s = 0; s < kStrands; ++s) {
    const double height = (s + 0.5) / kStrands, turn = s * std::numbers::pi * (3 - std::sqrt(5.0));
    const double side = std::sqrt(1 - height * height);
    const double x = 9 * side * std::cos(turn), level = 9 * side * std::sin(turn), high = 9 * height;
    std::vector<Vec3f> strand;
    for (int i = 0; i < 10; ++i) {
      Vec3d p = up == 'Y' ? Vec3d{x, high, level} : Vec3d{x, level, high};
      (hangs == 'Y' ? p.y : p.z) -= 2 * i;
      strand.push_back(Vec3f(p));
    }
    groom.addStrand(strand);
  }
  return groom;
}

TEST(GroomDoubts, HairThatIsCombedBackDoesNotTellWhatIsUp) {
  for (const char up : {'Y', 'Z'}) {
    const char other = up == 'Y' ? 'Z' : 'Y';
    const bool upIsZ = up == 'Z';
    EXPECT_FALSE(doubtOfUp(headOf(up, up), upIsZ)) << up;
    EXPECT_FALSE(doubtOfUp(headOf(up, other), upIsZ)) << up << ": the head stands";
    const auto onItsSide = doubtOfUp(headOf(other, other), upIsZ);
    ASSERT_TRUE(onItsSide) << up;
    for (const std::string& part :
         {std::string("along -") + other + ", and " + up + " is up", std::string("--up ") + other})
      EXPECT_NE(onItsSide->find(part), std::string::npos) << *onItsSide;
  }
}

}  // namespace
}  // namespace ringlet::groom_doubts_test
