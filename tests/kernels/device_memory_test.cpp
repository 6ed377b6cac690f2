// docs/memory.md's bytes a particle, a strand and a contact, against the buffers there are.
#include <gtest/gtest.h>

#include <bit>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "parity/contacts.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::device_memory_test {
namespace {

class Memory : public GpuTest {
 protected:
  const Groom groom_ = randomGroom(std::vector<int>(50, 20), 3);
  const std::uint64_t strandCount_ = 50, particleCount_ = 1000;

  // A processor's positions are put into the groom's order by the host: from a copy, by no places on the
  // device.
  std::uint64_t ofParticle() { return gpu().properties().isCpu ? 64 : 68; }
  std::uint64_t readBack() { return gpu().properties().isCpu ? 12 + 16 : 12; }

  DeviceMemory of(const Settings& settings, const KernelChoice& kernel, bool bodies = false) {
    const auto simulation = make(settings, kernel, bodies);
    return simulation ? Diagnostics(*simulation).memory() : DeviceMemory{};
  }
  Result<Simulation> make(const Settings& settings, const KernelChoice& kernel = {}, bool bodies = false) {
    auto simulation = Simulation::create(device(), groom_, {}, settings,
                                         {.bodies = bodies ? sampleBodies() : std::vector<Body>{}}, kernel);
    EXPECT_TRUE(simulation) << simulation.error().message;
    return simulation;
  }
};

TEST_F(Memory, OfAParticleAndAStrand) {
  const KernelChoice serial{.form = KernelChoice::Form::serial};
  Settings airy;
  airy.air.on = true;
  const DeviceMemory plain = of({}, {});
  EXPECT_EQ(plain.particles, ofParticle() * particleCount_);
  EXPECT_EQ(plain.strands, 136 * strandCount_);
  EXPECT_EQ(plain.rootPoses + plain.contacts + plain.contactLists, 0u);
  EXPECT_EQ(plain.world, 341u * 48 + sizeof(layout::HairNumbers));
  EXPECT_EQ(plain.frames, 2 * (readBack() * particleCount_ + 341 * 48 + sizeof(layout::HairNumbers)));
  EXPECT_EQ(plain.total(), plain.particles + plain.strands + plain.world + plain.frames);
  for (const KernelChoice& kernel : {KernelChoice{}, serial}) {
    EXPECT_EQ(of({}, kernel).particles, ofParticle() * particleCount_);
    EXPECT_EQ(of({}, kernel, true).particles, ofParticle() * particleCount_)
        << "bodies cost particles nothing";
    EXPECT_EQ(of(airy, kernel).particles, ofParticle() * particleCount_);
  }
  const DeviceMemory moving = of({}, {.features = {.roots = true}});
  EXPECT_EQ(moving.rootPoses, 64 * (8 + 1) * strandCount_);
  EXPECT_EQ(moving.frames, plain.frames + 2 * moving.rootPoses);
  const DeviceMemory pulled = of({}, {.features = {.forces = true}});
  EXPECT_EQ(pulled.particles, plain.particles + 16 * particleCount_);
  EXPECT_EQ(pulled.frames, plain.frames + 2 * 16 * particleCount_);
  EXPECT_EQ(of({}, {.taps = true}).particles, (ofParticle() + 128) * particleCount_);
}

TEST_F(Memory, OfContacts) {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  auto simulation = make(settings);
  ASSERT_TRUE(simulation);
  const DeviceMemory memory = Diagnostics(*simulation).memory();
  EXPECT_EQ(memory.particles, (ofParticle() + 64) * particleCount_);
  const std::uint64_t contacts = simulation->contactReport()->contactParticles;
  ASSERT_GT(contacts, 0u);
  // A contact particle: 140 and two buckets of 8 or more, up to twice as many; a particle 20; a strand 16,
  // and up to 16 for each it may touch.
  const std::uint64_t buckets = std::bit_ceil(std::max<std::uint64_t>(2 * contacts, 1024));
  const std::uint64_t least = 140 * contacts + 8 * buckets + 20 * particleCount_ + 16 * strandCount_;
  const std::uint64_t pairs = simulation->contactReport()->pairs;
  EXPECT_GE(memory.contacts, least);
  EXPECT_LE(memory.contacts, least + 16 * 2 * pairs + 16 * strandCount_ + buckets / 256 + 8);
  // Lists begin with a block of 16 pairs of 16 bytes a contact particle, and 44 to find them; with the time
  // taper with one contact of 64 more, and 40.
  EXPECT_EQ(memory.contactLists, contacts * (16 * 16 + 44));
  settings.contacts.taper = ContactTaper::time;
  auto timed = make(settings);
  ASSERT_TRUE(timed);
  EXPECT_EQ(Diagnostics(*timed).memory().contactLists,
            contacts * (16 * 16 + 44 + 40) + (contacts / 4 + 1) * 4 * 64);
}

// A particle of the volume: 236; a cell 28.
TEST_F(Memory, OfAVolume) {
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::volume;
  auto simulation = make(settings);
  ASSERT_TRUE(simulation);
  const DeviceMemory memory = Diagnostics(*simulation).memory();
  EXPECT_EQ(memory.particles, (ofParticle() + 32) * particleCount_);
  EXPECT_EQ(memory.contacts + memory.contactLists, 0u);
  EXPECT_GT(memory.volume, 28u << 10);  // a block of cells at the least
  EXPECT_LT(memory.volume, 240 * particleCount_ + (28u << 21) + (64u << 10));
}

// Contacts between pairs beside it: two buckets of 16.
TEST_F(Memory, OfContactsBesideAVolume) {
  const Groom groom = parity::bunchAndStrands();
  Settings settings = parity::meetingSettings();
  settings.contacts.method = ContactMethod::automatic;
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  ASSERT_EQ(simulation->contactReport()->volumeStrands, 60u);
  const std::uint64_t contacts = simulation->contactReport()->contactParticles;
  const std::uint64_t buckets = std::bit_ceil(std::max<std::uint64_t>(2 * contacts, 1024));
  const std::uint64_t expected =
      140 * contacts + 16 * buckets + 20 * groom.points.size() + 16 * groom.strandCount();
  EXPECT_GE(Diagnostics(*simulation).memory().contacts, expected);
  EXPECT_LE(Diagnostics(*simulation).memory().contacts,
            expected + buckets / 256 + 64 + sizeof(layout::ContactNumbers));
}

// Lists as long as hair that lies in itself makes them: 16 bytes a pair and side, and a part that is empty.
TEST_F(Memory, OfListedContacts) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 200; ++s) {
    const double x = 0.0002 * (s % 20), z = 0.0002 * (s / 20);
    std::vector<Vec3f> strand;
    for (int i = 0; i < 8; ++i) strand.push_back(Vec3f(Vec3d{x, -0.002 * i, z}));
    groom.addStrand(strand);
  }
  Settings settings;
  settings.contacts.on = true;
  settings.contacts.method = ContactMethod::explicitPairs;
  settings.contacts.radius = 0.001;
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  const std::uint64_t before = Diagnostics(*simulation).memory().contactLists;
  ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
  const auto report = simulation->contactReport();
  ASSERT_TRUE(report);
  const std::uint64_t after = Diagnostics(*simulation).memory().contactLists;
  EXPECT_GT(after, before) << "lists had to grow";
  const std::uint64_t filled = 2 * 16 * report->listed;
  EXPECT_GE(after, filled);
  EXPECT_LE(after, 2 * filled + 600 * report->contactParticles);
  RecordProperty("bytes", std::to_string(after));
}

}  // namespace
}  // namespace ringlet::test::device_memory_test
