// Simulations on one device share its kernels: only the first of equal ones has anything compiled.
#include <gtest/gtest.h>

#include <vector>

#include "ringlet/gpu/kernel_cache.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::shared_kernels_test {
namespace {

struct Announced : CompileObserver {
  void begin(std::size_t kernelCount) override { counts.push_back(kernelCount); }
  void end() override { ++ends; }
  std::vector<std::size_t> counts;
  std::size_t ends = 0;
};

using SharedKernels = GpuTest;

TEST_F(SharedKernels, FourEqualSimulationsCompileOnce) {
  for (const bool contacts : {false, true}) {
    SCOPED_TRACE(contacts);
    const auto own = ComputeDevice::open();  // one that has compiled nothing yet
    ASSERT_TRUE(own) << own.error().message;
    Settings settings;
    settings.contacts.on = contacts;
    const Groom groom = randomGroom({8, 8, 8, 8}, 3);
    Announced announced;
    std::vector<Simulation> simulations;
    std::size_t compiled = 0;
    for (int i = 0; i < 4; ++i) {
      auto made = Simulation::create(*own, groom, {}, settings, {}, {.observer = &announced});
      ASSERT_TRUE(made) << made.error().message;
      simulations.push_back(std::move(*made));
      if (i == 0) compiled = own->gpu().kernels().compiledCount();
    }
    const std::size_t readBack = own->gpu().properties().isCpu ? 0 : 1;
    EXPECT_EQ(compiled, (contacts ? 11u : 1u) + readBack) << "one for the strands, ten for contacts";
    EXPECT_EQ(own->gpu().kernels().compiledCount(), compiled);
    EXPECT_EQ(announced.counts, std::vector<std::size_t>{compiled - readBack});
    EXPECT_EQ(announced.ends, 1u);

    // The kernels outlive the simulation that had them compiled, and do the same for the others.
    simulations.erase(simulations.begin());
    HeadPose moved;
    moved.position = {0.01, 0, 0};
    std::vector<std::vector<Vec3f>> ends;
    for (Simulation& simulation : simulations) {
      ASSERT_TRUE(simulation.stepFrame(moved));
      ends.push_back(*simulation.positions());
    }
    EXPECT_EQ(ends[0], ends[1]);
    EXPECT_EQ(ends[0], ends[2]);
    expectNoMessages(*own->gpu().validationLog());
  }
}

}  // namespace
}  // namespace ringlet::test::shared_kernels_test
