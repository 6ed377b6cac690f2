// Simulation::cut of hair with contacts: what is cut off and what is kept go on meeting, pair by pair, and
// what is cut off leaves the volume.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parity/contacts.h"
#include "reference/step.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::cut_contacts_test {
namespace {

using namespace parity;

using CutContacts = GpuTest;

// Every third strand, near the middle; then some of them again.
std::vector<StrandCut> cutsAt(const Groom& groom, int frame) {
  std::vector<StrandCut> cuts;
  for (std::uint32_t s = frame == 3 ? 1 : 4; s < groom.strandCount(); s += frame == 3 ? 3 : 9) {
    const auto half = static_cast<std::uint32_t>(groom.strand(s).size() / 2);
    cuts.push_back({s, frame == 3 ? half + s % 5 : half / 2});
  }
  return frame == 3 || frame == 4 ? cuts : std::vector<StrandCut>{};
}

// A few frames: pieces that hit each other while they fall take differences along, threefold a frame.
TEST_F(CutContacts, FramesAgreeWithDouble) {
  using Form = KernelChoice::Form;
  struct Case {
    const char* name;
    Groom groom;
    ContactMethod method = ContactMethod::explicitPairs;
    KernelChoice kernel{};
    ContactTaper taper = ContactTaper::distance;
    int steps = 8;  // of 7 the frames that are followed by cuts end between two sorts of the volume
  };
  const Groom swatch = denseSwatch(32);
  const KernelChoice serial{Form::serial}, memory{Form::memory, 9, 4};
  for (const Case& c : {Case{"pairs", swatch},
                        {"pairs, serial", swatch, ContactMethod::explicitPairs, serial},
                        {"pairs, memory", swatch, ContactMethod::explicitPairs, memory},
                        {"pairs, time", swatch, ContactMethod::explicitPairs, {}, ContactTaper::time},
                        {"volume", swatch, ContactMethod::volume},
                        {"volume, serial", swatch, ContactMethod::volume, serial},
                        {"volume, 7 steps", swatch, ContactMethod::volume, {}, ContactTaper::distance, 7},
                        {"both", bunchAndStrands(), ContactMethod::automatic}}) {
    SCOPED_TRACE(c.name);
    Settings settings = meetingSettings();
    settings.contacts.method = c.method;
    settings.contacts.taper = c.taper;
    settings.stepsPerFrame = c.steps;
    int frame = 0;
    std::uint64_t met = 0;
    const auto worst = shakenError(device(), c.groom, settings, c.kernel, 5,
                                   [&](Simulation& simulation, reference::Simulation<double>& reference) {
                                     met = simulation.contactReport()->contacts;
                                     EXPECT_EQ(met, reference.report().contacts) << frame;
                                     const auto cuts = cutsAt(c.groom, ++frame);
                                     if (cuts.empty()) return;
                                     const Status cut = simulation.cut(cuts);
                                     EXPECT_TRUE(cut) << cut.error().message;
                                     reference.cut(c.groom, {}, cuts);
                                   });
    ASSERT_TRUE(worst) << worst.error().message;
    fmt::print("{}: {:.1e} m apart; {} contacts at the end\n", c.name, *worst, met);
    EXPECT_LE(*worst, kMeetingMetres);
  }
}

// What has fallen for a second is faster and farther than the volume's sums have room for, and of it no more.
TEST_F(CutContacts, WhatFellIsNotOfTheVolume) {
  const Groom groom = denseSwatch(32);
  Settings settings = meetingSettings();
  settings.contacts.method = ContactMethod::volume;
  auto hair = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(hair) << hair.error().message;
  ASSERT_TRUE(hair->cut(cutsAt(groom, 3)));
  const std::vector<HeadPose> still(static_cast<std::size_t>(settings.stepsPerFrame));
  for (int frame = 0; frame < 36; ++frame) ASSERT_TRUE(hair->stepFrame(still));
  const auto points = *hair->positions();
  EXPECT_LT(points[groom.firstPoint[2] - 1].y, -5.0f) << "nothing fell";
  const ContactReport report = *hair->contactReport();
  EXPECT_EQ(report.volumeCut, 0u);
  EXPECT_LT(report.volumeLargest, 1);
}

// Two strands side by side that stand out from the head, and one above them, across both.
Groom crossing() {
  const Vec3f roots[] = {{-0.03f, 0, 0}, {0.03f, 0, 0}, {-0.15f, 0.01f, 0.04f}};
  Groom groom;
  groom.metresPerUnit = 1;
  for (const Vec3f& root : roots) {
    for (int i = 0; i < 50; ++i) {
      const float along = 0.004f * static_cast<float>(i);
      groom.points.push_back(root + (root.y > 0 ? Vec3f{along, 0, 0} : Vec3f{0, 0, along / 2}));
    }
    groom.firstPoint.push_back(static_cast<std::uint32_t>(groom.points.size()));
  }
  return groom;
}

// In half a second it would fall 1.2 m.
TEST_F(CutContacts, LandsOnOtherHair) {
  const Groom groom = crossing();
  Material stiff;
  stiff.bendStiffness = 200;
  for (const bool meets : {true, false}) {
    SCOPED_TRACE(meets);
    Settings settings;
    settings.contacts.on = meets;
    settings.contacts.method = ContactMethod::explicitPairs;
    settings.contacts.radius = 0.003;
    auto hair = Simulation::create(device(), groom, stiff, settings);
    ASSERT_TRUE(hair) << hair.error().message;
    const std::vector<StrandCut> cuts{{2, 22}};
    ASSERT_TRUE(hair->cut(cuts));
    const std::vector<HeadPose> still(static_cast<std::size_t>(settings.stepsPerFrame));
    for (int frame = 0; frame < 12; ++frame) ASSERT_TRUE(hair->stepFrame(still));
    const auto points = *hair->positions();
    for (std::size_t i = groom.firstPoint[2] + 22; i < points.size(); ++i) {
      if (meets)
        EXPECT_GT(points[i].y, -0.02f) << i;
      else
        EXPECT_LT(points[i].y, -1.f) << i;
    }
  }
}

}  // namespace
}  // namespace ringlet::test::cut_contacts_test
