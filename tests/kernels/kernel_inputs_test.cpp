// Every input of every kernel that steps hair is set by a case of parity/input_cases.h, and each of those
// cases is the reference's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "embedded_modules.h"
#include "parity/input_cases.h"
#include "tests/support/gpu_test.h"
#include "tests/support/kernel_inputs.h"

namespace ringlet::test::kernel_inputs_test {
namespace {

const InputException kExceptions[] = {
    {"ContactNumbers.warmth", "a constant"},
    {"ContactNumbers.seenAhead", "a constant"},
    {"ContactParameters.whose", "divided hair has the bits of the whole: kernels/DividedHair"},
    {"contact_gather/ContactNumbers.reachFactor", "1 where contacts fade"},
    {"contact_life/ContactNumbers.reachFactor", "1 where contacts fade"},
    {"contact_system/ContactNumbers.reachFactor", "a constant where contacts do not fade"},
    {"contact_system/ContactNumbers.breakFactor", "a constant where contacts do not fade"},
    {"contact_system/ContactNumbers.liveBlockCount", "none where contacts do not fade"},
    {"contact_system/ContactNumbers.mostLiveBlocks", "none where contacts do not fade"},
    {"StepParameters.headCount", "many at once have the bits of each alone: kernels/HairFrames"},
    {"StepParameters.headPoses", "a constant"},
    {"VolumeNumbers.gradient", "a constant"},
    {"VolumeNumbers.rim", "a constant"},
    {"VolumeParticle.unused", "unused"},
    {"BodyRest.lists[1]", "kernels write it into their own copies"},
    {"RootPose.position[3]", "unused"},
    {"RootPose.velocity[3]", "unused"},
    {"Sampled", "of hair that is divided: kernels/DividedHair"},
    {"StepAir.wind[3]", "unused"},
    {"WindWave.wave[3]", "unused"},
    {"WindWave.amplitude[3]", "unused"},
    {"FieldNodes[3]", "unused"},
};

class KernelInputsTest : public GpuTest {
 protected:
  // Runs cases on a device of its own, and notes what they set.
  void run(const std::vector<parity::InputCase>& cases, const gpu::DeviceOptions& options,
           KernelInputs& inputs) {
    const auto opened = gpu::Device::open("", options);
    ASSERT_TRUE(opened) << opened.error().message;
    {
      KernelSpy spy(**opened);
      const ComputeDevice device = ComputeDevice::over(*opened);
      for (const parity::InputCase& c : cases) {
        SCOPED_TRACE(c.name);
        spy.onDone = [&](const SpiedCommands& commands) { inputs.look(spy, commands, c.name); };
        const parity::FieldError e = c.error(device);
        fmt::print("{:<45} {:.1e} of {:.1e}, {}\n", c.name, e.error, c.tolerance, e.field);
        EXPECT_LE(e.error, c.tolerance) << e.field << "\n" << e.where;
      }
    }
    expectNoMessages(*(*opened)->validationLog());
  }
};

TEST_F(KernelInputsTest, EachIsSetBySomeCase) {
  if (gpu().properties().type != "cpu") GTEST_SKIP() << "the host does not see this device's buffers";
  KernelInputs inputs(kEmbeddedModules, kStepInputs);
  run(parity::inputCases(), {}, inputs);
  run(parity::readbackCases(), {.asGpu = true}, inputs);
  inputs.expectAllSet(kExceptions);
}

TEST(KernelFamilies, BeginKernels) {
  for (const KernelFamily& family : kKernelFamilies) {
    EXPECT_TRUE(std::ranges::any_of(kernelStems(), [&](const std::string& stem) {
      return stem.starts_with(family.begin);
    })) << family.begin;
  }
}

}  // namespace
}  // namespace ringlet::test::kernel_inputs_test
