// A simulation that a checkpoint is put into goes on with the bits of the one it was taken from: every
// integrator and form, contacts in room that had to grow, bodies and air, roots that move, grooms in chunks,
// a head that jumps; and the reference.
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "reference/step.h"
#include "ringlet/base/archive.h"
#include "ringlet/scene/motion.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::checkpoint_test {
namespace {

// What goes on in a run, and for how long.
struct Case {
  const char* name;
  Settings settings{};
  KernelChoice kernel{};
  std::vector<Body> bodies{};
  bool jumps = false, isStill = false, oddSteps = false;
  Groom groom = randomGroom({2, 3, 31, 64, 64, 100, 128, 250}, 9);
};

// Strands that overlap once they are shaken: contacts come and go, and lists outgrow their first room.
Groom tuft() {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 60; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 20; ++i) {
      const double turn = 0.9 * i + s;
      strand.push_back(Vec3f(Vec3d{0.004 * (s % 8) + 0.01 * std::cos(turn), -0.006 * i,
                                   0.004 * (s / 8) + 0.01 * std::sin(turn)}));
    }
    groom.addStrand(strand);
  }
  return groom;
}

std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (const Integrator integrator : {Integrator::jacobi, Integrator::pointJacobi, Integrator::paper}) {
    cases.push_back({.name = "lanes"});
    cases.back().settings.integrator = integrator;
    cases.push_back({.name = "memory", .kernel = {.form = KernelChoice::Form::memory}});
    cases.back().settings.integrator = integrator;
    cases.push_back({.name = "serial", .kernel = {.form = KernelChoice::Form::serial}});
    cases.back().settings.integrator = integrator;
    cases.back().settings.dampingLoops = 4;  // as many of 250 particles as lavapipe loops in one lane
  }
  cases.push_back({.name = "contacts", .groom = tuft()});
  cases.back().settings.contacts.on = true;
  cases.back().settings.contacts.method = ContactMethod::explicitPairs;
  cases.back().settings.contacts.radius = 0.006;
  cases.push_back(cases.back());
  cases.back().name = "contacts of the time taper";
  cases.back().settings.contacts.taper = ContactTaper::time;
  cases.push_back(cases[cases.size() - 2]);  // whose lists are kept from step to step
  cases.back().name = "contacts at rest";
  cases.back().isStill = true;
  cases.push_back(cases[cases.size() - 3]);
  cases.back().name = "contacts without crossings";
  cases.back().settings.contacts.noCrossings = true;
  cases.push_back({.name = "a volume", .groom = tuft()});
  cases.back().settings.contacts.on = true;
  cases.back().settings.contacts.method = ContactMethod::volume;
  cases.push_back({.name = "a volume between two sorts", .groom = tuft()});
  cases.back().settings = cases[cases.size() - 2].settings;
  cases.back().oddSteps = true;
  cases.push_back({.name = "bodies and air", .bodies = sampleBodies()});
  cases.back().settings.air = {.on = true, .wind = {1, 0, 2}, .gust = 0.5, .turbulence = 1};
  cases.push_back({.name = "contacts, bodies and air", .bodies = sampleBodies(), .groom = tuft()});
  cases.back().settings.contacts.on = true;
  cases.back().settings.contacts.method = ContactMethod::explicitPairs;
  cases.back().settings.contacts.radius = 0.006;
  cases.back().settings.air = {.on = true, .wind = {1, 0, 2}, .gust = 0.5, .turbulence = 1};
  cases.push_back({.name = "moving roots", .kernel = {.features = {.roots = true}}});
  cases.push_back({.name = "moving roots of rigid strands", .kernel = {.features = {.roots = true}}});
  cases.back().groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, 1e-7f, 0}, {1, 2e-7f, 1e-5f}});
  cases.push_back({.name = "chunks", .kernel = {.mostBufferBytes = 60000}});
  cases.push_back({.name = "a jump", .jumps = true});
  for (Case& one : cases) one.settings.stepsPerFrame = one.oddSteps ? 3 : 4;
  return cases;
}

constexpr int kBefore = 5, kAfter = 4;  // frames

std::vector<HeadPose> headsOf(const Case& one, int frame) {
  static const Motion motion = *motionByName("shake", {0, 1, 0});
  std::vector<HeadPose> heads;
  for (int step = 1; step <= one.settings.stepsPerFrame; ++step) {
    HeadPose pose =
        motion.poseAt((frame + double(step) / one.settings.stepsPerFrame) / one.settings.framesPerSecond);
    if (one.isStill) pose = {};
    if (one.jumps && frame >= kBefore - 1) pose.position.x += 50;
    heads.push_back(pose);
  }
  return heads;
}

std::vector<BodyPose> rootsOf(const Case& one, int frame) {
  std::vector<BodyPose> roots;
  if (!one.kernel.features.roots) return roots;
  for (int step = 1; step <= one.settings.stepsPerFrame; ++step) {
    for (std::size_t s = 0; s < one.groom.strandCount(); ++s) {
      const double swing = std::sin(0.1 * (4 * frame + step + double(s)));
      roots.push_back({{0.001 * swing, 0, 0}, {0, std::sin(0.1 * swing), 0, std::cos(0.1 * swing)}});
    }
  }
  return roots;
}

// Of its lists: both particles, and what share of its spring and damper acts.
std::vector<std::tuple<std::uint32_t, std::uint32_t, float, float>> pairsOf(const Simulation& simulation) {
  const auto listed = Diagnostics(simulation).listedContacts();
  EXPECT_TRUE(listed && !listed->empty()) << "no pair is in a list, and lists are not tested";
  std::vector<std::tuple<std::uint32_t, std::uint32_t, float, float>> pairs;
  for (const ListedContact& c : *listed) pairs.emplace_back(c.a, c.b, c.stiffnessShare, c.dampingShare);
  return pairs;
}

class CheckpointTest : public GpuTest {
 protected:
  Simulation make(const Case& one) {
    auto made = Simulation::create(device(), one.groom, {}, one.settings, {.bodies = one.bodies}, one.kernel);
    EXPECT_TRUE(made) << one.name << ": " << made.error().message;
    return std::move(*made);
  }
};

using Checkpoint = CheckpointTest;

TEST_F(Checkpoint, GoesOnWithTheSameBits) {
  for (const Case& one : allCases()) {
    SCOPED_TRACE(one.name);
    Simulation whole = make(one), second = make(one);
    const auto step = [&](Simulation& simulation, int frame) {
      ASSERT_TRUE(simulation.stepFrame(headsOf(one, frame), {}, rootsOf(one, frame)));
    };
    for (int frame = 0; frame < kBefore; ++frame) step(whole, frame);
    const auto checkpoint = whole.checkpoint();
    ASSERT_TRUE(checkpoint);
    const Status restored = second.restore(*checkpoint);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(*second.positions(), *whole.positions());
    EXPECT_EQ(second.contactReport()->momentumError, whole.contactReport()->momentumError);
    const bool pairs =
        one.settings.contacts.on && one.settings.contacts.method == ContactMethod::explicitPairs;
    if (pairs) {
      EXPECT_EQ(pairsOf(second), pairsOf(whole));
    }
    const std::uint64_t rebuildsBefore = whole.contactReport()->rebuilds;
    for (int frame = kBefore; frame < kBefore + kAfter; ++frame) {
      step(whole, frame);
      step(second, frame);
      EXPECT_EQ(second.framePositions(), whole.framePositions()) << "frame " << frame;
    }
    const HairState a = *whole.state(), b = *second.state();
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.velocities, b.velocities);
    const SimulationReport was = *whole.report(), is = *second.report();
    EXPECT_EQ(was.maxEdgeStretch, is.maxEdgeStretch);
    EXPECT_EQ(was.limitedShare, is.limitedShare);
    const ContactReport contactsWere = *whole.contactReport(), contactsAre = *second.contactReport();
    EXPECT_EQ(contactsWere.contacts, contactsAre.contacts);
    EXPECT_EQ(contactsWere.listed, contactsAre.listed);
    EXPECT_EQ(contactsWere.pairTests, contactsAre.pairTests);
    EXPECT_EQ(contactsWere.rebuilds, contactsAre.rebuilds);
    EXPECT_EQ(contactsWere.momentumError, contactsAre.momentumError);
    EXPECT_EQ(contactsWere.volumeCut, contactsAre.volumeCut);
    EXPECT_EQ(contactsWere.ways.changed, contactsAre.ways.changed);
    EXPECT_EQ(contactsWere.volumeLargest, contactsAre.volumeLargest);
    if (pairs && !one.isStill) {
      EXPECT_GT(contactsWere.contacts, 0u) << "nothing touches, and nothing is tested";
    }
    if (one.isStill) {
      EXPECT_EQ(contactsWere.rebuilds, rebuildsBefore)
          << "the lists were not kept, and kept ones are not tested";
    }
  }
}

TEST_F(Checkpoint, OfAnotherSimulationIsRefused) {
  const std::vector<Case> cases = allCases();
  Simulation hair = make(cases[0]);
  const auto checkpoint = hair.checkpoint();
  ASSERT_TRUE(checkpoint);
  Case smaller = cases[0];
  smaller.groom = randomGroom({2, 3, 31}, 9);
  EXPECT_FALSE(make(smaller).restore(*checkpoint)) << "fewer particles";
  EXPECT_FALSE(hair.restore(std::span(*checkpoint).first(checkpoint->size() - 1))) << "a byte too few";
  std::vector<std::byte> longer = *checkpoint;
  longer.push_back({});
  EXPECT_FALSE(hair.restore(longer)) << "a byte too many";
}

TEST_F(Checkpoint, TheReferenceGoesOnWithTheSameBits) {
  for (const Case& one : allCases()) {
    SCOPED_TRACE(one.name);
    const auto make = [&] {
      return reference::Simulation<double>(one.groom, {}, one.settings, {}, {}, {}, one.bodies);
    };
    auto whole = make(), second = make();
    for (int frame = 0; frame < kBefore; ++frame)
      whole.stepFrame(headsOf(one, frame), {}, rootsOf(one, frame));
    Archive writing = Archive::writing();
    whole.archive(writing);
    const std::vector<std::byte> bytes = writing.take();
    Archive reading = Archive::reading(bytes);
    second.archive(reading);
    ASSERT_TRUE(reading.isWhole());
    for (int frame = kBefore; frame < kBefore + kAfter; ++frame) {
      whole.stepFrame(headsOf(one, frame), {}, rootsOf(one, frame));
      second.stepFrame(headsOf(one, frame), {}, rootsOf(one, frame));
    }
    EXPECT_EQ(whole.positions(), second.positions());
    EXPECT_EQ(whole.velocities(), second.velocities());
    const reference::Report was = whole.report(), is = second.report();
    EXPECT_EQ(was.maxEdgeStretch, is.maxEdgeStretch);
    EXPECT_EQ(was.limitedEdges, is.limitedEdges);
    EXPECT_EQ(was.contacts, is.contacts);
    EXPECT_EQ(was.momentumError, is.momentumError);
    EXPECT_EQ(was.steps, is.steps);
    EXPECT_EQ(whole.contacts().pairTests, second.contacts().pairTests);
  }
}

}  // namespace
}  // namespace ringlet::test::checkpoint_test
