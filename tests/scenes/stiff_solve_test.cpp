// The strand solve in float32 against double where it is hardest: stretch up to 10,000 times the strand's
// weight, straight and curly, 8 to 256 particles, 100 shaken steps. A solve that loses the mass to
// cancellation fails this by decades.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reference/step.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::stiff_solve_test {
namespace {

class StiffSolve : public GpuTest {
 protected:
  // Largest distance [m] from the double reference after 100 steps of a 10 cm, 2 Hz shake.
  double distanceAfterShake(const Groom& groom, double stretchStiffness, KernelChoice kernel) {
    Settings settings;
    settings.stepsPerFrame = 10;
    settings.framesPerSecond = 19.2;  // 192 steps a second
    Material material;
    material.stretchStiffness = stretchStiffness;
    const Motion motion = *motionByName("shake", {0, 1, 0});
    auto simulation = Simulation::create(device(), groom, material, settings, {}, kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    reference::Simulation<double> expected(groom, material, settings);
    for (int frame = 0; frame < 10; ++frame) {
      std::vector<HeadPose> poses;
      for (int k = 1; k <= 10; ++k) poses.push_back(motion.poseAt((frame * 10 + k) * settings.stepSeconds()));
      EXPECT_TRUE(simulation->stepFrame(poses));
      expected.stepFrame(poses);
    }
    const auto found = *simulation->positions();
    double largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      largest = std::max(largest, (reference::toEigen<double>(found[i]) - expected.positions()[i]).norm());
    }
    return largest;
  }
};

TEST_F(StiffSolve, StaysWithDoubleUpToTenThousandWeights) {
  const struct {
    const char* name;
    KernelChoice kernel;
  } forms[] = {{"automatic", {}},
               {"8 a lane", {KernelChoice::Form::automatic, 8}},
               {"serial", {KernelChoice::Form::serial}}};
  for (double stiffness : {10.0, 100.0, 1000.0, 10000.0}) {
    for (const auto& form : forms) {
      for (double radius : {0.0, 0.01}) {
        std::string line;
        for (int n : {8, 16, 32, 64, 128, 256}) {
          Groom groom;
          groom.metresPerUnit = 1;
          groom.addStrand(helix(n, radius, 0.25, std::min(8.0, n / 4.0), 0, 1));
          const double distance = distanceAfterShake(groom, stiffness, form.kernel);
          line += fmt::format(" {}: {:.1e}", n, distance);
          EXPECT_LE(distance, kStiffSolveMetres)
              << "K_s " << stiffness << " w, radius " << radius << ", N " << n << ", " << form.name;
        }
        fmt::print("K_s {:>5} w, {:<8} {:<9}, [m] at N{}\n", stiffness, radius > 0 ? "curly" : "straight",
                   form.name, line);
      }
    }
  }
}

}  // namespace
}  // namespace ringlet::test::stiff_solve_test
