// Presets on the hanging curl (radius 1 cm, 8 turns, 25 cm), in the double reference: how fast
// they bounce, and that a shake leaves them whole.
#include "ringlet/rest/material_presets.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/rest_state.h"
#include "tests/equations/strand_fixtures.h"

namespace ringlet::material_presets_test {
namespace {

using reference::test::groomOf;
using reference::test::Helix;
using reference::test::kPi;
using Hair = reference::Simulation<double>;

// Let go without preload, the tip swings about where it will hang.
struct Bounce {
  double droop = 0;      // [mm]
  double frequency = 0;  // by the times at which the tip passes where it ends [Hz]
  int passes = 0;        // how many of them that is taken from
};

Bounce release(const Material& material, int stepsPerFrame) {
  Settings settings;
  settings.gravityPreload = 0;
  settings.stepsPerFrame = stepsPerFrame;
  Hair hair(groomOf(Helix{}.points()), material, settings);
  const double T = settings.stepSeconds(), start = hair.positions().back().y();
  std::vector<double> heights;
  const HeadPose still;
  for (int n = 0; n * T < 8; ++n) {
    hair.stepFrame(std::span(&still, 1));
    heights.push_back(hair.positions().back().y() - start);
  }

  // Two whole swings at most: the later ones are small beside the slower ones of other modes.
  std::vector<double> passes;
  for (std::size_t n = 1; n < heights.size() && passes.size() < 5; ++n) {
    const double before = heights[n - 1] - heights.back(), after = heights[n] - heights.back();
    if (before * after < 0) passes.push_back((static_cast<double>(n) + before / (before - after)) * T);
  }
  Bounce bounce{-1000 * heights.back(), 0, static_cast<int>(passes.size())};
  if (passes.size() > 1) bounce.frequency = (bounce.passes - 1) / (2 * (passes.back() - passes.front()));
  return bounce;
}

TEST(Presets, HaveNamesWordsAndNumbersInRange) {
  EXPECT_EQ(presetNames(), (std::vector<std::string>{"straight", "wavy", "loose_curl", "ringlet", "coil"}));
  for (const std::string& name : presetNames()) {
    const auto material = materialPreset(name);
    ASSERT_TRUE(material) << name;
    EXPECT_TRUE(checkSettings({}, *material)) << name;
    EXPECT_TRUE(unusualNumbers(*material, {}).empty()) << name;
    EXPECT_GT(presetSummary(name).size(), 30u) << name;
    EXPECT_FALSE(material->bendSmoothingLength || material->coreSmoothingLength)
        << name << ": lengths come from the rest curl";
  }
  for (const char* name : {"", "curly", "Ringlet", "ringlet "}) {
    EXPECT_FALSE(materialPreset(name)) << name;
    EXPECT_EQ(presetSummary(name), "") << name;
  }
}

// A slinky whose own weight lengthens it by d has its lowest frequency at sqrt(g / 2d) / 4: half its weight
// hangs on the mean turn. The core spring stiffens with length, so the bounce is somewhat faster than that.
TEST(Presets, BounceAtTheirFrequency) {
  std::printf("%-12s %10s %14s %12s %12s\n", "preset", "droop [mm]", "slinky [Hz]", "8 steps [Hz]",
              "32 steps [Hz]");
  for (const std::string& name : presetNames()) {
    const Material material = materialPreset(name).value();
    const Bounce coarse = release(material, 8), fine = release(material, 32);
    const double slinky = std::sqrt(kStandardGravity / (2 * fine.droop / 1000)) / 4;
    std::printf("%-12s %10.2f %14.2f %12.2f %12.2f\n", name.c_str(), fine.droop, slinky, coarse.frequency,
                fine.frequency);
    ASSERT_GE(fine.passes, 3) << name << " does not bounce";
    EXPECT_NEAR(fine.frequency / slinky, 1, 0.25) << name;
    EXPECT_NEAR(coarse.frequency / fine.frequency, 1, 0.05) << name;
    if (name == "ringlet") {
      for (const double frequency : {slinky, coarse.frequency, fine.frequency}) {
        EXPECT_GT(frequency, 2);
        EXPECT_LT(frequency, 5);
      }
    }
  }
}

TEST(Presets, AShakeLeavesThemWhole) {
  for (const std::string& name : presetNames()) {
    const Settings settings;
    Hair hair(groomOf(Helix{}.points()), materialPreset(name).value(), settings);
    reference::test::simulate(hair, 2, [](double t) {
      HeadPose pose;
      pose.position.x = 0.1 * std::sin(2 * kPi * 2 * t);
      return pose;
    });
    const auto report = hair.report();
    std::printf("%-12s shaken for 2 s: longest edge %.4f, limited %.5f of edges\n", name.c_str(),
                report.maxEdgeStretch, report.limitedShare());
    EXPECT_EQ(report.nonfinite, 0u) << name;
    EXPECT_LE(report.maxEdgeStretch, settings.maxStretch * (1 + 1e-4)) << name;
    EXPECT_LT(report.limitedShare(), 0.01) << name;
    EXPECT_FALSE(hair.restStrands()[0].coreIsCapped) << name;
  }
}

// The rules for a calm step: T sqrt(K / lambda) / alpha <= 3, for bending and for the core, at 4 steps per 24
// Hz frame and 2 to 24 turns on 25 cm.
TEST(Presets, NeedNoMoreThanFourStepsPerFrame) {
  for (const std::string& name : presetNames()) {
    const Material material = materialPreset(name).value();
    for (const double turns : {2.0, 4.0, 8.0, 16.0, 24.0}) {
      Settings settings;
      settings.stepsPerFrame = 4;
      const auto points = Helix{.turns = turns, .particleCount = 128}.points();
      const auto rest = reference::test::restOf(points, settings, material);
      const double speed = std::sqrt(material.bendStiffness * kStandardGravity * rest.arcLength);
      EXPECT_LE(settings.stepSeconds() * speed / rest.bendSmoothingLength, 3) << name << " " << turns;
      EXPECT_FALSE(rest.coreIsCapped) << name << " " << turns;
    }
  }
}

}  // namespace
}  // namespace ringlet::material_presets_test
