// Strands' own poses (Simulation::stepFrame's rootPoses), against what they must come to: none at all, a head
// that moves, a head that jumps. Against the reference: strand_step_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::root_poses_test {
namespace {

constexpr int kFrames = 4;

// The head, and a pose in its frame: quick enough to swing the hair.
HeadPose headAt(double t) {
  return {Vec3d{0.3 * t, 0.4 * t * t, -0.2 * t}, fromRotationVector(Vec3d{0.2, 1.5, -0.4} * (t + 2 * t * t))};
}
BodyPose rootAt(double t) {
  return {Vec3d{0.02 - 0.1 * t, 0.3 * t * t, 0.05}, fromRotationVector(Vec3d{0.1 + t, -0.8 * t, 2 * t * t})};
}
HeadPose together(double t) {
  const HeadPose head = headAt(t);
  const BodyPose root = rootAt(t);
  return {head.position + rotate(head.rotation, root.position), head.rotation * root.rotation};
}

const KernelChoice kForms[] = {{}, {KernelChoice::Form::serial}};

class RootPoses : public GpuTest {
 protected:
  const Groom groom_ = randomGroom({31, 5, 64, 2, 17}, 3);
  Settings settings_;

  std::vector<BodyPose> onAll(const BodyPose& pose) const {
    return std::vector<BodyPose>(groom_.strandCount(), pose);
  }
  // Poses of frame f's steps.
  template <class At>
  auto ofFrame(int frame, At&& at) const {
    std::vector<decltype(at(0.0))> poses;
    for (int k = 1; k <= settings_.stepsPerFrame; ++k)
      poses.push_back(at((frame * settings_.stepsPerFrame + k) * settings_.stepSeconds()));
    return poses;
  }
  Simulation make(KernelChoice kernel, bool movingRoots, HeadPose (*head)(double),
                  std::span<const BodyPose> roots = {}, std::span<const BodyPose> earlier = {}) {
    kernel.features.roots = movingRoots;
    auto simulation = Simulation::create(device(), groom_, {}, settings_,
                                         {.head = head(0),
                                          .oneStepEarlier = head(-settings_.stepSeconds()),
                                          .roots = roots,
                                          .rootsEarlier = earlier},
                                         kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    return std::move(*simulation);
  }
};

// Bit for bit: what the host adds is exactly nothing, and the kernel rounds the same.
TEST_F(RootPoses, ThatDoNotMoveChangeNothing) {
  for (const KernelChoice& form : kForms) {
    Simulation plain = make(form, false, headAt), left = make(form, true, headAt),
               given = make(form, true, headAt);
    for (int frame = 0; frame < kFrames; ++frame) {
      const std::vector<HeadPose> heads = ofFrame(frame, headAt);
      const std::vector<BodyPose> roots(heads.size() * groom_.strandCount());
      ASSERT_TRUE(plain.stepFrame(heads));
      ASSERT_TRUE(left.stepFrame(heads));
      ASSERT_TRUE(given.stepFrame(heads, {}, roots));
    }
    const HairState expected = *plain.state();
    for (Simulation* other : {&left, &given}) {
      const HairState found = *other->state();
      EXPECT_TRUE(found.positions == expected.positions);
      EXPECT_TRUE(found.velocities == expected.velocities);
    }
  }
}

// World positions, where all strands' poses are the same and where the head itself moves so.
TEST_F(RootPoses, ThatAreEqualAreAMovingHead) {
  for (const KernelChoice& form : kForms) {
    const std::vector<BodyPose> now = onAll(rootAt(0)), earlier = onAll(rootAt(-settings_.stepSeconds()));
    Simulation apart = make(form, true, headAt, now, earlier), moving = make(form, false, together);
    const auto difference = [&] {
      const std::vector<Vec3f> a = *apart.positions(), b = *moving.positions();
      double most = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most,
                        length(apart.head().position + Vec3d(a[i]) - moving.head().position - Vec3d(b[i])));
      return most;
    };
    EXPECT_LE(difference(), 1e-7);
    for (int frame = 0; frame < kFrames; ++frame) {
      std::vector<BodyPose> roots;
      for (const BodyPose& pose : ofFrame(frame, rootAt)) {
        for (std::size_t s = 0; s < groom_.strandCount(); ++s) roots.push_back(pose);
      }
      ASSERT_TRUE(apart.stepFrame(ofFrame(frame, headAt), {}, roots));
      ASSERT_TRUE(moving.stepFrame(ofFrame(frame, together)));
    }
    fmt::print("equal poses, {}: {:.1e} m from a moving head\n", Diagnostics(apart).kernels(), difference());
    EXPECT_LE(difference(), kOneFrame * 0.25) << "strands of 25 cm";
  }
}

// A head that jumps takes the hair along; roots then are where their new poses say.
TEST_F(RootPoses, AreTheNewOnesAfterAJump) {
  for (const KernelChoice& form : kForms) {
    const std::vector<BodyPose> still = onAll(rootAt(0));
    Simulation simulation = make(form, true, headAt, still, still);
    const std::vector<HeadPose> far(static_cast<std::size_t>(settings_.stepsPerFrame),
                                    HeadPose{{10, 0, 0}, {}});
    std::vector<BodyPose> roots(far.size() * groom_.strandCount(), rootAt(0.05));
    const std::vector<Vec3f> before = *simulation.positions();
    ASSERT_TRUE(simulation.stepFrame(far, {}, roots));
    EXPECT_TRUE(*simulation.positions() == before) << "the head did not turn";
    ASSERT_TRUE(simulation.stepFrame(far, {}, roots));
    const std::vector<Vec3f> after = *simulation.positions();
    for (std::size_t s = 0; s < groom_.strandCount(); ++s) {
      const std::size_t i = groom_.firstPoint[s];
      const Vec3d wanted = rootAt(0.05).position + rotate(rootAt(0.05).rotation, Vec3d(groom_.points[i]));
      EXPECT_LE(length(Vec3d(after[i]) - wanted), 1e-7);
    }
    EXPECT_EQ(simulation.report()->nonfinite, 0u);
  }
}

}  // namespace
}  // namespace ringlet::test::root_poses_test
