// Bodies and air in the strand kernels, both forms, against the float reference: one step from random states
// among bodies of every shape, and a frame against double. Mirrors shaders/bodies/*.glsl.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::body_step_test {
namespace {

// Kernels with bodies take seconds to compile, one for every number of lanes: each form has strands of one.
struct Variant {
  const char* name;
  KernelChoice kernel;
  std::vector<int> lengths;  // particles of the strands
};
const Variant kAutomatic{"automatic", {}, {65, 100, 128, 127, 66, 99, 70}};
const std::vector<Variant> kVariants = {
    {"automatic, mixed", {}, {2, 3, 31, 64, 100, 16, 17, 64, 65, 5, 33, 128, 127}},
    {"lanes of 4", {KernelChoice::Form::automatic, 4}, {17, 31, 32, 18, 24, 29}},
    {"lanes of 8", {KernelChoice::Form::automatic, 8}, {33, 64, 63, 40, 49, 57}},
    {"2 lanes of 70 in memory", {KernelChoice::Form::memory, 70, 2}, {2, 139, 71, 70, 69, 140, 62, 31}},
    {"4 lanes of 33 in memory", {KernelChoice::Form::memory, 33, 4}, {132, 131, 34, 33, 64, 66, 99, 100}},
    {"serial", {KernelChoice::Form::serial}, {2, 3, 31, 64, 100, 16, 17, 64, 65, 5, 33, 128, 127}},
};

class BodyStep : public GpuTest {
 protected:
  void expectOneStep(const ParityCase& c, const std::string& label, double tolerance) {
    if (!makes(c.kernel, c.groom)) return;
    const auto errors = oneStepErrors(device(), c);
    fmt::print("{:<44} {}\n", label, toText(errors));
    for (const FieldError& e : errors)
      EXPECT_LE(e.error, tolerance) << label << ": " << e.field << "\n" << e.where;
  }
};

// Each of the shapes below the roots, where strands of 25 cm hang into it or beside it, turned and moving.
std::vector<Body> amongStrands(const Body& shape) {
  Body body = shape;
  body.place = {{0.02, -0.2, 0.03}, fromRotationVector(Vec3d{0.3, 0.2, -0.4})};
  Body moving = body;
  moving.place.position = {-0.05, 0, -0.04};
  moving.motion = Motion{.kind = MotionKind::glide, .axis = {0, 1, 0}, .amplitude = 3, .start = {3, 0.7, 0}};
  return {body, moving};
}

TEST_F(BodyStep, EveryShapeAgrees) {
  for (const Body& shape : sampleBodies()) {
    ParityCase c{randomGroom(kAutomatic.lengths, 7), {}, {}, kAutomatic.kernel, 1, amongStrands(shape)};
    c.settings.gravityPreload = 0.7;
    expectOneStep(c, shape.name, kOneStepAmongBodies);
  }
}

TEST_F(BodyStep, ManyBodiesAgree) {
  for (const Variant& variant : kVariants) {
    ParityCase c{randomGroom(variant.lengths, 9), {}, {}, variant.kernel, 2};
    for (const Body& shape : sampleBodies()) {
      for (Body body : amongStrands(shape)) {
        body.place.position += Vec3d{0.05, -0.02, 0.01} * static_cast<double>(c.bodies.size());
        c.bodies.push_back(std::move(body));
      }
    }
    expectOneStep(c, fmt::format("{} bodies, {}", c.bodies.size(), variant.name), kOneStepAmongBodies);
  }
}

// One that bends and another: alone, and among others of every shape.
TEST_F(BodyStep, BendingBodiesAgree) {
  for (const Variant& variant : kVariants) {
    ParityCase c{randomGroom(variant.lengths, 33),     {}, {}, variant.kernel, 8,
                 amongStrands(bendingBall(0.1, 0.006))};
    expectOneStep(c, fmt::format("bodies that bend, {}", variant.name), kOneStepAmongBodies);
    for (const Body& shape : sampleBodies())
      for (const Body& body : amongStrands(shape)) c.bodies.push_back(body);
    expectOneStep(c, fmt::format("bodies that bend among others, {}", variant.name), kOneStepAmongBodies);
  }
}

// A grid whose origin is beside it, as a mesh's of a world often is, turned about that.
TEST_F(BodyStep, BodiesFarFromTheirOriginAgree) {
  const Vec3d beside{0.1, -0.3, 0.2};
  for (const Variant& variant : {kAutomatic, kVariants.back()}) {
    ParityCase c{randomGroom(variant.lengths, 21),          {}, {}, variant.kernel, 7,
                 amongStrands(gridBall(0.1, 0.005, beside))};
    for (Body& body : c.bodies) {
      body.place.rotation = fromRotationVector(Vec3d{0, std::numbers::pi, 0.4});
      body.place.position -= rotate(body.place.rotation, beside);
    }
    expectOneStep(c, fmt::format("a grid beside its origin, {}", variant.name), kOneStepAmongBodies);
  }
}

// Strands straight down, and about the middle of one edge of each a ball that is too small to touch anything
// else: each edge in turn, those from a lane's last particle to the next lane's first too.
TEST_F(BodyStep, AnEdgeAloneAgrees) {
  constexpr std::uint32_t kParticles = 13;
  constexpr double kEdge = 0.06;
  ParityCase c;
  c.groom.metresPerUnit = 1;
  for (std::uint32_t s = 1; s + 1 < kParticles; ++s) {
    std::vector<Vec3f> strand;
    for (std::uint32_t i = 0; i < kParticles; ++i) strand.push_back(Vec3f(Vec3d{0.2 * s, -kEdge * i, 0}));
    c.groom.addStrand(strand);
    c.bodies.push_back({.shape = BodyShape::sphere, .radius = 0.35 * kEdge});
    c.bodies.back().place.position = Vec3d{0.2 * s, 0, 0} + Vec3d{0.15, -(s + 0.5), 0.2} * kEdge;
  }
  for (const KernelChoice& kernel : {KernelChoice{KernelChoice::Form::lanes, 4, 4},
                                     {KernelChoice::Form::lanes, 7, 2},
                                     {KernelChoice::Form::memory, 4, 4},
                                     {KernelChoice::Form::serial}}) {
    if (!makes(kernel, c.groom)) continue;
    c.kernel = kernel;
    expectOneStep(c, fmt::format("an edge alone, {} lanes", kernel.lanes), kOneStepAmongBodies);
    auto held = Simulation::create(device(), c.groom, {}, {}, {.bodies = c.bodies}, kernel),
         free = Simulation::create(device(), c.groom, {}, {}, {}, kernel);
    ASSERT_TRUE(held && free);
    for (auto* each : {&*held, &*free}) ASSERT_TRUE(each->stepFrame(HeadPose{}));
    const auto pushed = *held->positions(), still = *free->positions();
    for (std::uint32_t s = 0; s < c.groom.strandCount(); ++s) {
      const std::uint32_t k = c.groom.firstPoint[s] + s + 1;
      EXPECT_GT(length(pushed[k] - still[k]), 1e-4f) << "strand " << s;
      EXPECT_GT(length(pushed[k + 1] - still[k + 1]), 1e-4f) << "strand " << s;
    }
  }
}

// With air, and with roots of their own (Features::roots).
TEST_F(BodyStep, MovingRootsAgree) {
  for (Variant variant : {kAutomatic, kVariants.back()}) {
    variant.kernel.features.roots = true;
    ParityCase c{randomGroom(variant.lengths, 15),    {}, {}, variant.kernel, 5,
                 amongStrands(sampleBodies().front())};
    c.settings.air = {.on = true, .fallSpeed = 2, .wind = {5, 0, 1}, .turbulence = 1};
    expectOneStep(c, fmt::format("moving roots, {}", variant.name), kOneStepAmongBodies);
  }
}

TEST_F(BodyStep, AirAgrees) {
  for (const double turbulence : {0.0, 2.0}) {
    for (const Variant& variant : kVariants) {
      ParityCase c{randomGroom(variant.lengths, 11), {}, {}, variant.kernel, 3};
      c.settings.air = {.on = true, .fallSpeed = 2, .wind = {5, 0, 1}, .gust = 0.5, .turbulence = turbulence};
      expectOneStep(c, fmt::format("turbulence {}, {}", turbulence, variant.name), kOneStep);
    }
  }
}

// Gusts and turbulence go on from frame to frame: the wind has a time of its own, which the device is told.
TEST_F(BodyStep, FramesInTheWindAgreeWithDouble) {
  ParityCase c{randomGroom({33, 64, 63, 40}, 17), {}, {}, kVariants[2].kernel, 6};
  c.settings.air = {
      .on = true, .fallSpeed = 2, .wind = {5, 0, 1}, .gust = 1, .gustSeconds = 0.1, .turbulence = 2};
  const FieldError e = oneFrameError(device(), c, 3);
  fmt::print("three frames in the wind: {:.1e} of the arc length\n", e.error);
  EXPECT_LE(e.error, kOneFrame) << e.where;
}

// Not of a distance grid: its normals jump where cells meet, and what lies there may go either way by
// rounding (2e-3 of the length in one of ten frames; step by step from the same state they agree to 1e-8 m).
TEST_F(BodyStep, AFrameAgreesWithDouble) {
  for (const Body& shape : sampleBodies()) {
    if (shape.shape == BodyShape::grid) continue;
    for (const Variant& variant : {kAutomatic, kVariants.back()}) {
      ParityCase c{randomGroom(variant.lengths, 13), {}, {}, variant.kernel, 4, amongStrands(shape)};
      c.bodies.pop_back();
      c.settings.air = {.on = true, .fallSpeed = 3, .wind = {2, 0, 1}, .turbulence = 1};
      if (!makes(c.kernel, c.groom)) continue;
      const FieldError e = oneFrameError(device(), c);
      fmt::print("one frame, {}, {:<12} {:.1e} of the arc length\n", shape.name, variant.name, e.error);
      EXPECT_LE(e.error, kOneFrameAmongBodies) << variant.name << ": " << e.where;
    }
  }
}

}  // namespace
}  // namespace ringlet::test::body_step_test
