// KernelChoice::link: hair in contact whose strands several devices step has the bits that it has on one.
#include "ringlet/solver/divided_hair.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/solver/shared_link.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {
namespace {

using Parts = std::vector<std::vector<std::uint32_t>>;

// Strand s is in part partOf(s).
template <class PartOf>
Parts partsBy(const Groom& groom, std::size_t count, const PartOf& partOf) {
  Parts parts(count);
  for (std::uint32_t s = 0; s < groom.strandCount(); ++s) parts[partOf(s)].push_back(s);
  return parts;
}

struct Outcome {
  std::vector<HairState> frames;
  ContactReport contacts;
  SimulationReport report;
};

constexpr int kFrames = 6;

// Frames in which the head goes its way, numbers change, the head jumps with a turn, and a checkpoint is put
// back.
Result<Outcome> run(const ComputeDevice& device, const Hair& hair) {
  const Head& head = kHeads[0];
  const auto asset = build(device, hair);
  if (!asset) return asset.error();
  auto simulation = make(*asset, hair, head);
  if (!simulation) return simulation.error();
  Outcome outcome;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame == 2) {
      Settings other = hair.settings;
      other.gravity = {2, -5, 1};
      if (Status set = simulation->setSettings(other); !set) return set.error();
    }
    std::vector<HeadPose> poses;
    for (int k = 1; k <= hair.settings.stepsPerFrame; ++k) {
      poses.push_back(head.at((frame + double(k) / hair.settings.stepsPerFrame) / 24));
      if (frame >= 4) poses.back().position.x += 100;
    }
    if (Status stepped = simulation->stepFrame(poses); !stepped) return stepped.error();
    auto state = simulation->state();
    if (!state) return state.error();
    outcome.frames.push_back(std::move(*state));
    if (frame == 2) {
      const auto kept = simulation->checkpoint();
      if (!kept) return kept.error();
      if (Status stepped = simulation->stepFrame(poses); !stepped) return stepped.error();
      if (Status back = simulation->restore(*kept); !back) return back.error();
    }
  }
  const auto contacts = simulation->contactReport();
  if (!contacts) return contacts.error();
  outcome.contacts = *contacts;
  const auto report = simulation->report();
  if (!report) return report.error();
  outcome.report = *report;
  return outcome;
}

// The same in parts, each on a thread and a device of its own.
std::vector<Result<Outcome>> runParts(const Hair& hair, const Parts& parts) {
  const auto links = SharedLink::connect(parts);
  std::vector<Result<Outcome>> outcomes(parts.size(), Error{"did not run"});
  std::vector<std::jthread> threads;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    threads.emplace_back([&, k] {
      const auto device = ComputeDevice::open();
      if (!device) return;
      Hair own = hair;
      own.kernel.link = links[k].get();
      outcomes[k] = run(*device, own);
      if (!outcomes[k]) links[k]->fail(outcomes[k].error());
      expectNoMessages(*device->gpu().validationLog());
    });
  }
  threads.clear();
  return outcomes;
}

int differentPoints(const Groom& groom, const std::vector<std::uint32_t>& strands, const HairState& a,
                    const HairState& b) {
  int different = 0;
  for (const std::uint32_t s : strands) {
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      different += !(a.positions[i] == b.positions[i]) || !(a.velocities[i] == b.velocities[i]);
  }
  return different;
}

// Strands closer to each other than two radii, whose lists are kept as long as a sample says so.
Hair dense(ContactTaper taper) {
  Hair hair{"dense", {}};
  hair.groom.metresPerUnit = 1;
  for (int s = 0; s < 48; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 16; ++i) strand.push_back(Vec3f(Vec3d{0.006 * (s % 8), -0.01 * i, 0.006 * (s / 8)}));
    hair.groom.addStrand(strand);
  }
  hair.settings.contacts.on = true;
  hair.settings.contacts.method = ContactMethod::explicitPairs;
  hair.settings.contacts.radius = 0.005;
  hair.settings.contacts.taper = taper;
  return hair;
}

std::vector<Hair> hairsInContact() {
  std::vector<Hair> all;
  for (Hair& hair : hairs())
    if (hair.settings.contacts.on) all.push_back(std::move(hair));
  all.push_back(dense(ContactTaper::distance));
  all.push_back(dense(ContactTaper::time));
  Hair mixed{"mixed", parity::bunchAndStrands()};
  mixed.settings.contacts.on = true;
  all.push_back(std::move(mixed));
  HeadParameters head{.strandCount = 60};
  head.curl.particleCount = 24;
  for (const ContactMethod method : {ContactMethod::explicitPairs, ContactMethod::volume}) {
    Hair worn{"on a body, in wind", *makeHead(head)};
    worn.settings.contacts.on = true;
    worn.settings.contacts.method = method;
    worn.settings.air.on = true;
    worn.bodies.push_back({.radius = 0.1});
    all.push_back(std::move(worn));
  }
  return all;
}

class DividedHair : public GpuTest {};

TEST_F(DividedHair, HasTheBitsOfTheWhole) {
  for (const Hair& hair : hairsInContact()) {
    SCOPED_TRACE(hair.name);
    const auto whole = run(device(), hair);
    ASSERT_TRUE(whole) << whole.error().message;
    const Parts halves = partsBy(hair.groom, 2, [](std::uint32_t s) { return s < 3 ? 0 : 1; });
    const Parts thirds = partsBy(hair.groom, 3, [](std::uint32_t s) { return s % 3; });
    for (const Parts& parts : {halves, thirds}) {
      const auto outcomes = runParts(hair, parts);
      std::optional<ContactReport> contacts;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        SCOPED_TRACE(testing::Message() << "part " << k << " of " << parts.size());
        ASSERT_TRUE(outcomes[k]) << outcomes[k].error().message;
        for (int frame = 0; frame < kFrames; ++frame)
          EXPECT_EQ(differentPoints(hair.groom, parts[k], outcomes[k]->frames[frame], whole->frames[frame]),
                    0)
              << "frame " << frame;
        EXPECT_EQ(outcomes[k]->contacts.rebuilds, whole->contacts.rebuilds);
        EXPECT_LE(outcomes[k]->report.maxEdgeStretch, whole->report.maxEdgeStretch);
        EXPECT_EQ(outcomes[k]->report.nonfinite, 0u);
        if (contacts)
          contacts->add(outcomes[k]->contacts);
        else
          contacts = outcomes[k]->contacts;
      }
      EXPECT_EQ(contacts->listed, whole->contacts.listed);
      EXPECT_EQ(contacts->contacts, whole->contacts.contacts);
      EXPECT_EQ(contacts->pairTests, whole->contacts.pairTests);
      EXPECT_NEAR(contacts->momentumError, whole->contacts.momentumError, 1e-9);
      EXPECT_NEAR(contacts->momentum.sizes, whole->contacts.momentum.sizes,
                  1e-9 * whole->contacts.momentum.sizes);
    }
  }
}

// Whether lists stay is asked of a sample of all strands, not of those of a part.
TEST_F(DividedHair, SumsWhatAllPartsSampled) {
  const Hair hair = dense(ContactTaper::distance);
  const auto rest = buildRestState(hair.groom, varyingMaterial(), hair.settings);
  ASSERT_TRUE(rest) << rest.error().message;
  const auto rows =
      gpu::Buffer::create(device().gpu(), 16 * rest->points.size(), gpu::BufferKind::storage, "rows");
  ASSERT_TRUE(rows) << rows.error().message;
  const ringlet::DividedHair::Fields fields{{{&*rows}}, {{&*rows}}};
  const auto links = SharedLink::connect(partsBy(hair.groom, 3, [](std::uint32_t s) { return s % 3; }));
  std::vector<ringlet::DividedHair> parts;
  for (const auto& link : links) {
    auto made = ringlet::DividedHair::create(device().gpu(), *rest, *link, fields, {}, {});
    ASSERT_TRUE(made) << made.error().message;
    parts.push_back(std::move(*made));
  }
  std::vector<Result<ContactStage::Sample>> sums(3, Error{"did not run"});
  std::vector<std::jthread> threads;
  for (std::uint32_t k = 0; k < 3; ++k)
    threads.emplace_back([&, k] { sums[k] = parts[k].sum({.sampled = 10 + k, .missed = 2 * k}); });
  threads.clear();
  for (const auto& sum : sums) {
    ASSERT_TRUE(sum) << sum.error().message;
    EXPECT_EQ(sum->sampled, 33u);
    EXPECT_EQ(sum->missed, 6u);
  }
}

}  // namespace
}  // namespace ringlet::test
