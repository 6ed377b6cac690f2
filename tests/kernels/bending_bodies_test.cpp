// Bodies that bend (solver/inputs/bending_bodies.h) over frames: against the reference, against their
// triangles, and bit for bit through checkpoints and frames in flight.
#include "ringlet/solver/inputs/bending_bodies.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "reference/step.h"
#include "ringlet/solver/simulation.h"
#include "tests/bodies/body_samples.h"
#include "tests/support/gpu_test.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::bending_bodies_test {
namespace {

// A frame of a head that turns and of its bodies; the first of them bends.
struct Frame {
  std::vector<HeadPose> heads;
  std::vector<BodyPose> bodies;
  std::vector<std::vector<Vec3d>> points;
  std::vector<std::span<const Vec3d>> spans() const { return {points.begin(), points.end()}; }
};

HeadPose headAt(double t) { return {{0.1 * t, 0, -0.05 * t}, fromRotationVector(Vec3d{0, 0.5 * t, 0})}; }

// `samples` of the points, which divide the steps.
Frame frameOf(const std::vector<Body>& bodies, const Settings& settings, int number, int samples) {
  Frame frame;
  std::vector<double> times, sampled;
  for (int k = 1; k <= settings.stepsPerFrame; ++k) {
    times.push_back((number * settings.stepsPerFrame + k) * settings.stepSeconds());
    frame.heads.push_back(headAt(times.back()));
  }
  frame.bodies = bodyPosesOf(bodies, frame.heads, times);
  std::vector<BodyPose> poses;
  for (int s = 1; s <= samples; ++s) {
    const auto step = static_cast<std::size_t>(s * settings.stepsPerFrame / samples - 1);
    sampled.push_back(times[step]);
    for (std::size_t b = 0; b < bodies.size(); ++b) poses.push_back(frame.bodies[step * bodies.size() + b]);
  }
  frame.points = bentInWorld(bodies, poses, sampled);
  return frame;
}

// Strands that hang beside and above a ball, which bulges against them.
Groom hangingStrands() {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 40; ++s) {
    const double turn = 2 * std::numbers::pi * s / 40, out = 0.085 + 0.035 * (s % 5) / 5.0;
    std::vector<Vec3f> strand;
    for (int i = 0; i < 24; ++i)
      strand.push_back(Vec3f(Vec3d{out * std::sin(turn), 0.16 - 0.008 * i, out * std::cos(turn)}));
    groom.addStrand(strand);
  }
  return groom;
}

Settings sixSteps() {
  Settings settings;
  settings.stepsPerFrame = 6;
  return settings;
}

struct Case {
  std::vector<Body> bodies{bendingBall(0.1, 0.006)};
  Groom groom = hangingStrands();
  Settings settings = sixSteps();
  int samples = 6;
  KernelChoice kernel{};

  Simulation make(const ComputeDevice& device) const {
    auto made =
        Simulation::create(device, groom, {}, settings, {.head = headAt(0), .bodies = bodies}, kernel);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  void step(Simulation& hair, int frame) const {
    const Frame now = frameOf(bodies, settings, frame, samples);
    const Status stepped = hair.stepFrame(now.heads, now.bodies, {}, now.spans());
    EXPECT_TRUE(stepped) << stepped.error().message;
  }
};

using BendingBodiesTest = GpuTest;

template <class Real>
reference::Field<Real> fieldOf(const std::vector<Vec3f>& values) {
  reference::Field<Real> field;
  for (const Vec3f& value : values) field.push_back(reference::toEigen<Real>(value));
  return field;
}

// How many strands come out of a frame elsewhere, by more than 0.01 mm.
template <class A, class B>
std::size_t differing(const Groom& groom, const A& some, const B& others) {
  std::size_t differ = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    double worst = 0;
    for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      worst = std::max(worst, (some[i].template cast<double>() - others[i].template cast<double>()).norm());
    differ += worst > 1e-5;
  }
  return differ;
}

// Frames of six steps with fewer fields, between which the surface is carried; each begins with the same
// state. Which triangle is nearest decides how the surface moves, so rounding may send a strand elsewhere:
// the device must do that no more often than the reference in float.
TEST_F(BendingBodiesTest, FramesAgreeWithTheReference) {
  const Body ball = bendingBall(0.1, 0.006), cloth = sheet(0.3, {0, -0.045, 0});
  for (const auto& [body, samples] : {std::pair(ball, 6), {ball, 2}, {ball, 1}, {cloth, 6}, {cloth, 1}}) {
    Case c;
    c.bodies = {body};
    c.samples = samples;
    Simulation hair = c.make(device());
    reference::Simulation<double> exact(c.groom, {}, c.settings, headAt(0), headAt(0), {}, c.bodies);
    reference::Simulation<float> rounded(c.groom, {}, c.settings, headAt(0), headAt(0), {}, c.bodies);
    std::size_t differ = 0, byRounding = 0;
    for (int frame = 0; frame < 6; ++frame) {
      const HairState state = *hair.state();
      exact.setState(fieldOf<double>(state.positions), fieldOf<double>(state.velocities));
      rounded.setState(fieldOf<float>(state.positions), fieldOf<float>(state.velocities));
      c.step(hair, frame);
      const Frame now = frameOf(c.bodies, c.settings, frame, samples);
      exact.stepFrame(now.heads, now.bodies, {}, now.spans());
      rounded.stepFrame(now.heads, now.bodies, {}, now.spans());
      differ += differing(c.groom, fieldOf<float>(*hair.positions()), exact.positions());
      byRounding += differing(c.groom, rounded.positions(), exact.positions());
    }
    fmt::print("{}, {} samples: {} of 240 strands differ in a frame, of the reference in float {}\n",
               body.name, samples, differ, byRounding);
    EXPECT_LE(differ, byRounding + 12);
    EXPECT_LE(byRounding, 72u);
  }
}

// At speeds at which a step is far longer than a cell: outside stays outside, of the triangles themselves.
TEST_F(BendingBodiesTest, OutsideStaysOutside) {
  for (const double speed : {1.0, 5.0, 20.0}) {
    Case c;
    c.settings.stepsPerFrame = 8;
    c.samples = 8;
    c.settings.gravity = {};
    // Strands beside the ball, thrown at it.
    constexpr std::size_t kParticles = 20;
    c.groom = Groom{};
    c.groom.metresPerUnit = 1;
    std::mt19937 random(7);
    std::normal_distribution<double> any;
    const auto direction = [&] {
      return normalizedOr(Vec3d{any(random), any(random), any(random)}, Vec3d{0, 1, 0});
    };
    std::vector<Vec3d> inward;
    for (int s = 0; s < 200; ++s) {
      const Vec3d out = direction(), along = normalizedOr(cross(out, direction()), Vec3d{1, 0, 0});
      std::vector<Vec3f> strand;
      for (std::size_t i = 0; i < kParticles; ++i)
        strand.push_back(Vec3f(out * 0.2 + along * (0.008 * (double(i) - 3))));
      c.groom.addStrand(strand);
      inward.push_back(out * -speed);
    }
    Simulation hair = c.make(device());
    HairState state = *hair.state();
    for (std::size_t s = 0; s < inward.size(); ++s)
      for (std::size_t i = 2; i < kParticles; ++i) state.velocities[kParticles * s + i] = Vec3f(inward[s]);
    ASSERT_TRUE(hair.setState(state));
    double deepest = 0;
    std::size_t deeper = 0;
    for (int frame = 0; frame < 2; ++frame) {
      c.step(hair, frame);
      const double t = (frame + 1) * 8 * c.settings.stepSeconds();
      const BendingMesh& mesh = *c.bodies[0].mesh;
      const TriangleMesh surface{mesh.surface.pointsOf(bentPoints(mesh, t)), mesh.surface.triangles};
      const auto positions = *hair.positions();
      for (const Vec3f& p : positions) {
        const Vec3d place = rotate(headAt(t).rotation.conjugate(), Vec3d(p));
        if (bruteWinding(surface, place) < 0.5) continue;
        const double depth = bruteDistance(surface, place);
        deepest = std::max(deepest, depth);
        deeper += depth > 0.002;
      }
    }
    fmt::print("{} m/s: at most {:.2f} mm deep, {} deeper than 2 mm\n", speed, deepest * 1000, deeper);
    EXPECT_EQ(deeper, 0u);
  }
}

// How far a place is above the triangle over or under it, along Y; none: not a number.
double heightAbove(const TriangleMesh& surface, Vec3d y) {
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3d a = surface.points[i], ab = surface.points[j] - a, ac = surface.points[k] - a, way = y - a;
    const double area = ab.x * ac.z - ac.x * ab.z;
    const double v = (way.x * ac.z - ac.x * way.z) / area, w = (ab.x * way.z - way.x * ab.z) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return way.y - v * ab.y - w * ac.y;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Strands on both sides of a sheet, thrown at it.
struct Thrown {
  static constexpr std::size_t kParticles = 20;
  Case c;
  std::vector<Vec3d> velocities;  // [m/s]

  static double sideOf(std::size_t strand) { return strand % 2 ? 1 : -1; }
  explicit Thrown(double speed) {
    c.bodies = {sheet(0.6)};
    c.settings.stepsPerFrame = c.samples = 8;
    c.settings.gravity = {};
    c.groom = Groom{};
    c.groom.metresPerUnit = 1;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    for (std::size_t s = 0; s < 100; ++s) {
      const double side = sideOf(s), turn = std::numbers::pi * any(random);
      const Vec3d first{0.05 * any(random), 0.04 * side, 0.05 * any(random)};
      const Vec3d along{0.008 * std::cos(turn), 0, 0.008 * std::sin(turn)};
      std::vector<Vec3f> strand;
      for (std::size_t i = 0; i < kParticles; ++i) strand.push_back(Vec3f(first + along * double(i)));
      c.groom.addStrand(strand);
      velocities.push_back(Vec3d{any(random), -side * (0.5 + std::abs(any(random))), any(random)} * speed);
    }
  }
  // How many particles are on the other side at the ends of two frames; roots go where the head has them.
  std::size_t crossing(const ComputeDevice& device, const std::vector<Body>& bodies) const {
    Case flight = c;
    flight.bodies = bodies;
    Simulation hair = flight.make(device);
    HairState state = *hair.state();
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
      if (i % kParticles >= 2) state.velocities[i] = Vec3f(velocities[i / kParticles]);
    EXPECT_TRUE(hair.setState(state));
    std::size_t count = 0;
    for (int frame = 0; frame < 2; ++frame) {
      flight.step(hair, frame);
      const double t = (frame + 1) * 8 * c.settings.stepSeconds();
      const BendingMesh& mesh = *c.bodies[0].mesh;
      const TriangleMesh surface{mesh.surface.pointsOf(bentPoints(mesh, t)), mesh.surface.triangles};
      const auto positions = *hair.positions();
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3d place = rotate(headAt(t).rotation.conjugate(), Vec3d(positions[i]));
        if (i % kParticles >= 2) count += heightAbove(surface, place) * sideOf(i / kParticles) < 0;
      }
    }
    return count;
  }
};

// Each particle stays on its side, in strands of all forms of kernels.
TEST_F(BendingBodiesTest, HairStaysOnItsSideOfCloth) {
  using Form = KernelChoice::Form;
  for (const double speed : {1.0, 5.0, 20.0}) {
    const std::size_t would = Thrown(speed).crossing(device(), {bendingBall(0.01, 0.002, {0, 5, 0})});
    EXPECT_GT(would, 500u) << speed;
    for (const Form form : {Form::lanes, Form::memory, Form::serial}) {
      Thrown thrown(speed);
      thrown.c.kernel.form = form;
      const std::size_t crossed = thrown.crossing(device(), thrown.c.bodies);
      fmt::print("form {}, {} m/s: {} particles cross, without the cloth {}\n", int(form), speed, crossed,
                 would);
      EXPECT_EQ(crossed, 0u);
    }
  }
}

TEST_F(BendingBodiesTest, CheckpointsAndFramesInFlightHaveTheSameBits) {
  const Case c;
  Simulation whole = c.make(device()), flown = c.make(device());
  std::optional<std::vector<std::byte>> checkpoint;
  std::vector<std::vector<Vec3f>> frames;
  for (int frame = 0; frame < 6; ++frame) {
    c.step(whole, frame);
    frames.push_back(*whole.positions());
    if (frame == 2) checkpoint = *whole.checkpoint();
  }
  Simulation resumed = c.make(device());
  ASSERT_TRUE(resumed.restore(*checkpoint));
  for (int frame = 3; frame < 6; ++frame) {
    c.step(resumed, frame);
    EXPECT_EQ(*resumed.positions(), frames[static_cast<std::size_t>(frame)]) << frame;
  }
  for (int frame = 0; frame <= 6; ++frame) {
    if (frame < 6) {
      const Frame now = frameOf(c.bodies, c.settings, frame, c.samples);
      ASSERT_TRUE(flown.submitFrame(now.heads, now.bodies, {}, now.spans()));
    }
    if (frame == 0) continue;
    ASSERT_TRUE(flown.waitFrame());
    EXPECT_EQ(flown.framePositions(), frames[static_cast<std::size_t>(frame - 1)]) << frame;
  }
}

// A body that the head carries stands in its frame whether its poses are given or not.
TEST_F(BendingBodiesTest, TheHeadCarriesWhatHasNoPoses) {
  const Case c;
  Simulation told = c.make(device()), untold = c.make(device());
  for (int frame = 0; frame < 3; ++frame) {
    const Frame now = frameOf(c.bodies, c.settings, frame, c.samples);
    ASSERT_TRUE(told.stepFrame(now.heads, now.bodies, {}, now.spans()));
    ASSERT_TRUE(untold.stepFrame(now.heads, {}, {}, now.spans()));
    EXPECT_EQ(*told.positions(), *untold.positions()) << frame;
  }
}

// A body that stands still for some frames, and one that no longer bends: hair meets what is there.
TEST_F(BendingBodiesTest, FramesWithoutPointsKeepTheShape) {
  const Case c;
  Simulation told = c.make(device()), untold = c.make(device());
  for (int frame = 0; frame < 5; ++frame) {
    const bool moves = frame == 1 || frame == 3;
    Frame now = frameOf(c.bodies, c.settings, frame, c.samples);
    // The points of the last time that it moved, on the bodies' present poses.
    if (!moves) {
      const double since = frame == 0 ? 0 : (frame == 2 ? 2 : 4) * 6 * c.settings.stepSeconds();
      const std::vector<double> times(6, since);
      now.points = bentInWorld(c.bodies, now.bodies, times);
    }
    ASSERT_TRUE(told.stepFrame(now.heads, now.bodies, {}, now.spans()));
    ASSERT_TRUE(untold.stepFrame(now.heads, now.bodies, {}, moves ? now.spans() : decltype(now.spans()){}));
    const auto a = *told.positions(), b = *untold.positions();
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, double(length(a[i] - b[i])));
    EXPECT_LE(worst, 1e-5) << frame;  // points that are turned there and back round
  }
}

}  // namespace
}  // namespace ringlet::test::bending_bodies_test
