// Nothing feeds on itself: curls of 2 to 24 turns and 16 to 256 particles, every preset and a soft curl, 4 to
// 32 steps a frame, with and without preload, are pushed at 1 m/s; after 20 s their kinetic energy must be
// gone. Several hundred strands; those of one preset, step and preload are one groom. Real curls vary, so
// curls that change hand, tightness or radius along the strand, or are straight at one end, are pushed too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ringlet/rest/material_presets.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"
#include "tests/support/varying_curls.h"

namespace ringlet::test::calm_sweep_test {
namespace {

constexpr int kSeconds = 20, kFramesPerSecond = 24;
constexpr int kGrooms = 100;  // about as many share their kernels, so it pays to compile the fastest

struct Curl {
  int turns, particles;
};

// At least four particles a turn.
std::vector<Curl> curls() {
  std::vector<Curl> all;
  for (int turns : {2, 4, 8, 16, 24}) {
    for (int particles : {16, 32, 64, 128, 256}) {
      if (particles >= 4 * turns) all.push_back({turns, particles});
    }
  }
  return all;
}

Groom groomOf(const std::vector<Curl>& curls) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (const Curl& curl : curls) groom.addStrand(helix(curl.particles, 0.01, 0.25, curl.turns, 0, 1));
  return groom;
}

class CalmSweep : public GpuTest {
 protected:
  // Mean kinetic energy of the last second over the greatest, for each strand. Masses are alike along a
  // strand.
  std::vector<double> energyRatios(const Groom& groom, const Material& material, int stepsPerFrame,
                                   double preload) {
    Settings settings;
    settings.stepsPerFrame = stepsPerFrame;
    settings.gravityPreload = preload;
    auto simulation = Simulation::create(device(), groom, material, settings, {}, {.heads = kGrooms});
    EXPECT_TRUE(simulation) << simulation.error().message;
    HairState state = *simulation->state();
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      for (std::uint32_t i = groom.firstPoint[s] + 1; i < groom.firstPoint[s + 1]; ++i) {
        state.velocities[i] = {0.8f, 0, 0.6f};
      }
    }
    EXPECT_TRUE(simulation->setState(state));
    std::vector<double> peak(groom.strandCount(), 0), last(groom.strandCount(), 0);
    for (int frame = 0; frame < kSeconds * kFramesPerSecond; ++frame) {
      EXPECT_TRUE(simulation->stepFrame(HeadPose{}));
      const bool early = frame < kFramesPerSecond, late = frame >= (kSeconds - 1) * kFramesPerSecond;
      if (!early && !late) continue;
      const HairState now = *simulation->state();
      for (std::size_t s = 0; s < groom.strandCount(); ++s) {
        double energy = 0;
        for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
          energy += static_cast<double>(dot(now.velocities[i], now.velocities[i]));
        }
        peak[s] = std::max(peak[s], energy);
        if (late) last[s] += energy / kFramesPerSecond;
      }
    }
    for (std::size_t s = 0; s < peak.size(); ++s) last[s] /= peak[s];
    return last;
  }
};

TEST_F(CalmSweep, APushedCurlComesToRest) {
  std::vector<std::pair<std::string, Material>> materials;
  for (const std::string& name : presetNames()) materials.push_back({name, *materialPreset(name)});
  materials.push_back({"default", Material{}});
  materials.push_back({"soft", Material{.bendStiffness = 0.5}});
  materials.push_back(
      {"soft, core 1", Material{.bendStiffness = 0.5, .coreRelaxedShare = 1}});  // as head_shake's
  const auto all = curls();
  int runs = 0;
  fmt::print("largest energy ratio after {} s over {} curls of 2 to 24 turns, 16 to 256 particles\n",
             kSeconds, all.size());
  fmt::print("{:<12} {:>8} {:>10} {:>10} {:>10} {:>10}\n", "material", "preload", "4 steps", "8", "16", "32");
  for (const auto& [name, material] : materials) {
    for (double preload : {0.0, 1.0}) {
      std::string row = fmt::format("{:<12} {:>8}", name, preload);
      for (int steps : {4, 8, 16, 32}) {
        const auto ratios = energyRatios(groomOf(all), material, steps, preload);
        double worst = 0;
        for (std::size_t s = 0; s < ratios.size(); ++s) {
          worst = std::max(worst, std::isfinite(ratios[s]) ? ratios[s] : INFINITY);
          EXPECT_LE(ratios[s], kCalmEnergyRatio)
              << name << ", preload " << preload << ", " << steps << " steps, " << all[s].turns << " turns, "
              << all[s].particles << " particles";
        }
        row += fmt::format(" {:>10.1e}", worst);
        runs += static_cast<int>(ratios.size());
      }
      fmt::print("{}\n", row);
    }
  }
  fmt::print("{} runs\n", runs);
}

TEST_F(CalmSweep, APushedCurlThatVariesComesToRest) {
  const std::vector<VaryingCurl>& curls = varyingCurls();
  const std::pair<const char*, Material> materials[] = {
      {"default", Material{}}, {"coil", *materialPreset("coil")}, {"soft", Material{.bendStiffness = 0.5}}};
  std::vector<double> worst(curls.size(), 0);
  int runs = 0;
  for (const auto& [name, material] : materials) {
    for (int particles : {64, 128}) {
      for (double preload : {0.0, 1.0}) {
        for (int steps : {4, 32}) {
          const auto ratios = energyRatios(varyingGroom(particles), material, steps, preload);
          for (std::size_t s = 0; s < ratios.size(); ++s, ++runs) {
            worst[s] = std::max(worst[s], std::isfinite(ratios[s]) ? ratios[s] : INFINITY);
            EXPECT_LE(ratios[s], kCalmEnergyRatio)
                << curls[s].name << ", " << name << ", " << particles << " particles, preload " << preload
                << ", " << steps << " steps";
          }
        }
      }
    }
  }
  fmt::print("largest energy ratio after {} s of {} runs\n", kSeconds, runs);
  for (std::size_t s = 0; s < curls.size(); ++s) fmt::print("{:<20} {:.1e}\n", curls[s].name, worst[s]);
}

}  // namespace
}  // namespace ringlet::test::calm_sweep_test
