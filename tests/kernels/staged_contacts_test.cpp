// Contacts where the host does not see the device's memory, as on a graphics card: everything the host reads
// or writes crosses by copies, and the bits are the same.
#include <gtest/gtest.h>

#include <vector>

#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::staged_contacts_test {
namespace {

struct Seen {
  HairState state;
  ContactReport report;
  std::vector<ListedContact> listed;
};

class StagedContacts : public GpuTest {
 protected:
  // Strands so near each other that lists must grow in the first frame.
  static Groom denseGroom() {
    Groom groom;
    groom.metresPerUnit = 1;
    for (int s = 0; s < 60; ++s) {
      std::vector<Vec3f> strand;
      for (int i = 0; i < 8; ++i)
        strand.push_back(Vec3f(Vec3d{0.0002 * (s % 10), -0.002 * i, 0.0002 * (s / 10)}));
      groom.addStrand(strand);
    }
    return groom;
  }

  static Seen seenAfter(const Simulation& simulation) {
    return {*simulation.state(), *simulation.contactReport(), *Diagnostics(simulation).listedContacts()};
  }

  // Frames whose lists grow; then the first state put back, which makes the device forget contacts, and more
  // frames.
  static std::vector<Seen> run(const ComputeDevice& device) {
    Settings settings;
    settings.contacts.on = true;
    settings.contacts.method = ContactMethod::explicitPairs;
    settings.contacts.radius = 0.001;
    auto simulation = Simulation::create(device, denseGroom(), {}, settings);
    EXPECT_TRUE(simulation) << simulation.error().message;
    if (!simulation) return {};
    const std::uint64_t listBytes = Diagnostics(*simulation).memory().contactLists;
    // Nearer each other than at rest, so that contacts push.
    HairState squeezed = *simulation->state();
    for (Vec3f& p : squeezed.positions) p = {0.6f * p.x, p.y, 0.6f * p.z};
    EXPECT_TRUE(simulation->setState(squeezed));
    std::vector<Seen> seen;
    HeadPose head;
    for (int frame = 1; frame <= 4; ++frame) {
      head.position = {0.002 * frame, 0, 0};
      EXPECT_TRUE(simulation->stepFrame(head));
      seen.push_back(seenAfter(*simulation));
      if (frame == 2) {
        EXPECT_TRUE(simulation->setState(squeezed));
      }
    }
    EXPECT_GT(Diagnostics(*simulation).memory().contactLists, listBytes) << "lists were to grow";
    EXPECT_GT(seen.back().report.contacts, 0u);
    return seen;
  }
};

TEST_F(StagedContacts, HaveTheSameBits) {
  const auto opened = gpu::Device::open("", {.alwaysStage = true});
  ASSERT_TRUE(opened) << opened.error().message;
  const auto staged = run(ComputeDevice::over(*opened)), mapped = run(device());
  ASSERT_EQ(staged.size(), mapped.size());
  for (std::size_t frame = 0; frame < staged.size(); ++frame) {
    SCOPED_TRACE(frame);
    const Seen &a = staged[frame], &b = mapped[frame];
    EXPECT_EQ(a.state.positions, b.state.positions);
    EXPECT_EQ(a.state.velocities, b.state.velocities);
    EXPECT_EQ(a.report.listed, b.report.listed);
    EXPECT_EQ(a.report.contacts, b.report.contacts);
    EXPECT_EQ(a.report.pairTests, b.report.pairTests);
    EXPECT_EQ(a.report.rebuilds, b.report.rebuilds);
    EXPECT_EQ(a.report.momentumError, b.report.momentumError);
    ASSERT_EQ(a.listed.size(), b.listed.size());
    for (std::size_t i = 0; i < a.listed.size(); ++i) {
      EXPECT_EQ(a.listed[i].a, b.listed[i].a);
      EXPECT_EQ(a.listed[i].b, b.listed[i].b);
    }
  }
  expectNoMessages(*(*opened)->validationLog());
}

// Hair that stands still keeps its lists; put somewhere, even where it is, it gets new ones.
TEST_F(StagedContacts, SettingTheStateForgetsLists) {
  const auto opened = gpu::Device::open("", {.alwaysStage = true});
  ASSERT_TRUE(opened) << opened.error().message;
  for (const ComputeDevice& on : {ComputeDevice::over(*opened), device()}) {
    Settings settings;
    settings.contacts.on = true;
    settings.contacts.method = ContactMethod::explicitPairs;
    auto simulation = Simulation::create(on, denseGroom(), {}, settings);
    ASSERT_TRUE(simulation) << simulation.error().message;
    ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
    const std::uint64_t before = simulation->contactReport()->rebuilds;
    ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
    ASSERT_EQ(simulation->contactReport()->rebuilds, before) << "hair was to stand still";
    ASSERT_TRUE(simulation->setState(*simulation->state()));
    ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
    EXPECT_EQ(simulation->contactReport()->rebuilds, before + 1);
  }
}

// Both sides of every listed pair are looked at once a step: counts go on over frames.
TEST_F(StagedContacts, PairTestsAddUpOverFrames) {
  const std::vector<Seen> seen = run(device());
  std::uint64_t before = 0;
  for (const Seen& frame : seen) {
    EXPECT_GE(frame.report.pairTests, before + 2 * frame.report.listed) << "the last step's, at least";
    before = frame.report.pairTests;
  }
}

}  // namespace
}  // namespace ringlet::test::staged_contacts_test
