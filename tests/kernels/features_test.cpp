// Features (solver/features.h) are added when they are first used.
#include "ringlet/solver/features.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "ringlet/solver/hair_frames.h"
#include "ringlet/solver/simulation.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::features_test {
namespace {

constexpr int kFrames = 6;

// How a feature is used; it moves hair.
struct Use {
  const char* name;
  bool Features::*feature;
  std::function<Status(Simulation&, const Groom&)> begin;  // before a frame
};

std::vector<Use> uses() {
  const auto bodies = [](Simulation& hair, const Groom&) { return hair.setBodies(sampleBodies()); };
  const auto forces = [](Simulation& hair, const Groom& groom) {
    return hair.setForces(std::vector<Vec3f>(groom.points.size(), {15, 0, 5}));
  };
  const auto goals = [](Simulation& hair, const Groom& groom) {
    std::vector<Vec3f> places = groom.points;
    for (Vec3f& place : places) place = Vec3f(Vec3d(place) * groom.metresPerUnit + Vec3d{0.02, 0, 0});
    return hair.setGoals(places, std::vector<float>(places.size(), 3));
  };
  const auto fields = [](Simulation& hair, const Groom&) {
    return hair.setFields(std::vector<ForceField>{{.axis = {1, 0, 0}, .axial = 20}});
  };
  return {{"bodies", &Features::bodies, bodies},
          {"roots", &Features::roots, nullptr},  // by the poses of the frame
          {"forces", &Features::forces, forces},
          {"goals", &Features::goals, goals},
          {"fields", &Features::fields, fields}};
}

class FeaturesTest : public GpuTest {
 protected:
  // Steps frames, from frame `first` on with the feature in use.
  static std::vector<HairState> run(Simulation& hair, const Groom& groom, const Use& use, int first) {
    std::vector<HairState> states;
    for (int frame = 0; frame < kFrames; ++frame) {
      if (frame == first && use.begin) {
        const Status begun = use.begin(hair, groom);
        EXPECT_TRUE(begun) << begun.error().message;
      }
      EXPECT_TRUE(step(hair, groom, frame, !use.begin && frame >= first));
      states.push_back(*hair.state());
    }
    return states;
  }
  static Status step(Simulation& hair, const Groom& groom, int frame, bool movesRoots) {
    const int steps = hair.settings().stepsPerFrame;
    std::vector<HeadPose> heads;
    std::vector<BodyPose> roots;
    for (int k = 1; k <= steps; ++k) {
      const double t = frame + double(k) / steps;
      heads.push_back({{0.01 * t, 0, 0}, fromRotationVector(Vec3d{0, 0.05 * t, 0})});
      for (std::size_t s = 0; movesRoots && s < groom.strandCount(); ++s)
        roots.push_back({{0, 0.002 * t * double(s % 3), 0}, fromRotationVector(Vec3d{0.02 * t, 0, 0})});
    }
    return hair.stepFrame(heads, {}, roots);
  }
  Simulation begin(const Hair& hair, Features features) {
    KernelChoice kernel = hair.kernel;
    kernel.features = kernel.features | features;
    auto made = Simulation::create(device(), hair.groom, varyingMaterial(), hair.settings,
                                   {.bodies = hair.bodies}, kernel);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
};

double largestDifference(const HairState& a, const HairState& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    largest = std::max(largest, length(Vec3d(a.positions[i]) - Vec3d(b.positions[i])));
  return largest;
}
bool isSame(const HairState& a, const HairState& b) {
  return a.positions == b.positions && a.velocities == b.velocities;
}

TEST_F(FeaturesTest, AddedBeforeTheFirstFrameTheyHaveTheBitsOfHairThatBeginsWithThem) {
  for (const Hair& hair : hairs()) {
    for (const Use& use : uses()) {
      Features features;
      features.*use.feature = true;
      for (const bool isPrepared : {false, true}) {
        SCOPED_TRACE(hair.name + std::string(", ") + use.name + (isPrepared ? ", prepared" : ", used"));
        Simulation begins = begin(hair, features), grows = begin(hair, {});
        if (isPrepared) {
          ASSERT_TRUE(grows.prepare(features));
        }
        const auto expected = run(begins, hair.groom, use, 0), found = run(grows, hair.groom, use, 0);
        for (int frame = 0; frame < kFrames; ++frame)
          EXPECT_TRUE(isSame(found[frame], expected[frame])) << frame;
      }
    }
  }
}

// Within what another kernel's rounding makes of it; without the feature it is elsewhere.
TEST_F(FeaturesTest, AddedOnTheWayTheHairGoesOn) {
  constexpr double kRounding = 2e-5;  // [m]
  for (const Hair& hair : hairs()) {
    const Use none{"none", nullptr, [](Simulation&, const Groom&) { return Status(); }};
    Simulation without = begin(hair, {});
    const auto otherwise = run(without, hair.groom, none, kFrames);
    for (const Use& use : uses()) {
      SCOPED_TRACE(hair.name + std::string(", ") + use.name);
      Features features;
      features.*use.feature = true;
      Simulation begins = begin(hair, features), grows = begin(hair, {});
      const auto expected = run(begins, hair.groom, use, 3), found = run(grows, hair.groom, use, 3);
      for (int frame = 0; frame < kFrames; ++frame)
        EXPECT_LT(largestDifference(found[frame], expected[frame]), kRounding) << frame;
      EXPECT_TRUE(isSame(found[2], otherwise[2]));
      if (hair.bodies.empty() || use.feature != &Features::bodies) {
        EXPECT_GT(largestDifference(found.back(), otherwise.back()), 10 * kRounding);
      }
    }
  }
}

TEST_F(FeaturesTest, OtherHeadsOfTheAssetKeepTheirBits) {
  for (const Hair& hair : hairs()) {
    for (const Use& use : uses()) {
      SCOPED_TRACE(hair.name + std::string(", ") + use.name);
      const auto asset = build(device(), hair);
      ASSERT_TRUE(asset);
      Simulation alone = *make(*asset, hair, kHeads[0]), one = *make(*asset, hair, kHeads[0]),
                 other = *make(*asset, hair, kHeads[0]);
      for (int frame = 0; frame < 4; ++frame) {
        const HeadPose end{{0.01 * frame, 0, 0}, {}};
        ASSERT_TRUE(alone.stepFrame(end));
        ASSERT_TRUE(one.stepFrame(end));
        if (frame == 1 && use.begin) {
          ASSERT_TRUE(use.begin(other, hair.groom));
        }
        if (frame == 1 && !use.begin) {
          ASSERT_TRUE(step(other, hair.groom, frame, true));
        }
        ASSERT_TRUE(other.stepFrame(end));
        EXPECT_TRUE(isSame(*one.state(), *alone.state())) << frame;
      }
    }
  }
}

TEST_F(FeaturesTest, HairThatWasCutKeepsWhatFell) {
  for (const Use& use : uses()) {
    SCOPED_TRACE(use.name);
    const Hair hair{"cut", randomGroom({31, 12, 40}, 3)};
    Features features;
    features.*use.feature = true;
    Simulation begins = begin(hair, features), grows = begin(hair, {});
    for (Simulation* one : {&begins, &grows}) {
      ASSERT_TRUE(step(*one, hair.groom, 0, false));
      ASSERT_TRUE(one->cut(std::vector<StrandCut>{{0, 12}, {2, 20}}));
    }
    const auto expected = run(begins, hair.groom, use, 1), found = run(grows, hair.groom, use, 1);
    for (int frame = 0; frame < kFrames; ++frame)
      EXPECT_LT(largestDifference(found[frame], expected[frame]), 2e-5) << frame;
    EXPECT_EQ(grows.report()->nonfinite, 0u);
    EXPECT_LT(grows.report()->maxEdgeStretch, 1.5);
  }
}

TEST_F(FeaturesTest, ACheckpointBringsThem) {
  for (const Use& use : uses()) {
    if (use.feature == &Features::bodies) continue;  // a checkpoint is of hair among as many bodies
    SCOPED_TRACE(use.name);
    const Hair hair{"kept", randomGroom({31, 12}, 3)};
    Simulation first = begin(hair, {}), second = begin(hair, {});
    run(first, hair.groom, use, 3);
    const auto kept = first.checkpoint();
    ASSERT_TRUE(kept);
    if (use.begin) {
      ASSERT_TRUE(use.begin(second, hair.groom));
    }
    const Status restored = second.restore(*kept);
    ASSERT_TRUE(restored) << restored.error().message;
    for (Simulation* one : {&first, &second}) {
      if (use.begin) {
        ASSERT_TRUE(use.begin(*one, hair.groom));
      }
      ASSERT_TRUE(step(*one, hair.groom, kFrames, !use.begin));
    }
    EXPECT_TRUE(isSame(*first.state(), *second.state()));
  }
}

TEST_F(FeaturesTest, OfAnotherIntegratorHairRefusesSomeAndGoesOn) {
  Hair hair{"paper", randomGroom({12, 9}, 3)};
  hair.settings.integrator = Integrator::paper;
  Simulation one = begin(hair, {});
  for (const Features features : {Features{.bodies = true}, {.goals = true}, {.fields = true}}) {
    const Status refused = one.prepare(features);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("integrator jacobi"), std::string::npos)
        << refused.error().message;
  }
  EXPECT_TRUE(one.prepare({.forces = true}));
  EXPECT_TRUE(step(one, hair.groom, 0, false));
}

}  // namespace
}  // namespace ringlet::test::features_test
