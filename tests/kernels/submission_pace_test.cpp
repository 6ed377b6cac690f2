// How frames are cut into submissions by the time of the frame before; and that it changes no bit.
#include "ringlet/solver/plan/submission_pace.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "ringlet/solver/plan/dispatch_plan.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"

namespace ringlet::test::submission_pace_test {
namespace {

using Stages = std::vector<std::pair<std::string, double>>;  // [ms]

// How many submissions so many dispatches of strands make.
int submissionsOf(SubmissionPace& pace, int dispatches, double particleSteps) {
  pace.beginRecording();
  int count = 1;
  for (int d = 0; d < dispatches; ++d) count += pace.cutsBeforeStrands(particleSteps) ? 1 : 0;
  return count;
}

TEST(SubmissionPace, WithoutLimitAFrameIsOneSubmission) {
  SubmissionPace pace(0);
  EXPECT_EQ(submissionsOf(pace, 100, 1e12), 1);
  EXPECT_EQ(pace.mostParticleSteps(), kAnyParticleSteps);
  EXPECT_FALSE(pace.learn(Stages{{"strand_step", 1e6}}, 1));
  EXPECT_EQ(submissionsOf(pace, 100, 1e12), 1);
}

TEST(SubmissionPace, WhatIsNotKnownIsSubmittedAlone) {
  SubmissionPace pace(0.3);
  EXPECT_EQ(submissionsOf(pace, 7, 1), 7);
  EXPECT_LE(pace.mostParticleSteps(), 1u << 20);
}

// A second of 4096 particle steps; half of 0.5 s is planned for, which is 1024.
TEST(SubmissionPace, KnownWorkFillsHalfOfWhatASubmissionMayTake) {
  SubmissionPace pace(0.5);
  EXPECT_TRUE(pace.learn(Stages{{"strand_step", 250}, {"strand_step", 750}}, 4096));
  EXPECT_EQ(pace.mostParticleSteps(), 1024u);
  EXPECT_EQ(submissionsOf(pace, 10, 1024), 10);
  EXPECT_EQ(submissionsOf(pace, 10, 513), 10);
  EXPECT_EQ(submissionsOf(pace, 10, 512), 5);
  EXPECT_EQ(submissionsOf(pace, 10, 256), 3);
}

TEST(SubmissionPace, RecordingsAreMadeAnewWhereWorkTakesTwice) {
  SubmissionPace pace(0.5);
  EXPECT_TRUE(pace.learn(Stages{{"strand_step", 125}, {"contact_query", 20}}, 512)) << "nothing was known";
  EXPECT_FALSE(pace.learn(Stages{{"strand_step", 240}, {"contact_query", 39}}, 512));
  EXPECT_EQ(pace.mostParticleSteps(), 1024u) << "as recordings were made";
  EXPECT_TRUE(pace.learn(Stages{{"strand_step", 260}, {"contact_query", 20}}, 512));
  EXPECT_TRUE(pace.learn(Stages{{"strand_step", 260}, {"contact_query", 10}, {"contact_query", 41}}, 512));
  EXPECT_TRUE(pace.learn(Stages{{"strand_step", 260}, {"contact_life", 1}}, 512)) << "a stage not known";
  EXPECT_FALSE(pace.learn(Stages{{"strand_step", 260}, {"contact_life", 5}}, 512)) << "too short to matter";
}

// Every strand and step once, in order, and no dispatch above the bound, but for one step of one workgroup.
TEST(SubmissionPace, DispatchesKeepTheBound) {
  const DeviceLimits limits = [] {
    DeviceLimits gpu;
    gpu.subgroupSize = 32;
    gpu.hasSubgroupShuffle = true;
    return gpu;
  }();
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 16u, 64u, 129u, 3000u}) counts.insert(counts.end(), 100, n);
  Settings settings;
  settings.stepsPerFrame = 30;
  const auto ranges = planRanges(counts, limits, {.manyKernels = true});
  ASSERT_TRUE(ranges) << ranges.error().message;
  for (const std::uint64_t most : {1ull, 1000ull, 50'000ull, 1'000'000ull}) {
    SCOPED_TRACE(most);
    const auto plan = planFrame(*ranges, {limits, 64, most}, settings, 0);
    ASSERT_TRUE(plan) << plan.error().message;
    std::vector<std::uint32_t> nextStep(counts.size(), 0);
    for (const PlannedDispatch& d : *plan) {
      const std::uint64_t particleSteps = particleStepsOf(d, *ranges);
      EXPECT_TRUE(particleSteps <= most || (d.groupCount == 1 && d.stepEnd == d.stepBegin + 1))
          << particleSteps << " in " << d.groupCount << " groups and " << d.stepEnd - d.stepBegin << " steps";
      for (std::uint32_t s = d.strandBegin; s < d.strandEnd; ++s) {
        EXPECT_EQ(d.stepBegin, nextStep[s]);
        nextStep[s] = d.stepEnd;
      }
    }
    for (const std::uint32_t step : nextStep) EXPECT_EQ(step, 30u);
    const auto pass = planPass(*ranges, {limits, 64, most}, settings, 0, {.moves = true});
    ASSERT_TRUE(pass) << pass.error().message;
    std::size_t inPass = 0;
    for (const PlannedDispatch& d : *pass) {
      EXPECT_TRUE(particleStepsOf(d, *ranges) <= most || d.groupCount == 1);
      inPass += d.strandEnd - d.strandBegin;
    }
    EXPECT_EQ(inPass, counts.size());
  }
}

TEST(SubmissionPace, OnlyDispatchesOfTheSameStrandsWaitForEachOther) {
  const PlannedDispatch first{.range = 1, .strandBegin = 10, .strandEnd = 20};
  PlannedDispatch other = first;
  EXPECT_TRUE(sharesStrands(first, other));
  other.strandBegin = 19, other.strandEnd = 40;
  EXPECT_TRUE(sharesStrands(first, other));
  EXPECT_TRUE(sharesStrands(other, first));
  other.strandBegin = 20;
  EXPECT_FALSE(sharesStrands(first, other));
  EXPECT_FALSE(sharesStrands(other, first));
  other = first, other.range = 2;
  EXPECT_FALSE(sharesStrands(first, other)) << "of another range, and so of other strands or another chunk";
}

struct Outcome {
  HairState state;
  ContactReport contacts;
  std::uint64_t submissions = 0;
};

class ShortSubmissions : public GpuTest {
 protected:
  static constexpr int kFrames = 4;
  // Two at a time in flight, as the program runs them.
  static Outcome run(const ComputeDevice& device, bool contacts, const KernelChoice& kernel) {
    Settings settings;
    settings.contacts.on = contacts;
    auto simulation =
        Simulation::create(device, randomGroom({2, 8, 16, 20, 64, 100, 16, 8}, 3), {}, settings, {}, kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    if (!simulation) return {};
    const std::uint64_t before = device.gpu().submissionCount();
    int submitted = 0, waited = 0;
    while (waited < kFrames) {
      if (submitted < kFrames && submitted - waited < 2) {
        HeadPose pose;
        pose.position = {0.004 * ++submitted, 0, 0};
        const std::vector<HeadPose> poses(static_cast<std::size_t>(settings.stepsPerFrame), pose);
        EXPECT_TRUE(simulation->submitFrame(poses));
      } else {
        EXPECT_TRUE(simulation->waitFrame());
        ++waited;
      }
    }
    const std::uint64_t submissions = device.gpu().submissionCount() - before;
    return {*simulation->state(), *simulation->contactReport(), submissions};
  }

  static void expectSameBits(const Outcome& a, const Outcome& b) {
    EXPECT_EQ(a.state.positions, b.state.positions);
    EXPECT_EQ(a.state.velocities, b.state.velocities);
    EXPECT_EQ(a.contacts.listed, b.contacts.listed);
    EXPECT_EQ(a.contacts.pairTests, b.contacts.pairTests);
    EXPECT_EQ(a.contacts.rebuilds, b.contacts.rebuilds);
  }
};

TEST_F(ShortSubmissions, HaveTheSameBits) {
  for (const bool contacts : {false, true}) {
    for (KernelChoice::Form form : {KernelChoice::Form::automatic, KernelChoice::Form::serial}) {
      SCOPED_TRACE(contacts ? "contacts" : "hair alone");
      const Outcome whole = run(device(), contacts, {.form = form, .longestSubmissionSeconds = 1e6});
      const Outcome cut = run(device(), contacts, {.form = form, .longestSubmissionSeconds = 1e-9});
      expectSameBits(whole, cut);
      EXPECT_LT(whole.submissions, cut.submissions);
      // The first two frames are recorded before anything is known, but that so little work is short.
      EXPECT_GE(cut.submissions, (kFrames - 2) * 8u) << "a step is at least one submission";
    }
  }
}

// Nobody watches a CPU's driver. Elsewhere dispatches are submitted alone while nothing is known of them.
TEST_F(ShortSubmissions, AreNotNeededOnACpu) {
  const std::uint64_t submissions = run(device(), false, {.mostBufferBytes = 16384}).submissions;
  if (device().limits().isCpu) {
    EXPECT_EQ(submissions, static_cast<std::uint64_t>(kFrames));
  } else {
    EXPECT_GT(submissions, static_cast<std::uint64_t>(kFrames));
  }
}

// With the layer every dispatch waits for the one before; without it only those that must.
TEST_F(ShortSubmissions, TheSameBitsWithoutTheValidationLayer) {
  unsetenv("RINGLET_VALIDATION");
  const auto plain = ComputeDevice::open();
  setenv("RINGLET_VALIDATION", "1", 1);
  ASSERT_TRUE(plain) << plain.error().message;
  ASSERT_EQ(plain->gpu().validationLog(), nullptr);
  const KernelChoice chunks{.mostBufferBytes = 16384};  // ranges of their own
  expectSameBits(run(*plain, false, chunks), run(device(), false, chunks));
}

}  // namespace
}  // namespace ringlet::test::submission_pace_test
