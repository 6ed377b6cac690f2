// How a frame with contacts is recorded. Contact kernels share buffers that several of them write, so that
// each must see what the one before it wrote; the validation layer does not notice a barrier left out there,
// and lavapipe runs dispatches in order. Mirrors solver/contacts/contact_stage.h.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/plan/frame_plan.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::contact_recording_test {
namespace {

using Commands = std::vector<std::string>;

// The contact kernels of a stage.
Commands kernelsOf(FrameStage stage, ContactTaper taper) {
  const bool lives = taper == ContactTaper::time;
  switch (stage) {
    case FrameStage::motion:
      return {"contact_motion"};
    case FrameStage::grid:
      return {"contact_count", "contact_scan", "contact_scatter", "contact_order", "contact_sample"};
    case FrameStage::lists:
      return {"contact_query"};
    case FrameStage::touch:
      return lives ? Commands{"contact_touch", "contact_life", "contact_check"} : Commands{"contact_touch"};
    case FrameStage::next:
      return {lives ? "contact_gather" : "contact_system"};
    default:
      return {};
  }
}

bool isContactKernel(const std::string& command) { return command.starts_with("contact_"); }

// Every dispatch has a barrier between itself and the dispatch or copy before it.
void expectBarriers(const Commands& commands, const std::string& label) {
  std::string before;  // since the last barrier
  for (const std::string& command : commands) {
    if (command == gpu::Recorder::kBarrier) {
      before.clear();
      continue;
    }
    const bool isCopy = command == gpu::Recorder::kCopy || command == gpu::Recorder::kFill;
    if (!isCopy || before.starts_with("contact_") || before.starts_with("strand_")) {
      EXPECT_EQ(before, "") << label << ": no barrier between it and " << command;
    }
    before = command;
  }
}

// The contact kernels of `steps` whole steps, in the order of the plan.
void expectSteps(const Commands& commands, int steps, const ContactSettings& contacts,
                 const std::string& label) {
  Commands expected, found;
  const std::vector<PlannedStage> plan =
      stagesOf({.steps = static_cast<std::uint32_t>(steps),
                .iterations = static_cast<std::uint32_t>(contacts.iterationCount(true)),
                .contacts = {.pairs = true}});
  for (const PlannedStage& stage : plan) {
    const Commands kernels = kernelsOf(stage.stage, contacts.taper);
    expected.insert(expected.end(), kernels.begin(), kernels.end());
  }
  std::ranges::copy_if(commands, std::back_inserter(found), isContactKernel);
  EXPECT_EQ(found, expected) << label;
}

// Strands that stand in each other's way once they are put together: their lists outgrow what they begin
// with.
Groom besideEachOther(int strandCount, int particles) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < strandCount; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < particles + s % 2 * 20; ++i)  // of two lengths
      strand.push_back(Vec3f(Vec3d{0.01 * (s % 10), -0.005 * i, 0.01 * (s / 10)}));
    groom.addStrand(strand);
  }
  return groom;
}

class ContactRecording : public GpuTest {};

// As a volume, and beside it pair by pair.
TEST_F(ContactRecording, TheVolumeHasABarrierBeforeEveryDispatch) {
  Groom groom = besideEachOther(60, 40);
  for (std::size_t i = 0; i < groom.points.size(); ++i) {  // curls much wider than they stand apart
    const Vec3f p = groom.points[i];
    groom.points[i] = Vec3f(Vec3d{0.3 * p.x + 0.02 * std::cos(0.9 * double(i)), p.y,
                                  0.3 * p.z + 0.02 * std::sin(0.9 * double(i))});
  }
  for (int s = 0; s < 3; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 8; ++i) strand.push_back(Vec3f(Vec3d{0.3 + 0.01 * s, -0.005 * i, 0}));
    groom.addStrand(strand);
  }
  for (const KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
    if (!makes({form}, groom)) continue;
    for (const int iterations : {1, 3}) {
      for (const ContactMethod method : {ContactMethod::volume, ContactMethod::automatic}) {
        Settings settings;
        settings.stepsPerFrame = 3;
        settings.contacts.on = true;
        settings.contacts.radius = 0.02;
        settings.contacts.prunePairs = false;
        settings.contacts.method = method;
        settings.contacts.iterations = iterations;
        auto simulation = Simulation::create(device(), groom, {}, settings, {}, {form});
        ASSERT_TRUE(simulation) << simulation.error().message;
        EXPECT_EQ(simulation->contactReport()->volumeStrands, method == ContactMethod::volume ? 63u : 60u);
        const std::string label =
            fmt::format("{}, {}, {}", Diagnostics(*simulation).kernels(), iterations, nameOf(method));
        const Commands frame = Diagnostics(*simulation).recordedFrame();
        expectBarriers(frame, label);
        EXPECT_EQ(std::ranges::count(frame, "volume_begin"), 3) << label;
        EXPECT_EQ(std::ranges::count(frame, "volume_place"), 2) << label;  // the first and the third step's
        EXPECT_EQ(std::ranges::count(frame, "volume_spread"), 3 * iterations) << label;
        EXPECT_EQ(std::ranges::count(frame, "contact_touch"), method == ContactMethod::volume ? 0 : 3)
            << label;
        ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
      }
    }
  }
}

TEST_F(ContactRecording, HasABarrierBeforeEveryDispatch) {
  constexpr int kSteps = 2;
  const Groom groom = besideEachOther(60, 3);
  for (const KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
    for (const auto& [iterations, taper] :
         {std::pair{1, ContactTaper::distance}, {3, ContactTaper::distance}, {3, ContactTaper::time}}) {
      Settings settings;
      settings.contacts.taper = taper;
      settings.stepsPerFrame = kSteps;
      settings.contacts.on = true;
      settings.contacts.radius = 0.002;
      settings.contacts.prunePairs = false;
      settings.contacts.method = ContactMethod::explicitPairs;
      settings.contacts.iterations = iterations;
      auto simulation = Simulation::create(device(), groom, {}, settings, {}, {form});
      ASSERT_TRUE(simulation) << simulation.error().message;
      const std::string label =
          fmt::format("{}, {}, {}", Diagnostics(*simulation).kernels(), iterations, nameOf(taper));
      const Commands whole = Diagnostics(*simulation).recordedFrame();
      expectBarriers(whole, label);
      expectSteps(whole, kSteps, settings.contacts, label);

      HairState state{*simulation->positions(), std::vector<Vec3f>(groom.points.size())};
      for (std::size_t i = 0; i < groom.points.size(); ++i) state.positions[i] = state.positions[i] * 0.1f;
      ASSERT_TRUE(simulation->setState(state));
      ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
      const Commands again = Diagnostics(*simulation).recordedFrame();
      EXPECT_NE(again, whole) << label << ": lists had room from the start";
      expectBarriers(again, label + ", with more room");
      const auto steps = std::ranges::count(again, "contact_motion");
      EXPECT_TRUE(steps == 1 || steps == kSteps) << label;
      expectSteps(again, static_cast<int>(steps), settings.contacts, label + ", with more room");
    }
  }
}

}  // namespace
}  // namespace ringlet::test::contact_recording_test
