// The forms that kernels and the read-back take on GPUs, on the device at hand: the same bits as a
// processor's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parity/contacts.h"
#include "ringlet/gpu/device.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::gpu_forms_test {
namespace {

struct Case {
  const char* name = "";
  Groom groom;
  Settings settings{};
  KernelChoice kernel{.particlesPerLane = 8, .lanes = 4};
  double amplitude = 0.03;  // of the head [m]
};

std::vector<Case> allCases() {
  std::vector<Case> all;
  const Groom several = parity::randomGroom({2, 3, 31, 30, 24, 16, 9, 32}, 9);
  all.push_back({"alone", several});
  all.push_back({"in chunks, and parts of a frame", several});
  all.back().kernel.mostBufferBytes = 2000;
  all.push_back({"with a strand of no length", several});
  all.back().groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, 1e-7f, 0}, {1, 2e-7f, 1e-5f}});
  // So fast that the sample finds lists to lack some pairs.
  all.push_back({"pairs that part", parity::bunchAndStrands(), parity::meetingSettings()});
  all.back().settings.contacts.method = ContactMethod::explicitPairs;
  all.back().amplitude = 0.12;
  for (const auto& [name, method] : {std::pair{"pairs", ContactMethod::explicitPairs},
                                     {"a volume", ContactMethod::volume},
                                     {"both", ContactMethod::automatic}}) {
    all.push_back({name, parity::bunchAndStrands(), parity::meetingSettings()});
    all.back().settings.contacts.method = method;
  }
  return all;
}

struct Seen {
  std::vector<std::vector<Vec3f>> frames;
  std::vector<Vec3f> velocities;
  std::uint64_t contacts = 0, rebuilds = 0;
};

class GpuForms : public GpuTest {
 protected:
  static Seen run(const ComputeDevice& device, const Case& c) {
    Seen seen;
    auto simulation = Simulation::create(device, c.groom, {}, c.settings, {}, c.kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    if (!simulation) return seen;
    for (int frame = 1; frame <= 10; ++frame) {
      const HeadPose head{{c.amplitude * std::sin(0.7 * frame), 0, 0},
                          fromRotationVector(Vec3d{0, 0.05 * frame, 0})};
      EXPECT_TRUE(simulation->stepFrame(head));
      seen.frames.push_back(simulation->framePositions());
      const auto view = simulation->frameView();
      EXPECT_EQ(std::vector<Vec3f>(view.begin(), view.end()), seen.frames.back());
      EXPECT_EQ(seen.frames.back(), simulation->state()->positions);
    }
    seen.velocities = simulation->state()->velocities;
    if (c.settings.contacts.on) {
      const auto report = simulation->contactReport();
      EXPECT_TRUE(report) << report.error().message;
      seen.contacts = report->contacts, seen.rebuilds = report->rebuilds;
    }
    return seen;
  }
};

TEST_F(GpuForms, GiveTheBitsOfAProcessors) {
  const auto opened = gpu::Device::open("", {.asGpu = true});
  ASSERT_TRUE(opened) << opened.error().message;
  const ComputeDevice asGpu = ComputeDevice::over(*opened);
  for (const Case& c : allCases()) {
    SCOPED_TRACE(c.name);
    const Seen here = run(device(), c), there = run(asGpu, c);
    EXPECT_EQ(here.frames, there.frames);
    EXPECT_EQ(here.velocities, there.velocities);
    EXPECT_EQ(here.contacts, there.contacts);
    EXPECT_EQ(here.rebuilds, there.rebuilds);
    fmt::print("{}: {} contacts, {} rebuilds of lists in 80 steps\n", c.name, here.contacts, here.rebuilds);
  }
  expectNoMessages(*(*opened)->validationLog());
}

}  // namespace
}  // namespace ringlet::test::gpu_forms_test
