// Strands carried rigidly, on a device: they are where their roots' poses say, in every way positions leave a
// simulation; all others have the bits of a groom without them; and the reference does the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "layout/strands.h"
#include "reference/step.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::rigid_hair_test {
namespace {

constexpr int kFrames = 6;
constexpr int kJump = 3;  // in this frame the head jumps and turns

HeadPose headAt(double t, int frame) {
  HeadPose head{Vec3d{0.3 * t, 0.4 * t * t, -0.2 * t},
                fromRotationVector(Vec3d{0.2, 1.5, -0.4} * (t + 2 * t * t))};
  if (frame >= kJump) head.position += Vec3d{9, 0, 0};
  head.shift = t;
  return head;
}
BodyPose rootAt(double t, std::size_t strand) {
  const double k = 1 + 0.3 * static_cast<double>(strand);
  return {Vec3d{0.02 * k * t, 0.3 * t * t, 0.01 * t}, fromRotationVector(Vec3d{0.1 * k, -0.8, 0.2} * t)};
}

class RigidHairTest : public GpuTest {
 protected:
  RigidHairTest() {
    const Groom normal = randomGroom({31, 17, 24}, 3);
    groom_.metresPerUnit = without_.metresPerUnit = 1;
    for (std::size_t s = 0; s < 3; ++s) {
      groom_.addStrand(moved(normal.strand(s), 1));
      without_.addStrand(groom_.strand(groom_.strandCount() - 1));
      groom_.addStrand(moved(normal.strand(s), 1e-6));
      rigid_.push_back(static_cast<std::uint32_t>(groom_.strandCount() - 1));
    }
  }

  // A metre from the origin, in another size.
  static std::vector<Vec3f> moved(std::span<const Vec3f> strand, double scale) {
    std::vector<Vec3f> points;
    for (Vec3f p : strand)
      points.push_back(static_cast<Vec3f>(static_cast<Vec3d>(p) * scale + Vec3d{0.6, 0.8, 0}));
    return points;
  }

  double timeOf(int frame, int step) const {
    return (frame * settings_.stepsPerFrame + step) * settings_.stepSeconds();
  }
  std::vector<HeadPose> headsOf(int frame) const {
    std::vector<HeadPose> heads;
    for (int k = 1; k <= settings_.stepsPerFrame; ++k) heads.push_back(headAt(timeOf(frame, k), frame));
    return heads;
  }
  std::vector<BodyPose> rootsOf(int frame, const Groom& groom) const {
    std::vector<BodyPose> roots;
    for (int k = 1; k <= settings_.stepsPerFrame; ++k)
      for (std::size_t s = 0; s < groom.strandCount(); ++s) roots.push_back(rootAt(timeOf(frame, k), s));
    return roots;
  }
  std::vector<BodyPose> rootsAt(double t) const {
    std::vector<BodyPose> roots;
    for (std::size_t s = 0; s < groom_.strandCount(); ++s) roots.push_back(rootAt(t, s));
    return roots;
  }
  std::vector<Vec3d> shifts() const {
    std::vector<Vec3d> all;
    for (std::size_t s = 0; s < groom_.strandCount(); ++s)
      all.push_back({0.1, 0.02 * static_cast<double>(s), 0});
    return all;
  }

  Simulation make(const Groom& groom, const KernelChoice& kernel, InitialState initial = {}) {
    initial.head = headAt(0, 0);
    initial.oneStepEarlier = headAt(-settings_.stepSeconds(), 0);
    auto simulation = Simulation::create(device(), groom, {}, settings_, initial, kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    return std::move(*simulation);
  }

  Groom groom_, without_;  // with the rigid strands, each after a normal one, and without
  std::vector<std::uint32_t> rigid_;
  Settings settings_;
};

// Frames in flight, with a head that jumps; each frame's positions as they are read back.
TEST_F(RigidHairTest, LeavesTheBitsOfAllOtherHair) {
  KernelChoice chunked;
  chunked.mostBufferBytes = 31 * 32;  // a strand a chunk
  for (const KernelChoice& kernel : {KernelChoice{}, KernelChoice{KernelChoice::Form::serial}, chunked}) {
    Simulation all = make(groom_, kernel), others = make(without_, kernel);
    EXPECT_EQ(Diagnostics(all).rigidStrandCount(), 3u);
    EXPECT_EQ(Diagnostics(others).rigidStrandCount(), 0u);
    for (int frame = 0; frame < kFrames; frame += 2) {
      for (int next : {frame, frame + 1}) {
        ASSERT_TRUE(all.submitFrame(headsOf(next)));
        ASSERT_TRUE(others.submitFrame(headsOf(next)));
      }
      for (int next : {frame, frame + 1}) {
        ASSERT_TRUE(all.waitFrame());
        ASSERT_TRUE(others.waitFrame());
        const std::vector<Vec3f> found = all.framePositions(), expected = others.framePositions();
        const Quatd turn = headAt(timeOf(next, settings_.stepsPerFrame), next).rotation;
        for (std::size_t s = 0; s < groom_.strandCount(); ++s) {
          for (std::size_t i = 0; i < groom_.strand(s).size(); ++i) {
            const Vec3f p = found[groom_.firstPoint[s] + i];
            if (s % 2 == 0) {
              ASSERT_TRUE(p == expected[without_.firstPoint[s / 2] + i]) << "strand " << s;
            } else {
              ASSERT_LE(length(static_cast<Vec3d>(p) - rotate(turn, static_cast<Vec3d>(groom_.strand(s)[i]))),
                        1e-7)
                  << "frame " << next << ", strand " << s;
            }
          }
        }
      }
    }
    EXPECT_EQ(all.report()->maxEdgeStretch, others.report()->maxEdgeStretch);
    EXPECT_EQ(all.report()->limitedShare, others.report()->limitedShare);
  }
}

// Roots of their own that move, shifts, bodies and contacts: positions and velocities of rigid strands are
// the reference's, before the first frame, in every frame and after a jump.
TEST_F(RigidHairTest, IsWhereTheReferenceHasIt) {
  const std::vector<Body> bodies{{.name = "ball", .radius = 0.05, .place = {{0.6, 0.7, 0}, {}}}};
  settings_.contacts.on = true;
  settings_.contacts.method = ContactMethod::explicitPairs;
  settings_.contacts.prunePairs = false;
  settings_.contacts.radius = 0.002;
  const std::vector<Vec3d> moved = shifts();
  const std::vector<BodyPose> now = rootsAt(0), earlier = rootsAt(-settings_.stepSeconds());
  Simulation simulation =
      make(groom_, {.features = {.roots = true}},
           {.bodies = bodies, .roots = now, .rootsEarlier = earlier, .rootShifts = moved});
  reference::Simulation<double> reference(groom_, {}, settings_, headAt(0, 0),
                                          headAt(-settings_.stepSeconds(), 0), {}, bodies);
  reference.carryRigidly(rigid_);
  reference.setRootShifts(moved);
  reference.placeRoots(now, earlier);
  for (int frame = -1; frame < kFrames; ++frame) {
    if (frame >= 0) {
      ASSERT_TRUE(simulation.stepFrame(headsOf(frame), {}, rootsOf(frame, groom_)));
      reference.stepFrame(headsOf(frame), {}, rootsOf(frame, groom_));
    }
    const HairState found = *simulation.state();
    ASSERT_TRUE(found.positions == *simulation.positions());
    for (std::uint32_t s : rigid_) {
      for (std::uint32_t i = groom_.firstPoint[s]; i < groom_.firstPoint[s + 1]; ++i) {
        ASSERT_LE((reference::toEigen<double>(found.positions[i]) - reference.positions()[i]).norm(), 2e-7)
            << "frame " << frame << ", strand " << s;
        ASSERT_LE((reference::toEigen<double>(found.velocities[i]) - reference.velocities()[i]).norm(), 1e-5)
            << "frame " << frame << ", strand " << s;
      }
    }
  }
  ASSERT_FALSE(reference.contacts().particles.empty());
  for (const reference::ContactParticle& particle : reference.contacts().particles)
    EXPECT_EQ(particle.strand % 2, 0u) << "the reference has rigid strand " << particle.strand << " touch";
  const std::vector<ListedContact> listed = *Diagnostics(simulation).listedContacts();
  for (const ListedContact& contact : listed) {
    for (std::uint32_t particle : {contact.a, contact.b}) {
      const auto after = std::ranges::upper_bound(groom_.firstPoint, particle);
      EXPECT_EQ((after - groom_.firstPoint.begin() - 1) % 2, 0) << "a contact of rigid particle " << particle;
    }
  }
}

TEST_F(RigidHairTest, IsMovedByNothingElse) {
  Simulation simulation = make(groom_, {.taps = true});
  HairState state = *simulation.state();
  const HairState before = state;
  for (Vec3f& p : state.positions) p.x += 0.5f;
  for (Vec3f& v : state.velocities) v.y += 1;
  ASSERT_TRUE(simulation.setState(state));
  const HairState after = *simulation.state();
  for (std::size_t s = 0; s < groom_.strandCount(); ++s) {
    const std::size_t i = groom_.firstPoint[s] + 1;
    const HairState& expected = s % 2 == 0 ? state : before;
    EXPECT_TRUE(after.positions[i] == expected.positions[i]) << s;
    EXPECT_TRUE(after.velocities[i] == expected.velocities[i]) << s;
  }
  ASSERT_TRUE(simulation.stepFrame(headsOf(0)));
  const auto tap = *Diagnostics(simulation).tap(layout::kTapVelocity);
  ASSERT_EQ(tap.size(), groom_.points.size());
  EXPECT_EQ(tap[groom_.firstPoint[1] + 1], (std::array<float, 4>{}));
}

TEST_F(RigidHairTest, MayBeAllThereIs) {
  Groom fine;
  fine.metresPerUnit = 1;
  const Groom normal = randomGroom({31, 17, 24}, 3);
  for (std::size_t s = 0; s < 3; ++s) fine.addStrand(moved(normal.strand(s), 1e-5));
  settings_.contacts.on = true;
  settings_.contacts.method = ContactMethod::explicitPairs;
  const std::vector<Body> bodies{{.name = "ball", .radius = 0.05}};
  Simulation simulation = make(fine, {}, {.bodies = bodies});
  EXPECT_EQ(Diagnostics(simulation).rigidStrandCount(), 3u);
  EXPECT_NE(Diagnostics(simulation).kernels().find("rigid"), std::string::npos);
  for (int frame = 0; frame < kFrames; ++frame) ASSERT_TRUE(simulation.stepFrame(headsOf(frame)));
  const std::vector<Vec3f> found = *simulation.positions();
  const Quatd turn = simulation.head().rotation;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LE(length(static_cast<Vec3d>(found[i]) - rotate(turn, static_cast<Vec3d>(fine.points[i]))), 1e-7);
  EXPECT_EQ(simulation.report()->nonfinite, 0u);
  EXPECT_EQ(simulation.contactReport()->contactParticles, 0u);
  EXPECT_TRUE(Diagnostics(simulation).listedContacts()->empty());
}

// Hair as a fine groom has it, a metre away and shaken: the limit holds to a thousandth.
TEST_F(RigidHairTest, LetsTheStretchLimitHold) {
  Groom groom;
  groom.metresPerUnit = 1;
  const Groom normal = randomGroom({16, 24, 16, 31, 16, 20, 16, 16}, 5);
  double scale = 1;
  for (std::size_t s = 0; s < normal.strandCount(); ++s) {
    groom.addStrand(moved(normal.strand(s), 0.2));
    if (s % 2 == 0) groom.addStrand(moved(normal.strand(s), scale *= 0.04));  // 1e-2 to 6e-7 m
  }
  Material material;
  material.stretchStiffness = 1;  // hair hangs on the limit
  const Motion motion = *motionByName("shake", {0, 1, 0});
  Simulation simulation = *Simulation::create(device(), groom, material, settings_);
  for (int frame = 0; frame < 12; ++frame) {
    std::vector<HeadPose> heads;
    for (int k = 1; k <= settings_.stepsPerFrame; ++k) heads.push_back(motion.poseAt(timeOf(frame, k)));
    ASSERT_TRUE(simulation.stepFrame(heads));
  }
  fmt::print("{} of {} strands rigid; longest edge {:.5f} of a limit of {}\n",
             Diagnostics(simulation).rigidStrandCount(), groom.strandCount(),
             simulation.report()->maxEdgeStretch, settings_.maxStretch);
  EXPECT_GT(simulation.report()->limitedShare, 0);
  EXPECT_LE(simulation.report()->maxEdgeStretch, settings_.maxStretch * (1 + 1e-3));
  EXPECT_GE(Diagnostics(simulation).rigidStrandCount(), 2u);
}

}  // namespace
}  // namespace ringlet::test::rigid_hair_test
