// Profiles along the strand, by formula.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parity/parity.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::profile_test {
namespace {

using Profiles = GpuTest;

// A straight strand that hangs down.
Groom hanging(int particles, float edge) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int i = 0; i < particles; ++i) groom.points.push_back({0, -edge * static_cast<float>(i), 0});
  groom.firstPoint = {0, static_cast<std::uint32_t>(particles)};
  return groom;
}

std::vector<Vec3f> restAfter(const ComputeDevice& device, const Groom& groom, const Material& material,
                             Settings settings, int frames) {
  settings.maxStretch = 3;
  auto hair = Simulation::create(device, groom, material, settings);
  EXPECT_TRUE(hair) << hair.error().message;
  const std::vector<HeadPose> still(static_cast<std::size_t>(settings.stepsPerFrame));
  for (int frame = 0; frame < frames; ++frame) EXPECT_TRUE(hair->stepFrame(still));
  return *hair->positions();
}

// An edge of stiffness K_s f(s) / l lengthens by the weight W below it: by l W f^-1 / K_s. The core, which
// would hold it too, has next to no stiffness.
TEST_F(Profiles, OfStretchGiveWhatHangs) {
  const int n = 21;
  const float edge = 0.01f;
  const Groom groom = hanging(n, edge);
  Settings settings;
  settings.gravityPreload = 0;
  Material material;
  material.stretchStiffness = 20;
  material.stretchDampingTime = 0.05;
  material.coreStiffness = 0.001;
  material.bendSmoothingLength = material.coreSmoothingLength = 0.02;
  material.bendStiffness = 0.01;  // across only
  material.stretchStiffnessProfile.points = {{0, 4}, {1, 0.25}};
  material.lineDensityProfile.points = {{0, 1}, {1, 3}};
  const auto points = restAfter(device(), groom, material, settings, 240);
  const auto density = [](double s) { return 1 + 2 * s; };
  for (int i = 0; i + 1 < n; ++i) {
    double below = 0;  // as a share of the strand's weight by lambda
    for (int p = i + 1; p < n; ++p) {
      if (p > 0) below += density((p - 0.5) / (n - 1)) / (2.0 * (n - 1));
      if (p + 1 < n) below += density((p + 0.5) / (n - 1)) / (2.0 * (n - 1));
    }
    const double s = (i + 0.5) / (n - 1);
    const double longer = edge * below * 9.81 / 9.80665 / (20 * (4 - 3.75 * s));
    const double found = length(points[i + 1] - points[i]) - edge;
    EXPECT_NEAR(found, longer, 0.01 * longer + 2e-6) << i;
  }
}

// By themselves, each as the reference has it, and other than without.
TEST_F(Profiles, EachActs) {
  parity::ParityCase plain{parity::randomGroom({31, 64, 17}, 5), {}, {}, {}};
  const auto moved = [&](const Material& material) {
    auto hair = Simulation::create(device(), plain.groom, material, plain.settings);
    EXPECT_TRUE(hair) << hair.error().message;
    for (int frame = 1; frame <= 3; ++frame)
      EXPECT_TRUE(
          hair->stepFrame({{0.01 * frame * frame, 0, 0}, fromRotationVector(Vec3d{0, 0.2 * frame, 0})}));
    return *hair->positions();
  };
  const auto without = moved({});
  for (const ProfileParameter& profile : profileParameters()) {
    SCOPED_TRACE(profile.key);
    parity::ParityCase c = plain;
    (c.material.*profile.member).points = {{0, 0.5}, {1, 2}};
    for (const parity::FieldError& e : parity::oneStepErrors(device(), c))
      EXPECT_LE(e.error, kOneStep) << e.field << "\n" << e.where;
    EXPECT_NE(moved(c.material), without);
  }
}

}  // namespace
}  // namespace ringlet::test::profile_test
