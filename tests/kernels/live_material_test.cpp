// A material that changes while hair moves: the hair is as if it had been made of it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "ringlet/rest/live_material.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::live_material_test {
namespace {

using LiveMaterials = GpuTest;

struct Change {
  std::string name;
  std::function<void(Material&)> make;
};

// Every number of a material; times a half, and for the core's blend, which has an order, a bit more.
std::vector<Change> changes() {
  std::vector<Change> all;
  for (const Parameter<Material>& p : materialParameters()) {
    all.push_back({p.key, [&p](Material& material) {
                     const double value = p.of(material).value_or(0.01);
                     const bool isOrdered = std::string(p.key).starts_with("core_elongation");
                     p.set(material, isOrdered ? value + 0.02 : 0.5 * value);
                   }});
  }
  for (const Parameter<MaterialVariation>& p : variationParameters()) {
    all.push_back({"variation." + std::string(p.key),
                   [&p](Material& material) { p.set(material.variation, p.isWhole() ? 7 : 0.5); }});
  }
  all.push_back({"all", [](Material& m) {
                   m.bendStiffness = 11, m.stretchStiffness = 300, m.coreStiffness = 3,
                   m.coreDampingRatio = 0.6;
                   m.variation.bendStiffness = 0.1;
                 }});
  return all;
}

// Roots that are shifted go with it.
HeadPose headAt(double t) { return {Vec3d{t, 0, 0}, fromRotationVector(Vec3d{0, 3 * t, 1.5 * t}), 2 * t}; }

// Of a line density of its own, which is in all constants.
Material builtMaterial() {
  Material material = varyingMaterial();
  material.lineDensity = 4e-5;
  return material;
}

void step(Simulation& simulation, int from, int frames) {
  for (int frame = from; frame < from + frames; ++frame)
    ASSERT_TRUE(simulation.stepFrame(headAt((frame + 1) / simulation.settings().framesPerSecond)));
}

Result<Simulation> born(const ComputeDevice& device, const Hair& hair, const Material& material) {
  std::vector<Vec3d> shifts(hair.kernel.features.roots ? 0 : hair.groom.strandCount(), {0.01, 0, 0});
  return Simulation::create(device, hair.groom, material, hair.settings,
                            {.head = headAt(0), .bodies = hair.bodies, .rootShifts = shifts}, hair.kernel);
}

double farthestApart(const Simulation& a, const Simulation& b) {
  const auto p = *a.positions(), q = *b.positions();
  double apart = 0;
  for (std::size_t i = 0; i < p.size(); ++i) apart = std::max<double>(apart, length(p[i] - q[i]));
  return apart;
}

// As hair that was built of it, but for last digits of rest targets; what may not change is refused by name.
TEST_F(LiveMaterials, AreAsIfTheHairHadBeenMadeOfThem) {
  std::set<std::string> taken, felt;
  int refused = 0;
  for (const Hair& hair : hairs()) {
    if (hair.settings.contacts.on) continue;  // contacts part ways by last digits
    Simulation plain = *born(device(), hair, builtMaterial());
    step(plain, 0, 4);
    for (const Change& change : changes()) {
      SCOPED_TRACE(std::string(hair.name) + ", " + change.name);
      Material material = builtMaterial();
      change.make(material);
      Simulation late = *born(device(), hair, builtMaterial());
      const std::string fixed = fixedDifference(builtMaterial(), material);
      const Status status = late.setMaterial(material);
      ASSERT_EQ(static_cast<bool>(status), fixed.empty()) << (status ? "" : status.error().message);
      if (!status) {
        ++refused;
        EXPECT_NE(status.error().message.find(fixed), std::string::npos) << status.error().message;
        EXPECT_TRUE(late.material() == builtMaterial());
        continue;
      }
      taken.insert(change.name);
      EXPECT_TRUE(late.material() == material);
      auto early = born(device(), hair, material);
      ASSERT_TRUE(early) << early.error().message;
      EXPECT_EQ(late.warnings(), early->warnings());
      step(late, 0, 4);
      step(*early, 0, 4);
      EXPECT_LT(farthestApart(late, *early), 2e-5);
      if (farthestApart(late, plain) > 1e-5) felt.insert(change.name);
    }
  }
  EXPECT_EQ(taken, felt) << "some change nothing";
  EXPECT_EQ(taken.size(), 16u);
  EXPECT_GT(refused, 5);
}

// Hair at rest stays at rest when its material changes: its targets are balanced anew.
TEST_F(LiveMaterials, HairAtRestStaysAtRest) {
  for (Hair& hair : hairs()) {
    SCOPED_TRACE(hair.name);
    hair.settings.air = {};
    auto made = Simulation::create(device(), hair.groom, builtMaterial(), hair.settings, {}, hair.kernel);
    ASSERT_TRUE(made) << made.error().message;
    Simulation& simulation = *made;
    const std::vector<Vec3f> rest = *simulation.positions();
    for (const double stiffness : {20.0, 0.7, 3.0}) {
      Material material = builtMaterial();
      material.bendStiffness = stiffness;
      material.stretchStiffness = 30 * stiffness;
      ASSERT_TRUE(simulation.setMaterial(material));
      for (int frame = 0; frame < 6; ++frame) ASSERT_TRUE(simulation.stepFrame(HeadPose{}));
    }
    const std::vector<Vec3f> end = *simulation.positions();
    double moved = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) moved = std::max<double>(moved, length(end[i] - rest[i]));
    EXPECT_LT(moved, 1e-5);
  }
}

// To another and back: the targets it had, and the bits of its motion but for last digits of the sums.
TEST_F(LiveMaterials, HeadsOfOneAssetHaveMaterialsOfTheirOwn) {
  const Hair hair = hairs().front();
  const auto asset = HairAsset::build(device(), hair.groom, builtMaterial(), hair.settings);
  Simulation first = *make(*asset, hair, kHeads[0]), second = *make(*asset, hair, kHeads[0]),
             alone = *make(*asset, hair, kHeads[0]);
  const auto shared = Diagnostics(first).memory().shared;
  Material stiff = builtMaterial();
  stiff.bendStiffness *= 4;
  ASSERT_TRUE(first.setMaterial(stiff));
  EXPECT_GT(shared, 0u);
  const std::uint64_t places = device().gpu().properties().isCpu ? 0 : 4 * hair.groom.points.size();
  EXPECT_EQ(Diagnostics(first).memory().shared, places);
  EXPECT_EQ(Diagnostics(second).memory().shared, shared);
  step(first, 0, 3);
  step(second, 0, 3);
  step(alone, 0, 3);
  EXPECT_TRUE(second.state()->positions == alone.state()->positions);
  EXPECT_GT(farthestApart(first, second), 1e-4);
}

// From the next frame on, whatever is under way.
TEST_F(LiveMaterials, ChangeBetweenFrames) {
  std::vector<Hair> all = hairs();
  all.push_back(
      {"long frames", randomGroom(std::vector<int>(600, 64), 2)});  // longer than it takes to change
  for (const Hair& hair : all) {
    SCOPED_TRACE(hair.name);
    Simulation waits = *born(device(), hair, builtMaterial()), flies = *born(device(), hair, builtMaterial());
    const auto materialOf = [](int frame) {
      Material material = builtMaterial();
      material.bendStiffness = 1 + frame % 2 * 10;
      return material;
    };
    for (int frame = 0; frame < 6; ++frame) {
      ASSERT_TRUE(waits.setMaterial(materialOf(frame)));
      step(waits, frame, 1);
    }
    for (int frame = 0; frame < 6; ++frame) {
      ASSERT_TRUE(flies.setMaterial(materialOf(frame)));
      std::vector<HeadPose> poses;
      for (int k = 1; k <= hair.settings.stepsPerFrame; ++k)
        poses.push_back(interpolate(headAt(frame / hair.settings.framesPerSecond),
                                    headAt((frame + 1) / hair.settings.framesPerSecond),
                                    double(k) / hair.settings.stepsPerFrame));
      ASSERT_TRUE(flies.submitFrame(poses));
      if (frame == 0) continue;
      ASSERT_TRUE(flies.waitFrame());
    }
    EXPECT_TRUE(flies.state()->positions == waits.state()->positions);
  }
}

// The sentences of the material change with it, others stay.
TEST_F(LiveMaterials, WarningsAreThoseOfTheMaterial) {
  Hair hair = hairs().front();
  std::vector<Vec3f> tiny;
  for (int i = 0; i < 20; ++i) tiny.push_back(Vec3f(Vec3d{1, -1e-8 * i, 0}));
  hair.groom.addStrand(tiny);
  Material lively = builtMaterial();
  lively.bendDampingRatio = 0.05;
  Simulation simulation = *born(device(), hair, lively);
  for (const double stiffness : {0.02, 5.0, 400.0}) {
    for (const double damping : {0.05, 0.2}) {
      Material material = lively;
      material.bendStiffness = stiffness, material.bendDampingRatio = damping;
      material.coreStiffness = 1000 * stiffness;
      ASSERT_TRUE(simulation.setMaterial(material));
      const std::vector<std::string> expected = born(device(), hair, material)->warnings();
      EXPECT_EQ(simulation.warnings(), expected);
      EXPECT_GT(expected.size(), damping < 0.1 ? 1u : 0u);
    }
  }
}

TEST_F(LiveMaterials, WhatCannotBeIsRefused) {
  const Hair hair = hairs().front();
  Simulation simulation = *born(device(), hair, builtMaterial());
  Material wrong = builtMaterial();
  wrong.bendStiffness = -1;
  EXPECT_NE(simulation.setMaterial(wrong).error().message.find("bend_stiffness"), std::string::npos);
  Hair paper = hair;
  paper.settings.integrator = Integrator::paper;
  paper.settings.stepsPerFrame = 30;
  Simulation printed = *born(device(), paper, builtMaterial());
  Material soft = builtMaterial();
  EXPECT_TRUE(printed.setMaterial(soft)) << "no change";
  soft.bendStiffness /= 2;
  EXPECT_NE(printed.setMaterial(soft).error().message.find("jacobi only"), std::string::npos);
}

}  // namespace
}  // namespace ringlet::test::live_material_test
