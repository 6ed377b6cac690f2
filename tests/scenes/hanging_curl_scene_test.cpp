// hanging_curl: the same curl at every resolution and step, held by its preload and sagging as much without.
// Transients too, where poor solves hide.
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "tests/scenes/scene_runs.h"

namespace ringlet::test::hanging_curl_scene_test {
namespace {

using HangingCurl = SceneTest;

// Largest distance between two paths [m].
double largestDistance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, length(a[k] - b[k]));
  return largest;
}

// Amplitude of a path along X at `frequency`, over its last `frames`, a whole number of periods [m].
double amplitudeAt(double frequency, const std::vector<Vec3d>& path, double framesPerSecond,
                   std::size_t frames) {
  std::complex<double> sum = 0;
  for (std::size_t k = path.size() - frames; k < path.size(); ++k)
    sum += path[k].x * std::polar(1.0, -2 * std::numbers::pi * frequency * double(k) / framesPerSecond);
  return 2 * std::abs(sum) / double(frames);
}

// The head shaken along X, 10 cm, 2 Hz; for ever or until a time.
Motion shake(double untilSeconds) {
  Motion motion = *motionByName("shake", {0, 1, 0});
  motion.untilSeconds = untilSeconds;
  return motion;
}

TEST_F(HangingCurl, PreloadHoldsItEverywhere) {
  printHeading("hanging_curl, preload 1, 10 s: largest droop of any frame [mm]");
  for (int steps : kStepCounts) {
    const SceneRun run = this->run(atAllResolutions("hanging_curl", {.preload = 1, .stepsPerFrame = steps}));
    std::vector<double> droops;
    for (const StrandMotion& strand : run.motion.strands) {
      droops.push_back(1000 * strand.worst.droop);
      EXPECT_LE(std::abs(droops.back()), 0.01) << steps << " steps";
    }
    printRow(fmt::format("{} steps", steps), droops, "{:.5f}");
  }
}

TEST_F(HangingCurl, DroopsAlikeAtEveryResolutionAndStep) {
  printHeading("hanging_curl, preload 0, 10 s: droop [mm]");
  std::map<int, std::vector<double>> droops;  // by steps, then resolution
  for (int steps : kStepCounts) {
    const SceneRun run = this->run(atAllResolutions("hanging_curl", {.preload = 0, .stepsPerFrame = steps}));
    for (const StrandMotion& strand : run.motion.strands) droops[steps].push_back(1000 * strand.last.droop);
    printRow(fmt::format("{} steps", steps), droops[steps], "{:.3f}");
    printRow(
        "  bounce [Hz]",
        [&] {
          std::vector<double> all;
          for (const StrandMotion& strand : run.motion.strands) all.push_back(strand.bounceHz.value_or(0));
          return all;
        }(),
        "{:.2f}");
  }
  for (int steps : kStepCounts) {
    const std::vector<double>& d = droops[steps];
    EXPECT_NEAR(d[0] / d[2], 1, 0.15) << "32 against 128 particles at " << steps << " steps";
    const auto [least, most] = std::minmax({d[1], d[2], d[3]});
    EXPECT_LE(most / least, 1.05) << "64 to 256 particles at " << steps << " steps";
  }
  for (std::size_t k = 0; k < kResolutions.size(); ++k) {
    const auto [least, most] = std::minmax({droops[8][k], droops[16][k], droops[32][k]});
    EXPECT_LE(most / least, 1.01) << "8 to 32 steps at " << kResolutions[k] << " particles";
  }
}

// Every step of the first half second after the release, against the exact solve in double. point_jacobi is
// shown beside it: 4 iterations cost what the strand solve costs, 100 are its default.
TEST_F(HangingCurl, FallsAsTheExactSolveDoes) {
  printHeading(
      "hanging_curl, preload 0, first 0.5 s: largest distance of the tip from the exact solve, share of the "
      "droop");
  for (int steps : kStepCounts) {
    SceneOptions options{.preload = 0, .stepsPerFrame = steps, .seconds = 5};
    const auto settled = referenceTips(atAllResolutions("hanging_curl", options));
    options.seconds = 0.5;
    BuiltinScene scene = frameByStep(atAllResolutions("hanging_curl", options));
    const auto expected = referenceTips(scene);
    auto shares = [&](const SceneRun& run) {
      std::vector<double> ofDroop;
      for (std::size_t s = 0; s < expected.size(); ++s) {
        const double droop = expected[s].front().y - settled[s].back().y;
        ofDroop.push_back(largestDistance(run.tips[s], expected[s]) / droop);
      }
      return ofDroop;
    };
    const std::vector<double> exact = shares(run(scene));
    printRow(fmt::format("{} steps, jacobi", steps), exact, "{:.2e}");
    for (double share : exact) EXPECT_LE(share, 0.02) << steps << " steps";
    if (steps != 8 && steps != 32) continue;
    scene.settings.integrator = Integrator::pointJacobi;
    for (int iterations : {4, 100}) {
      scene.settings.pointIterations = iterations;
      printRow(fmt::format("{} steps, point_jacobi {}", steps, iterations), shares(run(scene)), "{:.2e}");
    }
  }
}

TEST_F(HangingCurl, SwingsAsFarAtEveryStep) {
  printHeading("hanging_curl, preload 1, shaken 2 Hz, 10 cm: amplitude of the tip beside the head [mm]");
  std::map<int, std::vector<double>> amplitudes;
  for (int steps : kStepCounts) {
    BuiltinScene scene =
        atAllResolutions("hanging_curl", {.preload = 1, .stepsPerFrame = steps, .seconds = 4});
    scene.motion = shake(INFINITY);
    const SceneRun run = this->run(scene);
    for (const auto& path : run.tips) amplitudes[steps].push_back(1000 * amplitudeAt(2, path, 24, 48));
    printRow(fmt::format("{} steps", steps), amplitudes[steps], "{:.2f}");
  }
  for (std::size_t k = 0; k < kResolutions.size(); ++k) {
    const double exact = amplitudes[32][k];
    EXPECT_NEAR(amplitudes[8][k] / exact, 1, 0.03) << kResolutions[k] << " particles";
    EXPECT_NEAR(amplitudes[4][k] / exact, 1, 0.12) << kResolutions[k] << " particles";
  }
}

// 3 s of shaking, then 20 s of rest.
TEST_F(HangingCurl, ComesBackFromAShake) {
  for (int steps : kStepCounts) {
    std::vector<double> stretch, limited, turns, radius, core;
    for (int particles : kResolutions) {
      BuiltinScene scene = *makeScene(
          "hanging_curl", {.particles = particles, .preload = 1, .stepsPerFrame = steps, .seconds = 23});
      scene.motion = shake(3);
      const SceneRun run = this->run(scene);
      const StrandMeasure rest = StrandRuler::make([&] {
                                   std::vector<Vec3d> points;
                                   for (Vec3f p : scene.groom.strand(0))
                                     points.push_back(Vec3d(p) * scene.groom.metresPerUnit);
                                   return points;
                                 }())
                                     ->rest();
      const StrandMeasure& last = run.motion.strands[0].last;
      stretch.push_back(run.report.maxEdgeStretch);
      limited.push_back(100 * run.report.limitedShare);
      turns.push_back(100 * (last.turns / rest.turns - 1));
      radius.push_back(100 * (last.meanRadius / rest.meanRadius - 1));
      core.push_back(100 * (last.coreElongation - 1));
      EXPECT_LE(stretch.back(), scene.settings.maxStretch * (1 + 1e-4)) << particles << ", " << steps;
      EXPECT_LT(limited.back(), 1) << particles << ", " << steps;
      for (double change : {turns.back(), radius.back(), core.back()})
        EXPECT_LE(std::abs(change), 0.1) << particles << ", " << steps;
    }
    printHeading(fmt::format("hanging_curl, preload 1, 3 s of shaking and 20 s of rest, {} steps", steps));
    printRow("longest edge [x]", stretch, "{:.4f}");
    printRow("touched by the limit [%]", limited, "{:.3f}");
    printRow("change of turns [%]", turns, "{:.5f}");
    printRow("change of radius [%]", radius, "{:.5f}");
    printRow("change of core length [%]", core, "{:.5f}");
  }
}

}  // namespace
}  // namespace ringlet::test::hanging_curl_scene_test
