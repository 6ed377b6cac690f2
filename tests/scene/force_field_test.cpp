// scene/force_field.h: every number of a field goes evenly from one frame's to the next's.
#include "ringlet/scene/force_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ringlet::force_field_test {
namespace {

TEST(ForceFieldBetween, EveryNumberGoesEvenly) {
  double ForceField::*const numbers[] = {&ForceField::axial, &ForceField::radial,    &ForceField::around,
                                         &ForceField::core,  &ForceField::reach,     &ForceField::drag,
                                         &ForceField::front, &ForceField::thickness, &ForceField::gridShare};
  ForceField a, b;
  double k = 1;
  for (double ForceField::*const number : numbers) {
    a.*number = k;
    b.*number = 10 + 3 * k;
    ++k;
  }
  const double quarter = std::numbers::pi / 4;
  a.place = {{1, 2, 3}, {}};
  b.place = {{5, 0, 3}, fromRotationVector(Vec3d{0, 2 * quarter, 0})};
  b.aboutAxis = true;
  b.axis = {0, 0, 2};
  b.name = "b";
  for (const double s : {0.0, 0.25, 0.5, 1.0}) {
    const ForceField now = interpolate(a, b, s);
    k = 1;
    for (double ForceField::*const number : numbers) {
      EXPECT_DOUBLE_EQ(now.*number, k + s * (10 + 2 * k)) << "number " << k << " at " << s;
      ++k;
    }
    EXPECT_NEAR(length(now.place.position - Vec3d{1 + 4 * s, 2 - 2 * s, 3}), 0, 1e-12) << s;
    const Quatd turn = fromRotationVector(Vec3d{0, 2 * quarter * s, 0});
    EXPECT_NEAR(std::abs(dot(Vec3d{now.place.rotation.x, now.place.rotation.y, now.place.rotation.z},
                             Vec3d{turn.x, turn.y, turn.z}) +
                         now.place.rotation.w * turn.w),
                1, 1e-12)
        << s;
    // What has no way between is the later's.
    EXPECT_TRUE(now.aboutAxis);
    EXPECT_EQ(now.axis, b.axis);
    EXPECT_EQ(now.name, "b");
  }
}

}  // namespace
}  // namespace ringlet::force_field_test
