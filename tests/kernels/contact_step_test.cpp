// The contacts of a step on the device against the float reference: which pairs are live, what they remember,
// and the velocities and positions that follow; one step from a wild state, and frame after frame, with lists
// that are made anew, kept, and outgrown; with both tapers. Mirrors shaders/kernels/contact_touch.comp,
// contact_system.comp, contact_life.comp and contact_gather.comp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>

#include "parity/contacts.h"
#include "reference/step.h"
#include "ringlet/solver/diagnostics.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/test_support.h"
#include "tests/support/tolerances.h"

namespace ringlet::test::contact_step_test {
namespace {

using namespace parity;

template <class Real>
reference::Field<Real> toField(const std::vector<Vec3f>& values) {
  reference::Field<Real> field;
  for (Vec3f v : values) field.push_back(reference::toEigen<Real>(v));
  return field;
}

class ContactStep : public GpuTest {
 protected:
  // Live pairs of both: the same, with the same shares; with the distance taper, which of their springs and
  // dampers act.
  template <class Real>
  void expectSameContacts(const Simulation& simulation, const reference::Simulation<Real>& reference,
                          const ContactSettings& settings, double tolerance, const std::string& label) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, double>> expected;
    const auto& contacts = reference.contacts();
    for (const auto& live : contacts.live) {
      const std::uint32_t a = contacts.particles[live.pair.a].index,
                          b = contacts.particles[live.pair.b].index;
      expected[{std::min(a, b), std::max(a, b)}] =
          settings.taper == ContactTaper::time
              ? std::pair<double, double>(live.life.stiffnessShare, live.life.dampingShare)
              : std::pair<double, double>(live.weights.spring > 0 ? 1 : 0, 1);
    }
    const auto listed = Diagnostics(simulation).listedContacts();
    ASSERT_TRUE(listed) << listed.error().message;
    std::size_t found = 0;
    for (const ListedContact& c : *listed) {
      if (c.stiffnessShare == 0 && c.dampingShare == 0) continue;
      ++found;
      const auto it = expected.find({c.a, c.b});
      ASSERT_NE(it, expected.end()) << label << ": pair " << c.a << ", " << c.b << " does not touch";
      EXPECT_NEAR(c.stiffnessShare, it->second.first, tolerance) << label;
      EXPECT_NEAR(c.dampingShare, it->second.second, tolerance) << label;
    }
    EXPECT_EQ(found, expected.size()) << label;
    EXPECT_GT(found, 10u) << label << ": nothing meets, nothing is tested";
  }
};

TEST_F(ContactStep, AStepFromAWildStateAgrees) {
  for (const KernelChoice& kernel :
       {KernelChoice{}, KernelChoice{KernelChoice::Form::automatic, 4},
        KernelChoice{KernelChoice::Form::memory, 70, 2}, KernelChoice{KernelChoice::Form::serial}}) {
    for (const auto& [friction, taper] :
         {std::pair{0.0, ContactTaper::distance}, {0.5, ContactTaper::distance}, {0.5, ContactTaper::time}}) {
      for (const int iterations : {1, 2, 5}) {
        Settings settings = meetingSettings();
        settings.contacts.taper = taper;
        settings.contacts.friction = friction;
        settings.contacts.iterations = iterations;
        settings.contacts.rampSeconds = 0;  // at once in full
        ParityCase c{
            randomGroom({64, 31, 64, 100, 17, 2, 64, 33, 128, 64, 3, 31}, 3), {}, settings, kernel, 5};
        if (!makes(c.kernel, c.groom)) continue;
        const auto errors = oneStepErrors(device(), c);
        const std::string label = fmt::format("{}, {}, friction {}, {} iterations",
                                              kernel.form == KernelChoice::Form::serial   ? "serial"
                                              : kernel.form == KernelChoice::Form::memory ? "memory"
                                                                                          : "lanes",
                                              nameOf(taper), friction, iterations);
        fmt::print("{:<36} {}\n", label, toText(errors));
        for (const FieldError& e : errors)
          EXPECT_LE(e.error, kOneStep) << label << ": " << e.field << "\n" << e.where;
      }
    }
  }
}

// In every form. A shaken swatch: lists live for some steps, are made anew, and grow. Every pair the
// reference finds by its own grid in every step is found, and remembers the same.
TEST_F(ContactStep, FramesAgreeWithDouble) {
  struct Case {
    bool prune;
    KernelChoice kernel;
    ContactTaper taper = ContactTaper::distance;
  };
  const KernelChoice serial{KernelChoice::Form::serial};
  for (const auto& [prune, kernel, taper] :
       {Case{false, {}}, Case{true, {}}, Case{true, {.particlesPerLane = 8}}, Case{true, serial},
        Case{true, {KernelChoice::Form::memory, 9, 4}}, Case{false, serial},
        Case{false, {}, ContactTaper::time}, Case{true, serial, ContactTaper::time}}) {
    Settings settings = meetingSettings();
    settings.contacts.taper = taper;
    settings.contacts.prunePairs = prune;
    settings.contacts.minOverlaps = 20;
    const std::string label = fmt::format("{}, {}", prune ? "pruned" : "all pairs", nameOf(taper));
    const int frames = 12;
    ContactReport report;
    double momentumError = 0;
    const auto worst =
        shakenError(device(), denseSwatch(32), settings, kernel, frames,
                    [&](const Simulation& simulation, const reference::Simulation<double>& reference) {
                      expectSameContacts(simulation, reference, settings.contacts, 1e-5, label);
                      report = *simulation.contactReport();
                      momentumError = reference.report().freeMomentumError;
                    });
    ASSERT_TRUE(worst) << worst.error().message;
    fmt::print(
        "{}: {:.1e} m apart after {} frames; {} contacts, {} listed, {} rebuilds in {} steps, momentum error "
        "{:.3f}\n",
        label, *worst, frames, report.contacts, report.listed, report.rebuilds, 8 * frames,
        report.momentumError);
    EXPECT_LE(*worst, kMeetingMetres);
    EXPECT_NEAR(report.momentumError, momentumError, 1e-4);
  }
}

// Fewer, larger and heavier particles in the dense part of a groom, all of them in the rest.
TEST_F(ContactStep, FramesOfThinnedHairAgreeWithDouble) {
  const Groom groom = bunchAndStrands();
  Settings settings = meetingSettings();
  settings.contacts.radius = 0.0015;  // lists hold all that touches: fewer than 16 neighbours
  const auto particlesWith = [&](double detail) {
    settings.contacts.detail = detail;
    auto simulation = Simulation::create(device(), groom, {}, settings);
    EXPECT_TRUE(simulation) << simulation.error().message;
    return simulation->contactReport()->contactParticles;
  };
  const auto all = particlesWith(1);
  EXPECT_LT(particlesWith(0.5), 0.57 * static_cast<double>(all));
  const int frames = 2;  // and then a pair is within rounding of touching
  const auto worst =
      shakenError(device(), groom, settings, {}, frames,
                  [&](const Simulation& simulation, const reference::Simulation<double>& reference) {
                    expectSameContacts(simulation, reference, settings.contacts, 1e-5, "thinned");
                  });
  ASSERT_TRUE(worst) << worst.error().message;
  fmt::print("{:.1e} m apart after {} frames\n", *worst, frames);
  EXPECT_LE(*worst, kMeetingMetres);
}

// Strands of a bundle pass through each other and meet all others pair by pair. Of the swatch two of three
// strands are in one of two bundles; where it is a volume they leave that.
TEST_F(ContactStep, FramesOfBundlesAgreeWithDouble) {
  const Groom groom = denseSwatch(32);
  std::vector<ContactBundle> bundles(2);
  for (std::uint32_t s = 0; s < groom.strandCount(); ++s)
    if (s % 3 < 2) bundles[s % 3].push_back(s);
  for (const ContactMethod method : {ContactMethod::explicitPairs, ContactMethod::volume}) {
    std::vector<ContactReport> reports;  // without bundles, and with
    for (const bool bundled : {false, true}) {
      Settings settings = meetingSettings();
      settings.contacts.method = method;
      if (bundled) settings.contacts.bundles = std::make_shared<const std::vector<ContactBundle>>(bundles);
      const std::string label = fmt::format("{}{}", nameOf(method), bundled ? ", bundles" : "");
      const auto worst =
          shakenError(device(), groom, settings, {}, 4,
                      [&](const Simulation& simulation, const reference::Simulation<double>& reference) {
                        if (bundled || method == ContactMethod::explicitPairs)
                          expectSameContacts(simulation, reference, settings.contacts, 1e-5, label);
                        reports.push_back(*simulation.contactReport());
                      });
      ASSERT_TRUE(worst) << worst.error().message;
      EXPECT_LE(*worst, kMeetingMetres) << label;
    }
    const ContactReport &before = reports[3], &after = reports.back();
    fmt::print("{}: {} contacts without bundles, {} with; {} and {} strands in the volume\n", nameOf(method),
               before.contacts, after.contacts, before.volumeStrands, after.volumeStrands);
    if (method == ContactMethod::volume) {
      EXPECT_EQ(after.volumeStrands, before.volumeStrands - 8);
    } else {
      EXPECT_LT(after.contacts, 0.9 * static_cast<double>(before.contacts));
    }
  }
}

// Strands that meet because their roots go to each other: each its own way, as those that go together would
// touch or not by rounding. Contacts do not fade here: they end where pairs are further apart than the break
// distance, as slowly as those part.
TEST_F(ContactStep, FramesOfMovingRootsAgreeWithDouble) {
  const Groom groom = denseSwatch(32);
  Settings settings = meetingSettings();
  settings.contacts.taper = ContactTaper::time;
  settings.contacts.stiffnessReleaseSeconds = settings.contacts.dampingReleaseSeconds = 10;
  auto simulation = Simulation::create(device(), groom, {}, settings, {}, {.features = {.roots = true}});
  ASSERT_TRUE(simulation) << simulation.error().message;
  reference::Simulation<double> reference(groom, {}, settings);
  const int frames = 12;
  double worst = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<HeadPose> heads(static_cast<std::size_t>(settings.stepsPerFrame));
    std::vector<BodyPose> roots;
    for (int k = 1; k <= settings.stepsPerFrame; ++k) {
      const double t = frame + double(k) / settings.stepsPerFrame;
      for (std::size_t s = 0; s < groom.strandCount(); ++s) {
        const double way = std::sin(0.4 * t) * std::sin(1.7 * static_cast<double>(s) + 1);
        roots.push_back({Vec3d{0.004, 0, 0.003} * way, fromRotationVector(Vec3d{0.1, 0.3, 0.05} * way)});
      }
    }
    ASSERT_TRUE(simulation->stepFrame(heads, {}, roots));
    reference.stepFrame(heads, {}, roots);
    const auto positions = *simulation->positions();
    for (std::size_t i = 0; i < positions.size(); ++i)
      worst = std::max(worst, (reference::toEigen<double>(positions[i]) - reference.positions()[i]).norm());
    expectSameContacts(*simulation, reference, settings.contacts, 1e-5, "moving roots");
  }
  const auto report = simulation->contactReport();
  ASSERT_TRUE(report) << report.error().message;
  fmt::print("moving roots: {:.1e} m apart after {} frames; {} contacts\n", worst, frames, report->contacts);
  EXPECT_GT(report->contacts, 0u);
  EXPECT_LE(worst, kMeetingMetres);
}

// No two threads decide anything: the same bits however many there are.
TEST_F(ContactStep, RepeatsBitwiseWithAnyNumberOfThreads) {
  const auto run = [](const ComputeDevice& on) {
    auto simulation = Simulation::create(on, denseSwatch(32), {}, meetingSettings());
    EXPECT_TRUE(simulation) << simulation.error().message;
    for (int frame = 1; frame <= 6; ++frame) {
      EXPECT_TRUE(simulation->stepFrame(HeadPose{{0, 0, 0.032 * std::sin(0.5 * frame)}, {}}));
    }
    return std::pair(*simulation->state(), *Diagnostics(*simulation).listedContacts());
  };
  const auto first = run(device()), again = run(device());
  const auto same = [](const auto& x, const auto& y) {
    return std::ranges::equal(x.first.positions, y.first.positions,
                              [](Vec3f a, Vec3f b) { return a.x == b.x && a.y == b.y && a.z == b.z; }) &&
           std::ranges::equal(x.first.velocities, y.first.velocities,
                              [](Vec3f a, Vec3f b) { return a.x == b.x && a.y == b.y && a.z == b.z; }) &&
           std::ranges::equal(x.second, y.second, [](const ListedContact& a, const ListedContact& b) {
             return a.a == b.a && a.b == b.b && a.stiffnessShare == b.stiffnessShare &&
                    a.dampingShare == b.dampingShare;
           });
  };
  EXPECT_TRUE(same(first, again));
  // lavapipe reads its number of threads when a device is opened; others take no notice.
  for (const char* threads : {"1", "2"}) {
    ::setenv("LP_NUM_THREADS", threads, 1);
    const auto other = ComputeDevice::open();
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_TRUE(same(first, run(*other))) << threads << " threads";
  }
  ::unsetenv("LP_NUM_THREADS");
}

// How much room lists begin with decides when a frame stops to make some, and nothing else.
TEST_F(ContactStep, RoomDecidesNothing) {
  Groom groom;  // strands so close that their lists outgrow their first room
  groom.metresPerUnit = 1;
  for (int s = 0; s < 80; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 16; ++i) {
      const double turn = 0.9 * i + s;
      strand.push_back(Vec3f(Vec3d{0.003 * (s % 9) + 0.004 * std::cos(turn), -0.006 * i,
                                   0.003 * (s / 9) + 0.004 * std::sin(turn)}));
    }
    groom.addStrand(strand);
  }
  for (const ContactTaper taper : {ContactTaper::distance, ContactTaper::time}) {
    struct Outcome {
      std::vector<Vec3f> positions;
      ContactReport report;
      std::uint64_t bytesBefore, bytesAfter;
    };
    const auto run = [&](int room) {
      Settings settings = meetingSettings();
      settings.contacts.taper = taper;
      auto simulation = Simulation::create(device(), groom, {}, settings, {}, {.contactRoom = room});
      EXPECT_TRUE(simulation) << simulation.error().message;
      const std::uint64_t before = Diagnostics(*simulation).memory().contactLists;
      for (int frame = 1; frame <= 8; ++frame)
        EXPECT_TRUE(simulation->stepFrame(HeadPose{{0.05 * std::sin(0.7 * frame), 0, 0}, {}}));
      return Outcome{*simulation->positions(), *simulation->contactReport(), before,
                     Diagnostics(*simulation).memory().contactLists};
    };
    const Outcome one = run(1);
    EXPECT_GT(one.bytesAfter, one.bytesBefore) << nameOf(taper) << ": all had room, and nothing is tested";
    for (const int room : {2, 4, 16}) {
      const Outcome other = run(room);
      const std::string label = fmt::format("{}, room x {}", nameOf(taper), room);
      EXPECT_EQ(one.positions, other.positions) << label;
      EXPECT_EQ(one.report.contacts, other.report.contacts) << label;
      EXPECT_EQ(one.report.listed, other.report.listed) << label;
      EXPECT_EQ(one.report.rebuilds, other.report.rebuilds) << label;
      EXPECT_EQ(one.report.pairTests, other.report.pairTests) << label;
    }
  }
}

// Spheres may overlap at rest, in balance with gravity: nothing moves.
TEST_F(ContactStep, TheRestPoseStaysPut) {
  const Groom groom = denseSwatch(48);
  Settings settings = meetingSettings();
  settings.contacts.radius = 0.008;
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  const auto rest = *simulation->positions();
  for (int frame = 0; frame < 48; ++frame) ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const double moved = farthestApart(*simulation->positions(), rest);
  const auto report = *simulation->contactReport();
  fmt::print("moved {:.1e} m in 2 s; {} pairs listed, {} of them contacts\n", moved, report.listed,
             report.contacts);
  EXPECT_GT(report.listed, 1000u);
  EXPECT_LE(moved, kAtRest * 0.56);  // of the arc length
}

}  // namespace
}  // namespace ringlet::test::contact_step_test
