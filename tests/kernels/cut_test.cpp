// Simulation::cut: what is kept stays as it was, and what is cut off falls.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "reference/step.h"
#include "ringlet/groom/generate.h"
#include "tests/kernels/kernel_variants.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::cut_test {
namespace {

using Cut = GpuTest;

// Two strands to the side, wavy, and a straight one between them.
Groom threeStrands() {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 3; ++s) {
    const float bend = s == 1 ? 0.f : 0.004f;
    for (int i = 0; i < 30; ++i) {
      const float t = 0.4f * static_cast<float>(i);
      groom.points.push_back({0.005f * static_cast<float>(i), bend * std::sin(t),
                              0.05f * static_cast<float>(s) + bend * std::cos(t)});
    }
    groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
  }
  return groom;
}

// Particle masses, up to a factor: half of each edge.
Vec3d centreOf(const Groom& groom, const std::vector<Vec3f>& points, std::size_t strand, std::size_t keep) {
  const std::size_t first = groom.firstPoint[strand], count = groom.strand(strand).size();
  Vec3d sum{};
  double all = 0;
  for (std::size_t i = keep; i < count; ++i) {
    const auto edge = [&](std::size_t a) {
      return length(Vec3d(groom.points[first + a + 1]) - Vec3d(groom.points[first + a]));
    };
    const double mass = edge(i - 1) + (i + 1 < count ? edge(i) : 0);
    sum = sum + Vec3d(points[first + i]) * mass;
    all += mass;
  }
  return sum / all;
}

std::vector<HeadPose> still(const Settings& settings) {
  return std::vector<HeadPose>(static_cast<std::size_t>(settings.stepsPerFrame));
}

std::vector<KernelChoice> forms() {
  return {{},
          {.particlesPerLane = 16, .lanes = 2},
          {.particlesPerLane = 8, .lanes = 4},
          {KernelChoice::Form::memory, 9, 4},
          {.form = KernelChoice::Form::serial}};
}

// g t^2 / 2 of steps T is g T^2 n (n + 1) / 2.
TEST_F(Cut, CentreOfMassFallsFreely) {
  const Groom groom = threeStrands();
  Settings settings;
  settings.stepsPerFrame = 8;
  for (const KernelChoice& kernel : forms()) {
    auto hair = Simulation::create(device(), groom, {}, settings, {}, kernel);
    ASSERT_TRUE(hair) << hair.error().message;
    for (int frame = 0; frame < 6; ++frame) ASSERT_TRUE(hair->stepFrame(still(settings)));
    const auto before = *hair->state();
    const std::vector<StrandCut> cuts{{0, 12}, {2, 20}};
    const Status cut = hair->cut(cuts);
    ASSERT_TRUE(cut) << cut.error().message;
    EXPECT_EQ(*hair->positions(), before.positions);  // nothing moved yet
    const int frames = 10;
    for (int frame = 0; frame < frames; ++frame) ASSERT_TRUE(hair->stepFrame(still(settings)));
    const auto after = *hair->positions();
    const double T = settings.stepSeconds(), n = frames * settings.stepsPerFrame;
    for (const StrandCut& of : cuts) {
      const Vec3d start = centreOf(groom, before.positions, of.strand, of.keep);
      const Vec3d speed = centreOf(groom, before.velocities, of.strand, of.keep);
      const Vec3d expected = start + speed * (n * T) + settings.gravity * (T * T * n * (n + 1) / 2);
      EXPECT_LT(length(centreOf(groom, after, of.strand, of.keep) - expected), 2e-5) << of.strand;
      EXPECT_GT(length(expected - start), 0.5);
    }
    EXPECT_LT((*hair->report()).maxEdgeStretch, settings.maxStretch * 1.001);
  }
}

// Without gravity both parts are at rest, at their rest shape: in double to 1e-12 m. In float each step
// rounds a coordinate below 0.25 m to half a unit in the last place, 2^-27 m, and nothing brings a free piece
// back. What a root holds is within 0.1 um.
TEST_F(Cut, WithoutGravityNothingMoves) {
  const Groom groom = threeStrands();
  Settings settings;
  settings.gravity = {};
  const std::vector<StrandCut> cuts{{0, 12}, {1, 2}};
  const int frames = 12;
  const double rounded = frames * settings.stepsPerFrame * std::ldexp(1.0, -27);  // [m]
  reference::Simulation<double> exact(groom, {}, settings);
  exact.cut(groom, {}, cuts);
  const auto start = exact.positions();
  for (int frame = 0; frame < frames; ++frame) exact.stepFrame(still(settings));
  for (std::size_t i = 0; i < start.size(); ++i)
    EXPECT_LT((exact.positions()[i] - start[i]).norm(), 1e-12) << i;
  for (const KernelChoice& kernel : forms()) {
    auto hair = Simulation::create(device(), groom, {}, settings, {}, kernel);
    auto whole = Simulation::create(device(), groom, {}, settings, {}, kernel);
    ASSERT_TRUE(hair && whole);
    ASSERT_TRUE(hair->cut(cuts));
    for (int frame = 0; frame < frames; ++frame) {
      ASSERT_TRUE(hair->stepFrame(still(settings)));
      ASSERT_TRUE(whole->stepFrame(still(settings)));
    }
    const auto points = *hair->positions(), ofWhole = *whole->positions();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool isFree =
          (i >= 12 && i < groom.firstPoint[1]) || (i >= groom.firstPoint[1] + 2 && i < groom.firstPoint[2]);
      EXPECT_LT(length(Vec3d(points[i]) - Vec3d(groom.points[i])), isFree ? rounded : 1e-7) << i;
    }
    for (std::size_t i = groom.firstPoint[2]; i < points.size(); ++i) EXPECT_EQ(points[i], ofWhole[i]) << i;
  }
}

// A bent piece that is let go swings about its rest shape, and what the head does is not felt.
TEST_F(Cut, FallsBesideAHeadThatTurnsAndTravels) {
  const Groom groom = threeStrands();
  Settings settings;
  Material material;
  material.inertiaFactor = 2;
  auto hair = Simulation::create(device(), groom, material, settings, {});
  ASSERT_TRUE(hair);
  const auto before = *hair->positions();
  ASSERT_TRUE(hair->cut(std::vector<StrandCut>{{0, 12}}));
  const int frames = 12;
  for (int frame = 1; frame <= frames; ++frame) {
    const Status stepped =
        hair->stepFrame(HeadPose{{0.02 * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.1 * frame, 0})});
    ASSERT_TRUE(stepped);
  }
  std::vector<Vec3f> world = *hair->positions();
  for (Vec3f& p : world) p = static_cast<Vec3f>(Vec3d(p) + hair->head().position);
  const double T = settings.stepSeconds(), n = frames * settings.stepsPerFrame;
  const Vec3d expected = centreOf(groom, before, 0, 12) + settings.gravity * (T * T * n * (n + 1) / 2);
  EXPECT_LT(length(centreOf(groom, world, 0, 12) - expected), 5e-5);
}

// Where the head jumps, what fell stays in the world with its speed, and goes on falling a frame later.
TEST_F(Cut, StaysWhereItIsWhenTheHeadJumps) {
  const Groom groom = threeStrands();
  Settings settings;
  settings.teleportDistance = 0.5;
  const std::vector<StrandCut> cuts{{0, 12}, {2, 7}};
  auto hair = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(hair) << hair.error().message;
  reference::Simulation<double> exact(groom, {}, settings);
  ASSERT_TRUE(hair->cut(cuts));
  exact.cut(groom, {}, cuts);
  std::vector<HeadPose> heads{{}};  // walking, then elsewhere, turned
  for (int frame = 1; frame <= 4; ++frame) heads.push_back({{0.02 * frame, 0, 0}, {}});
  heads.push_back({{0.6, 0.2, 0.4}, fromRotationVector(Vec3d{0, 1, 0})});
  heads.push_back({{0.6, 0.2, 0.38}, fromRotationVector(Vec3d{0, 1.1, 0})});
  std::vector<Vec3d> centres;
  for (std::size_t frame = 1; frame < heads.size(); ++frame) {
    std::vector<HeadPose> poses;
    const int steps = settings.stepsPerFrame;
    for (int k = 1; k <= steps; ++k)
      poses.push_back(interpolate(heads[frame - 1], heads[frame], double(k) / steps));
    ASSERT_TRUE(hair->stepFrame(poses));
    exact.stepFrame(poses);
    const auto points = *hair->positions();
    centres.push_back(centreOf(groom, points, 0, 12) + hair->head().position);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((reference::toEigen<double>(points[i]) - exact.positions()[i]).norm(), 2e-6)
          << frame << ' ' << i;
  }
  EXPECT_LT(length(centres[4] - centres[3]), 1e-6);  // in the frame of the jump
  const double T = settings.stepSeconds(), n = settings.stepsPerFrame;
  const Vec3d expected = (centres[3] - centres[2]) + settings.gravity * (T * T * n * n);
  EXPECT_LT(length(centres[5] - centres[4] - expected), 1e-5);
}

// Checkpoints go with cuts, and a strand may be cut again.
TEST_F(Cut, GoesOnFromACheckpoint) {
  const Groom groom = threeStrands();
  const Settings settings;
  const std::vector<StrandCut> first{{0, 20}, {1, 9}}, second{{0, 10}};
  const auto make = [&] { return Simulation::create(device(), groom, {}, settings); };
  auto hair = make();
  ASSERT_TRUE(hair);
  for (int frame = 0; frame < 4; ++frame) {
    if (frame == 1 || frame == 2) {
      ASSERT_TRUE(hair->cut(frame == 1 ? first : second));
    }
    ASSERT_TRUE(hair->stepFrame(still(settings)));
  }
  const auto saved = *hair->checkpoint();
  auto other = make();
  ASSERT_TRUE(other);
  ASSERT_TRUE(other->cut(first));
  ASSERT_TRUE(other->cut(second));
  ASSERT_TRUE(other->restore(saved));
  for (int frame = 0; frame < 4; ++frame) {
    ASSERT_TRUE(hair->stepFrame(still(settings)));
    ASSERT_TRUE(other->stepFrame(still(settings)));
  }
  EXPECT_EQ(*hair->positions(), *other->positions());
  const auto state = *hair->state();
  EXPECT_LT(state.velocities[groom.firstPoint[0] + 15].y, -1.5);  // of the second piece, 6 frames of 1/24 s
}

// Most strands, near the root, the tip and where lanes meet; then some of them once more.
std::vector<std::vector<StrandCut>> awkwardCuts(const Groom& groom, std::uint32_t least = 2) {
  std::vector<std::vector<StrandCut>> cuts(2);
  for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
    const auto count = static_cast<std::uint32_t>(groom.strand(s).size());
    if (count <= least || s % 5 == 4) continue;
    const std::uint32_t places[] = {least, count - 1, count / 2, 16, 17, 33};
    const std::uint32_t keep = std::clamp(places[s % std::size(places)], least, count - 1);
    cuts[0].push_back({s, keep});
    if (s % 3 == 0 && keep > least) cuts[1].push_back({s, std::max(least, keep / 2)});
  }
  return cuts;
}

ParityCase cutCase(const Groom& groom, const KernelChoice& kernel, const Settings& settings = {}) {
  return {.groom = groom,
          .material = {},
          .settings = settings,
          .kernel = kernel,
          .cuts = awkwardCuts(groom, static_cast<std::uint32_t>(std::max(settings.rootCount, 2)))};
}

class CutParity : public GpuTest {
 protected:
  void expectOneStep(const ParityCase& c, const std::string& label, double tolerance = kOneStep) {
    if (!makes(c.kernel, c.groom)) return;
    for (const FieldError& e : oneStepErrors(device(), c))
      EXPECT_LE(e.error, tolerance) << label << ": " << e.field << "\n" << e.where;
  }
  void expectOneFrame(const ParityCase& c, const std::string& label, double tolerance = kOneFrame) {
    if (!makes(c.kernel, c.groom)) return;
    const FieldError e = oneFrameError(device(), c);
    EXPECT_LE(e.error, tolerance) << label << ": " << e.where;
    RecordProperty(label, std::to_string(e.error));
  }
};

TEST_F(CutParity, AStepIsTheReferenceInEveryForm) {
  Material heavyHead;
  heavyHead.inertiaFactor = 1.7;
  heavyHead.gravityFactor = 0.6;
  heavyHead.bendStiffnessProfile.points = {{0, 2}, {1, 0.3}};
  heavyHead.coreStiffnessProfile.points = {{0, 0.5}, {1, 1.5}};
  heavyHead.stretchStiffnessProfile.points = {{0, 1}, {1, 0.4}};
  for (const Variant& variant : kVariants) {
    ParityCase c = cutCase(randomGroom(awkwardLengths(37), 7), variant.kernel);
    expectOneStep(c, variant.name);
    c.material = heavyHead;
    c.settings.rootCount = 3;
    c.cuts = awkwardCuts(c.groom, 3);
    expectOneStep(c, fmt::format("{}, three roots, another material", variant.name));
  }
}

TEST_F(CutParity, AFrameIsTheReferenceInEveryForm) {
  for (const Variant& variant : kVariants)
    expectOneFrame(cutCase(randomGroom(awkwardLengths(25), 29), variant.kernel), variant.name);
}

TEST_F(CutParity, WhatActsOnHairActsOnWhatFalls) {
  Settings settings;
  settings.air.on = true;
  settings.air.wind = {2, 0, 1};
  settings.air.turbulence = 1;
  KernelChoice kernel{.particlesPerLane = 8, .lanes = 4};
  kernel.features.forces = kernel.features.goals = kernel.features.fields = kernel.features.roots = true;
  ParityCase c = cutCase(randomGroom({2, 3, 31, 30, 16, 17, 5, 32, 9, 24, 29, 13}, 43), kernel, settings);
  expectOneStep(c, "air, forces, goals, fields, roots");
  expectOneFrame(c, "air, forces, goals, fields, roots");
  c.settings.goal.shape = true;
  expectOneStep(c, "goals of edges");
}

// What falls has the rest pose as the head had it, however that was turned.
TEST_F(CutParity, WhatFallsIsTurnedAsTheHeadWas) {
  for (const KernelChoice& kernel : {KernelChoice{}, {KernelChoice::Form::memory, 33, 4}}) {
    ParityCase c = cutCase(randomGroom(awkwardLengths(13), 47), kernel);
    c.material = varyingMaterial();
    c.turned = fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0});
    expectOneStep(c, "turned");
    expectOneFrame(c, "turned");
    c.turned = fromRotationVector(Vec3d{0.5, 2, -1});
    c.shiftsRoots = true;
    expectOneStep(c, "turned and shifted");
  }
}

// A strand that is cut, and again when its head has turned further: each piece keeps the turn of its own cut,
// also when its constants are made anew for another material.
TEST_F(CutParity, EachPieceKeepsTheTurnOfItsCut) {
  const Groom groom = threeStrands();
  const Settings settings;
  auto hair = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(hair) << hair.error().message;
  reference::Simulation<double> exact(groom, {}, settings);
  Material material;
  HeadPose before;
  for (int frame = 1; frame <= 5; ++frame) {
    if (frame == 2 || frame == 4) {
      const std::vector<StrandCut> cuts{{0, frame == 2 ? 20u : 10u}, {2, frame == 2 ? 12u : 5u}};
      ASSERT_TRUE(hair->cut(cuts));
      exact.cut(groom, material, cuts);
    }
    if (frame == 5) {
      material.bendStiffness *= 2;
      ASSERT_TRUE(hair->setMaterial(material));
      exact.change(groom, material, settings);
    }
    const HeadPose next{{}, fromRotationVector(Vec3d{0.3, 0.1, 0.2} * frame)};
    std::vector<HeadPose> poses;
    for (int k = 1; k <= settings.stepsPerFrame; ++k)
      poses.push_back(interpolate(before, next, double(k) / settings.stepsPerFrame));
    before = next;
    ASSERT_TRUE(hair->stepFrame(poses));
    exact.stepFrame(poses);
    const auto points = *hair->positions();
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((reference::toEigen<double>(points[i]) - exact.positions()[i]).norm(), 5e-6)
          << frame << ' ' << i;
  }
}

TEST_F(CutParity, BodiesHoldWhatFalls) {
  ParityCase c = cutCase(randomGroom(awkwardLengths(25), 43), {.form = KernelChoice::Form::serial});
  for (const Body& body : sampleBodies()) {
    c.bodies = {body};
    expectOneStep(c, body.name, kOneStepAmongBodies);
    expectOneFrame(c, body.name, kOneFrameAmongBodies);
  }
  c = cutCase(randomGroom({2, 3, 31, 30, 16, 17, 5, 32, 9, 24, 29, 13}, 43),
              {.particlesPerLane = 8, .lanes = 4});
  c.bodies = sampleBodies();
  expectOneStep(c, "all bodies", kOneStepAmongBodies);
}

TEST_F(Cut, RefusesWhatItCannot) {
  const Groom groom = threeStrands();
  Settings settings;
  auto hair = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(hair);
  for (const StrandCut wrong : {StrandCut{0, 1}, {0, 30}, {3, 10}}) {
    const Status cut = hair->cut(std::vector<StrandCut>{wrong});
    EXPECT_FALSE(cut) << wrong.strand << ' ' << wrong.keep;
  }
  ASSERT_TRUE(hair->cut(std::vector<StrandCut>{{0, 10}}));
  EXPECT_FALSE(hair->cut(std::vector<StrandCut>{{0, 10}}));  // nothing would fall
  settings.integrator = Integrator::pointJacobi;
  auto iterated = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(iterated);
  EXPECT_FALSE(iterated->cut(std::vector<StrandCut>{{0, 10}}));
}

}  // namespace
}  // namespace ringlet::test::cut_test
