// KernelChoice::link: hair in contact whose strands several devices step has the bits that it has on one.
#include "ringlet/solver/divided/divided_hair.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "ringlet/groom/generate.h"
#include "ringlet/rest/rest_part.h"
#include "ringlet/solver/contacts/sampled_contacts.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/shared_link.h"
#include "tests/kernels/sample_hairs.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::divided_hair_test {
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
    if (frame == 3 && hair.settings.integrator == Integrator::jacobi) {
      Material other = simulation->material();
      other.bendStiffness *= 2;
      if (Status set = simulation->setMaterial(other); !set) return set.error();
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

// The same in parts, each on a thread and a device of its own. `rooms`: KernelChoice::contactRoom of each.
std::vector<Result<Outcome>> runParts(const Hair& hair, const Parts& parts,
                                      const std::vector<int>& rooms = {}) {
  const auto links = SharedLink::connect(parts);
  std::vector<Result<Outcome>> outcomes(parts.size(), Error{"did not run"});
  std::vector<std::jthread> threads;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    threads.emplace_back([&, k] {
      const auto device = ComputeDevice::open();
      if (!device) return;
      Hair own = hair;
      own.kernel.link = links[k].get();
      if (!rooms.empty()) own.kernel.contactRoom = rooms[k];
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

// Strands of two lengths, closer to each other than two radii, whose lists are kept as long as a sample says
// so.
Hair dense(ContactTaper taper) {
  Hair hair{"dense", {}};
  hair.groom.metresPerUnit = 1;
  for (int s = 0; s < 48; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < (s % 2 ? 16 : 11); ++i)
      strand.push_back(Vec3f(Vec3d{0.006 * (s % 8), -0.01 * i, 0.006 * (s / 8)}));
    hair.groom.addStrand(strand);
  }
  hair.settings.contacts.on = true;
  hair.settings.contacts.method = ContactMethod::explicitPairs;
  hair.settings.contacts.radius = 0.005;
  hair.settings.contacts.taper = taper;
  hair.settings.contacts.prunePairs = true;
  hair.settings.contacts.minOverlaps = 2;
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
  // Of 7 steps a frame, the frame before the checkpoint ends between two sorts of the volume.
  Hair between{
      "between sorts",
      *makeSwatch({.curl = {.particleCount = 16}, .columnCount = 5, .rowCount = 4, .spacing = 0.006})};
  between.settings.contacts.on = true;
  between.settings.contacts.method = ContactMethod::volume;
  between.settings.stepsPerFrame = 7;
  all.push_back(std::move(between));
  HeadParameters head{.strandCount = 60};
  head.curl.particleCount = 24;
  for (const ContactMethod method : {ContactMethod::explicitPairs, ContactMethod::volume}) {
    Hair worn{"on a body, in wind", *makeHead(head)};
    worn.settings.contacts.on = true;
    worn.settings.contacts.method = method;
    worn.settings.contacts.prunePairs = true;
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
    const std::uint32_t last = static_cast<std::uint32_t>(hair.groom.strandCount()) - 3;
    const Parts halves = partsBy(hair.groom, 2, [&](std::uint32_t s) { return s < last ? 0 : 1; });
    const Parts thirds = partsBy(hair.groom, 3, [](std::uint32_t s) { return s % 3; });
    std::vector<Parts> divisions{halves, thirds};
    if (hair.name == std::string_view("mixed"))  // the last four strands are in no volume
      divisions.push_back(partsBy(hair.groom, 2, [](std::uint32_t s) { return s < 60 ? 0 : 1; }));
    for (const Parts& parts : divisions) {
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
      EXPECT_EQ(contacts->volumeCut, whole->contacts.volumeCut);
      EXPECT_EQ(contacts->volumeLargest, whole->contacts.volumeLargest);
      EXPECT_NEAR(contacts->momentumError, whole->contacts.momentumError, 1e-9);
      EXPECT_NEAR(contacts->momentum.sizes, whole->contacts.momentum.sizes,
                  1e-9 * whole->contacts.momentum.sizes);
    }
  }
}

// A part whose lists find no room repeats its step, with what the others told it before: here of long strands
// that swing further than those it knows.
TEST_F(DividedHair, APartMayRunOutOfRoomAlone) {
  for (const ContactTaper taper : {ContactTaper::distance, ContactTaper::time}) {
    Hair hair = dense(taper);
    for (Vec3f& p : hair.groom.points)
      p = Vec3f{0.3f * p.x, p.y, 0.3f * p.z};  // more near each than room is for
    for (int s = 0; s < 12; ++s) {
      std::vector<Vec3f> strand;
      for (int i = 0; i < 30; ++i)
        strand.push_back(Vec3f(Vec3d{1 + 0.004 * (s % 4), -0.01 * i, 0.004 * (s / 4)}));
      hair.groom.addStrand(strand);
    }
    const auto whole = run(device(), hair);
    ASSERT_TRUE(whole) << whole.error().message;
    const Parts parts = partsBy(hair.groom, 3, [](std::uint32_t s) { return s < 48 ? s % 2 : 2; });
    for (std::size_t without = 0; without < 3; ++without) {
      SCOPED_TRACE(without);
      std::vector<int> rooms(3, 64);
      rooms[without] = 1;
      const auto outcomes = runParts(hair, parts, rooms);
      ContactReport contacts;
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(outcomes[k]) << outcomes[k].error().message;
        EXPECT_EQ(outcomes[k]->contacts.rebuilds, whole->contacts.rebuilds) << k;
        contacts.add(outcomes[k]->contacts);
        for (int frame = 0; frame < kFrames; ++frame)
          EXPECT_EQ(differentPoints(hair.groom, parts[k], outcomes[k]->frames[frame], whole->frames[frame]),
                    0)
              << "part " << k << ", frame " << frame;
      }
      EXPECT_EQ(contacts.listed, whole->contacts.listed);
      EXPECT_EQ(contacts.contacts, whole->contacts.contacts);
      EXPECT_EQ(contacts.pairTests, whole->contacts.pairTests);
    }
  }
}

// Strands that are apart at rest and put into one place part along y, the first of the groom upwards, also if
// another part steps it.
TEST_F(DividedHair, PartsWhatIsInOnePlaceAsTheWholeDoes) {
  Hair hair{"in one place", {}};
  hair.groom.metresPerUnit = 1;
  std::vector<Vec3f> hanging;
  for (int s = 0; s < 4; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 8; ++i) strand.push_back(Vec3f(Vec3d{0.02 * s, -0.01 * i, 0}));
    hair.groom.addStrand(strand);
    hanging.insert(hanging.end(), strand.begin(), strand.end());
  }
  hair.settings.contacts.on = true;
  hair.settings.contacts.method = ContactMethod::explicitPairs;
  hair.settings.contacts.radius = 0.005;
  HairState inOnePlace{hanging, std::vector<Vec3f>(hanging.size())};
  for (std::size_t k = 8; k < hanging.size(); ++k)
    if (k % 8 > 2) inOnePlace.positions[k] = hanging[k % 8];
  const auto stepped = [&](const ComputeDevice& device, const Hair& own) -> Result<HairState> {
    const auto asset = build(device, own);
    if (!asset) return asset.error();
    auto simulation = make(*asset, own, kHeads[0]);
    if (!simulation) return simulation.error();
    if (Status put = simulation->setState(inOnePlace); !put) return put.error();
    if (Status done = simulation->stepFrame(kHeads[0].at(0)); !done) return done.error();
    return simulation->state();
  };
  const auto whole = stepped(device(), hair);
  ASSERT_TRUE(whole) << whole.error().message;
  const Parts parts{{1, 3}, {0, 2}};
  const auto links = SharedLink::connect(parts);
  std::vector<Result<HairState>> states(2, Error{"did not run"});
  std::vector<std::jthread> threads;
  for (std::size_t k = 0; k < 2; ++k) {
    threads.emplace_back([&, k] {
      const auto device = ComputeDevice::open();
      if (!device) return;
      Hair own = hair;
      own.kernel.link = links[k].get();
      states[k] = stepped(*device, own);
      if (!states[k]) links[k]->fail(states[k].error());
    });
  }
  threads.clear();
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_TRUE(states[k]) << states[k].error().message;
    EXPECT_EQ(differentPoints(hair.groom, parts[k], *states[k], *whole), 0) << "part " << k;
  }
}

// All parts together sample what undivided hair does.
TEST(SampledContacts, AreThoseOfTheWhole) {
  HeadParameters head{.strandCount = 40};
  head.curl.particleCount = 20;
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = 0.002;  // few may touch, and no part knows all
  settings.contacts.prunePairs = true;
  const auto rest = buildRestState(*makeHead(head), {}, settings);
  ASSERT_TRUE(rest);
  const RestContacts whole = buildRestContacts(*rest, settings.contacts);
  std::vector<std::size_t> partOf;
  for (std::size_t s = 0; s < rest->strands.size(); ++s) partOf.push_back(s * s % 3);
  for (const std::uint32_t stride : {1u, 7u, 32u}) {
    std::vector<int> sampled(whole.particles.particles.size());
    for (std::size_t own = 0; own < 3; ++own) {
      RestState state = *rest;
      RestContacts contacts = whole;
      std::optional<RestVolume> none;
      RestHalo halo = haloOf(whole, partOf, own);
      restrictTo({state, contacts, none}, halo);
      EXPECT_LT(contacts.inWhole.size(), sampled.size());
      const auto [list, most] = sampledContacts(contacts, hereCount(state), stride);
      for (std::uint32_t r = 0; r < stride; ++r) {
        EXPECT_LE(list[r + 1] - list[r], most);
        for (std::uint32_t k = list[r]; k < list[r + 1]; ++k) {
          EXPECT_EQ(contacts.inWhole[list[k]] % stride, r);
          ++sampled[contacts.inWhole[list[k]]];
        }
      }
    }
    EXPECT_EQ(sampled, std::vector<int>(sampled.size(), 1)) << "stride " << stride;
  }
}

// Calls act(part) on a thread for each of three linked parts.
void onLinks(const std::function<void(PartLink&)>& act) {
  const auto links = SharedLink::connect(Parts{{0}, {1}, {2}});
  std::vector<std::jthread> threads;
  for (const auto& link : links) threads.emplace_back([&] { act(*link); });
}

TEST(SharedLink, SumsAndFindsTheLargest) {
  onLinks([](PartLink& link) {
    const auto own = static_cast<std::int32_t>(link.own());
    std::vector<std::uint32_t> sums{10u + static_cast<std::uint32_t>(own), 0xffffffffu};
    std::vector<std::int32_t> largest{own, -own, -5};
    EXPECT_TRUE(link.sum(sums));
    EXPECT_TRUE(link.largest(largest));
    EXPECT_EQ(sums, (std::vector<std::uint32_t>{33, 0xfffffffdu}));
    EXPECT_EQ(largest, (std::vector<std::int32_t>{2, 0, -5}));
  });
}

// Parts 0 and 2 are neighbours of part 1 only.
TEST(SharedLink, BringsMessagesToThePartTheyAreFor) {
  onLinks([](PartLink& link) {
    const std::size_t own = link.own();
    std::vector<PartLink::Message> messages;
    std::vector<std::vector<std::byte>> out, in;
    for (const std::size_t part : own == 1 ? std::vector<std::size_t>{0, 2} : std::vector<std::size_t>{1}) {
      out.push_back({std::byte(10 * own + part), std::byte(7)});
      in.emplace_back(2);
      messages.push_back({part, out.back(), in.back()});
    }
    EXPECT_TRUE(link.exchange(messages));
    for (std::size_t k = 0; k < messages.size(); ++k)
      EXPECT_EQ(in[k], (std::vector{std::byte(10 * messages[k].part + own), std::byte(7)}));
  });
}

TEST(SharedLink, TellsAllThatAPartHasFailed) {
  onLinks([](PartLink& link) {
    std::vector<std::uint32_t> sums{1};
    if (link.own() == 1)
      link.fail(Error{"its device was lost"});
    else
      EXPECT_FALSE(link.sum(sums));
  });
}

// A part of hair in pairs knows its halo and not the whole; of hair as a volume alone it knows its own.
TEST_F(DividedHair, KnowsItsHaloOnly) {
  Groom row;
  row.metresPerUnit = 1;
  for (int s = 0; s < 30; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 12; ++i) strand.push_back(Vec3f(Vec3d{0.004 * s, -0.01 * i, 0}));
    row.addStrand(strand);
  }
  const auto bytesOf = [&](ContactMethod method, const Parts& parts) {
    Hair hair{"row", row};
    hair.settings.contacts.on = true;
    hair.settings.contacts.method = method;
    hair.settings.contacts.radius = 0.003;
    hair.settings.contacts.prunePairs = true;
    hair.settings.contacts.minOverlaps = 1;
    const auto links = SharedLink::connect(parts);
    hair.kernel.link = links.size() > 1 ? links[0].get() : nullptr;
    const auto asset = build(device(), hair);
    EXPECT_TRUE(asset) << asset.error().message;
    auto simulation = make(*asset, hair, kHeads[0]);
    EXPECT_TRUE(simulation) << simulation.error().message;
    return Diagnostics(*simulation).memory();
  };
  const Parts whole{{}};
  const Parts thirds = partsBy(row, 3, [](std::uint32_t s) { return s / 10; });
  for (const ContactMethod method : {ContactMethod::explicitPairs, ContactMethod::volume}) {
    const DeviceMemory all = bytesOf(method, whole), third = bytesOf(method, thirds);
    const double known = method == ContactMethod::volume ? 10 : 12;  // of 30 strands; two are the halo
    EXPECT_NEAR(static_cast<double>(third.particles), known / 30 * static_cast<double>(all.particles),
                0.02 * static_cast<double>(all.particles));
  }
}

}  // namespace
}  // namespace ringlet::test::divided_hair_test
