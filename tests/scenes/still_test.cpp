// Hair that nothing pulls stays put, and a head at constant velocity carries it rigidly, wherever it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ringlet/groom/groom_file.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::still_test {
namespace {

// Largest distance from the rest pose, as a share of each strand's polyline length.
double largestMove(const Groom& groom, std::span<const Vec3f> positions) {
  double largest = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = groom.strand(s);
    double total = 0;
    for (std::size_t i = 1; i < strand.size(); ++i)
      total += length(static_cast<Vec3d>(strand[i] - strand[i - 1]));
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const Vec3d rest = static_cast<Vec3d>(strand[i]) * groom.metresPerUnit;
      const double distance = length(static_cast<Vec3d>(positions[groom.firstPoint[s] + i]) - rest);
      largest = std::max(largest, distance / (total * groom.metresPerUnit));
      if (!std::isfinite(distance)) return INFINITY;
    }
  }
  return largest;
}

class Still : public GpuTest {
 protected:
  // Largest move over `seconds`, sampled every frame, the head travelling from `start` at `velocity`.
  double moveOver(double seconds, const Groom& groom, const Settings& settings, Vec3d start, Vec3d velocity) {
    const double T = settings.stepSeconds();
    const auto poseAt = [&](int step) { return HeadPose{start + velocity * (step * T), {}}; };
    auto simulation =
        Simulation::create(device(), groom, {}, settings, {.head = poseAt(0), .oneStepEarlier = poseAt(-1)});
    EXPECT_TRUE(simulation) << simulation.error().message;
    double largest = 0;
    for (int frame = 0; frame < seconds * settings.framesPerSecond; ++frame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= settings.stepsPerFrame; ++k)
        poses.push_back(poseAt(frame * settings.stepsPerFrame + k));
      EXPECT_TRUE(simulation->stepFrame(poses));
      largest = std::max(largest, largestMove(groom, *simulation->positions()));
    }
    return largest;
  }
};

Groom mixedGroom() { return randomGroom({2, 3, 16, 31, 64, 64, 100, 128, 129, 300}, 3); }

TEST_F(Still, RestPoseWithoutGravityStaysPut) {
  Settings settings;
  settings.gravity = {};
  const double moved = moveOver(10, mixedGroom(), settings, {}, {});
  fmt::print("rest pose, 10 s without gravity: moved {:.1e} of the arc length\n", moved);
  EXPECT_LE(moved, kAtRest);
}

TEST_F(Still, RealGroomWithoutGravityStaysPut) {
  RINGLET_NEEDS_DATA(path, "curlycue/frame_000.obj");
  auto loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  Settings settings;
  settings.gravity = {};
  const double moved = moveOver(10, loaded->groom, settings, {}, {});
  fmt::print("curlycue, 10 s without gravity: moved {:.1e} of the arc length\n", moved);
  EXPECT_LE(moved, kAtRest);
}

TEST_F(Still, GravityPreloadHoldsTheGroom) {
  const double moved = moveOver(10, mixedGroom(), {}, {}, {});
  fmt::print("rest pose, 10 s with gravity and preload 1: moved {:.1e} of the arc length\n", moved);
  EXPECT_LE(moved, 10 * kAtRest);  // float gravity and preload cancel only to their rounding
}

TEST_F(Still, ConstantVelocityStaysRigid) {
  Settings settings;
  settings.gravity = {};
  for (Vec3d start : {Vec3d{}, Vec3d{100, -50, 80}}) {
    const double moved = moveOver(10, mixedGroom(), settings, start, {1.3, 0.4, -2});
    fmt::print("constant velocity from ({}, {}, {}), 10 s: moved {:.1e} of the arc length\n", start.x,
               start.y, start.z, moved);
    EXPECT_LE(moved, kAtRest);
  }
}

}  // namespace
}  // namespace ringlet::test::still_test
