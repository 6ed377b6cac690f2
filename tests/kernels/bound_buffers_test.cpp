// How many storage buffers kernels bind: hair alone runs on a device with 8, and what needs more is refused
// with the numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "layout/bodies.h"
#include "layout/strands.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/contacts/contact_kernels.h"
#include "ringlet/solver/contacts/volume_kernels.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strands/strand_kernels.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::bound_buffers_test {
namespace {

constexpr std::uint32_t kFew = 8;  // a Raspberry Pi's

std::uint32_t storageCount(const gpu::KernelDescription& description) {
  const auto bindings = gpu::bindingsOf(description.spirv);
  return static_cast<std::uint32_t>(
      std::ranges::count(bindings, gpu::BindingKind::storage, &gpu::KernelBinding::kind));
}

std::uint32_t mostOfContacts() {
  std::uint32_t most = 0;
  for (std::size_t k = 0; k < contactKernelCount(ContactTaper::distance); ++k) {
    const auto which = static_cast<ContactKernel>(k);
    most = std::max(most, storageCount(describeContactKernel(which, {.inGroups = true, .texels = true})));
  }
  for (std::size_t k = 0; k < kVolumeKernelCount; ++k)
    most = std::max(most, storageCount(describeVolumeKernel(static_cast<VolumeKernel>(k), true, false)));
  return most;
}

const std::vector<StrandShape> kForms{{4, 4}, {4, 4, true}, {1, 16, true}};  // lanes, memory, serial

// What a device is asked for is what hair alone needs, in any form.
TEST(BoundBuffers, HairAloneNeedsWhatDevicesAreAskedFor) {
  std::uint32_t most = 0;
  for (const StrandShape& form : kForms) most = std::max(most, storageCount(describeStrandKernel(form, {})));
  EXPECT_EQ(most, gpu::kNeededStorageBuffers);
  EXPECT_LE(most, kFew);
}

// No kernel binds buffers of what it does not know.
TEST(BoundBuffers, KernelsBindNothingOfWhatTheyLack) {
  for (const StrandShape& form : kForms) {
    for (const bool taps : {false, true}) {
      SCOPED_TRACE(form.describe() + (taps ? ", taps" : ""));
      const auto numbersOf = [&](StrandKernelOptions options) {
        options.taps = taps;
        std::vector<std::uint32_t> numbers;
        for (const auto& [number, kind] : gpu::bindingsOf(describeStrandKernel(form, options).spirv))
          numbers.push_back(number);
        return numbers;
      };
      const auto bindsAny = [](const std::vector<std::uint32_t>& numbers,
                               std::initializer_list<std::uint32_t> wanted) {
        return std::ranges::find_first_of(numbers, wanted) != numbers.end();
      };
      const std::initializer_list<std::uint32_t> contacts{
          layout::kBindContactSystems, layout::kBindContactControl, layout::kBindContactSystemTexels,
          layout::kBindAddedByVolume, layout::kBindAddedByVolumeTexels};
      const std::initializer_list<std::uint32_t> world{
          layout::kBindBodies,        layout::kBindBodyPoses,      layout::kBindGridPairs,
          layout::kBindAir,           layout::kBindWindModes,      layout::kBindBodyTexels,
          layout::kBindAirTexels,     layout::kBindBodyPoseTexels, layout::kBindGridPairTexels,
          layout::kBindWindModeTexels};
      for (const Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
        const auto alone = numbersOf({.integrator = integrator});
        EXPECT_FALSE(bindsAny(alone, contacts));
        EXPECT_FALSE(bindsAny(alone, world));
        EXPECT_FALSE(bindsAny(alone, {layout::kBindSolved}));
        EXPECT_EQ(bindsAny(alone, {layout::kBindTaps}), taps);
      }
      EXPECT_TRUE(bindsAny(numbersOf({.contacts = true}), contacts));
      EXPECT_TRUE(bindsAny(numbersOf({.bodies = true}), world));
      EXPECT_TRUE(bindsAny(numbersOf({.air = true}), world));
    }
  }
}

class FewBuffers : public GpuTest {
 protected:
  Result<Simulation> make(const ComputeDevice& device, const Settings& settings,
                          const KernelChoice& kernel = {}, bool bodies = false) {
    return Simulation::create(device, randomGroom({8, 16, 20, 8}, 3), {}, settings,
                              {.bodies = bodies ? sampleBodies() : std::vector<Body>{}}, kernel);
  }
  Result<ComputeDevice> openFew() {
    auto opened = gpu::Device::open("", {.mostStorageBuffers = kFew});
    if (!opened) return opened.error();
    return ComputeDevice::over(*opened);
  }
};

TEST_F(FewBuffers, HairAloneRunsWithTheSameBits) {
  const auto few = openFew();
  ASSERT_TRUE(few) << few.error().message;
  ASSERT_EQ(few->gpu().properties().maxStorageBuffers, kFew);
  HeadPose moved;
  moved.position = {0.01, 0, 0};
  for (const KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
    std::vector<std::vector<Vec3f>> ends;
    for (const ComputeDevice& on : {*few, device()}) {
      auto simulation = make(on, {}, {.form = form});
      ASSERT_TRUE(simulation) << simulation.error().message;
      ASSERT_TRUE(simulation->stepFrame(moved));
      ends.push_back(*simulation->positions());
    }
    EXPECT_EQ(ends[0], ends[1]);
  }
  expectNoMessages(*few->gpu().validationLog());
}

TEST_F(FewBuffers, WhatNeedsMoreIsRefusedWithNumbers) {
  const auto few = openFew();
  ASSERT_TRUE(few) << few.error().message;
  Settings contacts, air;
  contacts.contacts.on = true;
  air.air.on = true;
  const auto expectRefusal = [&](const Result<Simulation>& refused, std::uint32_t needed,
                                 const char* remedy) {
    ASSERT_FALSE(refused);
    expectParts(refused.error().message, {fmt::format("needs {} storage buffers", needed),
                                          fmt::format("the device has {}", kFew), remedy});
  };
  for (const StrandShape& form : kForms) {
    const KernelChoice kernel{.form = form.serial()   ? KernelChoice::Form::serial
                                      : form.inMemory ? KernelChoice::Form::memory
                                                      : KernelChoice::Form::lanes};
    const std::uint32_t needed = storageCount(describeStrandKernel(form, {.bodies = true}));
    ASSERT_GT(needed, kFew);
    expectRefusal(make(*few, {}, kernel, true), needed, "leave out contacts, bodies and air");
    expectRefusal(make(*few, air, kernel), needed, "leave out contacts, bodies and air");
  }
  ASSERT_GT(mostOfContacts(), kFew);
  const auto refused = make(*few, contacts);
  ASSERT_FALSE(refused);
  expectParts(refused.error().message, {"storage buffers", "the device has 8", "leave out contacts"});
}

}  // namespace
}  // namespace ringlet::test::bound_buffers_test
