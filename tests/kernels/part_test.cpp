// KernelChoice::part: strands have the bits that they have in the whole groom, whichever others are there.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::part_test {
namespace {

using Part = GpuTest;

// Each k-th strand of the groom, from the first-th on.
std::vector<std::uint32_t> every(std::size_t k, std::size_t first, const Groom& groom) {
  std::vector<std::uint32_t> strands;
  for (std::size_t s = first; s < groom.strandCount(); s += k)
    strands.push_back(static_cast<std::uint32_t>(s));
  return strands;
}

// After frames in which numbers change, positions and velocities.
HairState stateAfter(Simulation& hair, const Hair& of, const Head& head) {
  for (int frame = 0; frame < 4; ++frame) {
    if (frame == 2) {
      Settings other = of.settings;
      other.gravity = {2, -5, 1};
      EXPECT_TRUE(hair.setSettings(other));
      Material material = varyingMaterial();
      material.coreStiffness *= 0.5;
      if (of.settings.integrator == Integrator::jacobi) {
        const Status set = hair.setMaterial(material);
        EXPECT_TRUE(set) << set.error().message;
      }
    }
    std::vector<HeadPose> poses;
    for (int k = 1; k <= of.settings.stepsPerFrame; ++k)
      poses.push_back(head.at((frame + double(k) / of.settings.stepsPerFrame) / 24));
    EXPECT_TRUE(hair.stepFrame(poses));
  }
  return *hair.state();
}

// Of hair of many lengths, whose shortest third alone would have other shapes.
Groom manyLengths() {
  std::vector<int> counts;
  for (int s = 0; s < 90; ++s) counts.push_back(s % 3 == 0 ? 6 + s % 7 : 20 + s % 61);
  return randomGroom(counts, 5);
}

TEST_F(Part, StrandsHaveTheBitsOfTheWhole) {
  std::vector<Hair> all = hairs();
  all.push_back({"many lengths", manyLengths()});
  for (const auto& [name, integrator] : {std::pair{"many lengths, point by point", Integrator::pointJacobi},
                                         std::pair{"many lengths, the paper's", Integrator::paper}}) {
    all.push_back({name, manyLengths()});
    all.back().settings.integrator = integrator;
  }
  for (Hair& hair : all) {
    if (hair.settings.contacts.on) continue;
    SCOPED_TRACE(hair.name);
    const auto asset = build(device(), hair);
    ASSERT_TRUE(asset) << asset.error().message;
    auto whole = make(*asset, hair, kHeads[1]);
    ASSERT_TRUE(whole) << whole.error().message;
    const HairState expected = stateAfter(*whole, hair, kHeads[1]);
    for (std::size_t first = 0; first < 3; ++first) {
      const std::vector<std::uint32_t> part = every(3, first, hair.groom);
      Hair own = hair;
      own.kernel.part = part;
      const auto partAsset = build(device(), own);
      ASSERT_TRUE(partAsset) << partAsset.error().message;
      EXPECT_EQ(partAsset->strandCount(), asset->strandCount());
      EXPECT_EQ(partAsset->rigidStrandCount(), 0u);
      auto some = make(*partAsset, own, kHeads[1]);
      ASSERT_TRUE(some) << some.error().message;
      EXPECT_EQ(Diagnostics(*some).rigidStrandCount(), 0u);
      EXPECT_LT(Diagnostics(*some).memory().total(), Diagnostics(*whole).memory().total());
      const HairState state = stateAfter(*some, own, kHeads[1]);
      ASSERT_EQ(state.positions.size(), expected.positions.size());
      int different = 0;
      for (std::uint32_t s = 0; s < hair.groom.strandCount(); ++s) {
        const std::uint32_t tip = hair.groom.firstPoint[s + 1] - 1;
        if (s % 3 != first) continue;
        for (std::uint32_t i = hair.groom.firstPoint[s]; i <= tip; ++i)
          different += !(state.positions[i] == expected.positions[i]) ||
                       !(state.velocities[i] == expected.velocities[i]);
      }
      EXPECT_EQ(different, 0) << "part " << first;
    }
  }
}

// Hair that is tied by force among bodies goes out of them and within the stretch limit for several rounds,
// some strands for more than others. Which others are in its subgroup changes nothing.
TEST_F(Part, CompanyAmongBodiesChangesNothing) {
  HeadParameters head{.strandCount = 90};
  head.curl.particleCount = 32;
  Hair hair{"tied", *makeHead(head)};
  hair.kernel.features.goals = true;
  hair.bodies.push_back({.radius = 0.1});
  std::vector<Vec3f> places;
  for (const Vec3f& p : hair.groom.points)
    places.push_back(p * static_cast<float>(0.35 * hair.groom.metresPerUnit) + Vec3f{0, -0.05f, -0.12f});
  std::vector<float> strengths(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) strengths[i] = i % 32 > 13 && i % 32 < 20 ? 50 : 0;
  const auto after = [&](const Hair& of) {
    auto simulation = make(*build(device(), of), of, kHeads[0]);
    EXPECT_TRUE(simulation && simulation->setGoals(places, strengths));
    return stateAfter(*simulation, of, kHeads[0]);
  };
  const HairState whole = after(hair);
  for (const std::size_t k : {2, 3, 7}) {
    const std::vector<std::uint32_t> part = every(k, 0, hair.groom);
    Hair own = hair;
    own.kernel.part = part;
    const HairState state = after(own);
    int different = 0;
    for (const std::uint32_t s : part)
      for (std::uint32_t i = hair.groom.firstPoint[s]; i < hair.groom.firstPoint[s + 1]; ++i)
        different += !(state.positions[i] == whole.positions[i]);
    EXPECT_EQ(different, 0) << k;
  }
}

TEST_F(Part, WhatCannotBeDividedIsRefused) {
  const auto refused = [&](Hair hair, std::vector<std::uint32_t> part, const char* message) {
    hair.kernel.part = part;
    const auto asset = build(device(), hair);
    ASSERT_FALSE(asset) << message;
    EXPECT_NE(asset.error().message.find(message), std::string::npos) << asset.error().message;
  };
  for (const Hair& hair : hairs())
    if (hair.settings.contacts.on) refused(hair, {0, 1}, "a part of hair with contacts needs a link");
  Hair hair = hairs()[0];
  refused(hair, {0, 7}, "a part names strand 7; the groom has 5, numbered from 0");
  refused(hair, {2, 0, 2}, "strand 2 is in a part twice");
  Hair sleepy = hair;
  sleepy.settings.sleepSpeed = 0.01;
  refused(sleepy, {0}, "hair that may sleep cannot be divided");
  const std::vector<std::uint32_t> part{1};
  hair.kernel.part = part;
  auto some = make(*build(device(), hair), hair, kHeads[0]);
  ASSERT_TRUE(some) << some.error().message;
  const Status set = some->setSettings(sleepy.settings);
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().message.find("may sleep"), std::string::npos) << set.error().message;
}

}  // namespace
}  // namespace ringlet::test::part_test
