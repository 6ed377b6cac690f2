// measure/joint_check.h: grooms that do not suit the joint that carries them are told, and none that do.
#include "ringlet/measure/joint_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "ringlet/groom/generate.h"

namespace ringlet::joint_check_test {
namespace {

// A joint of which `axis` points up; it nods by some degrees, or turns over and over.
Motion jointWith(Vec3d axis, Vec3d up, bool turnsOver = false) {
  const double cosine = dot(axis, up);
  const Vec3d across = cross(axis, up);
  const Vec3d side = std::abs(up.x) > 0.5 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  const Quatd upright = cosine < -0.5  ? fromRotationVector(side * std::numbers::pi)
                        : cosine > 0.5 ? Quatd{}
                                       : fromRotationVector(across * (std::numbers::pi / 2));
  Keyframes keys;
  for (int k = 0; k < 2500; ++k) {
    const double angle = turnsOver ? 0.1 * k : 0.3 * std::sin(0.2 * k);
    keys.poses.push_back({{}, fromRotationVector(side * angle) * upright});
  }
  return {.kind = MotionKind::keyframes, .keyframes = std::make_shared<const Keyframes>(std::move(keys))};
}

TEST(JointCheck, AxesThatDoNotPointUpAreNamed) {
  const struct {
    const char* name;
    Vec3d axis;
  } all[] = {{"+X", {1, 0, 0}},  {"-X", {-1, 0, 0}}, {"+Y", {0, 1, 0}},
             {"-Y", {0, -1, 0}}, {"+Z", {0, 0, 1}},  {"-Z", {0, 0, -1}}};
  for (const auto& up : {all[2], all[4]}) {
    for (const auto& [name, axis] : all) {
      const auto doubt = checkJointAxes(jointWith(axis, up.axis), up.axis, "rig:Head");
      if (axis == up.axis) {
        EXPECT_FALSE(doubt) << *doubt;
        continue;
      }
      ASSERT_TRUE(doubt) << name;
      EXPECT_NE(doubt->find(std::string("the joint rig:Head has its ") + name +
                            " axis up, where the groom has its " + up.name),
                std::string::npos)
          << *doubt;
      EXPECT_NE(doubt->find("--bind world"), std::string::npos) << *doubt;
      EXPECT_NE(doubt->find(dot(axis, up.axis) < -0.5 ? "tilted by 180 degrees" : "tilted by 90 degrees"),
                std::string::npos)
          << *doubt;
    }
  }
}

TEST(JointCheck, NoAxisIsUpWhereTheHeadTurnsOverOrIsNoFiles) {
  EXPECT_FALSE(checkJointAxes(jointWith({1, 0, 0}, {0, 1, 0}, true), {0, 1, 0}, "Head"));
  EXPECT_FALSE(checkJointAxes(*motionByName("nod", {0, 1, 0}), {0, 1, 0}, "Head"));
  Motion bound = jointWith({1, 0, 0}, {0, 1, 0});
  bound.axes = bound.poseAt(0).rotation.conjugate();
  EXPECT_FALSE(checkJointAxes(bound, {0, 1, 0}, "Head")) << "its axes have been given way";
}

TEST(JointCheck, AGroomFarFromItsJoint) {
  Groom groom = *makeHead({.strandCount = 30});
  EXPECT_FALSE(checkJointDistance(groom, {}, false, "Head"));
  EXPECT_FALSE(checkJointDistance(groom, {{9, 9, 9}, {}, 0}, true, "Head"));
  for (Vec3f& point : groom.points) point.y += 160;  // in the world, not in the head's frame
  const auto unbound = checkJointDistance(groom, {}, false, "Head");
  ASSERT_TRUE(unbound);
  EXPECT_NE(unbound->find("no root is nearer to the joint Head than 1."), std::string::npos) << *unbound;
  EXPECT_NE(unbound->find("takes bind = \"world\" of [groom] (--bind world)"), std::string::npos);
  const auto bound = checkJointDistance(groom, {{0.5, 0.25, -2}, {}, 0}, true, "Head");
  ASSERT_TRUE(bound);
  EXPECT_NE(bound->find("the joint is at (0.5, 0.25, -2) m; are the units"), std::string::npos) << *bound;
  EXPECT_FALSE(checkJointDistance(Groom{}, {}, false, "Head"));
}

// A moustache is smaller than its way from the joint.
TEST(JointCheck, ASmallGroomMayBeFurtherThanItsSize) {
  Groom groom = *makeCurl({.length = 0.03});
  for (Vec3f& point : groom.points) point.z += 12;
  EXPECT_FALSE(checkJointDistance(groom, {}, false, "Head"));
}

}  // namespace
}  // namespace ringlet::joint_check_test
