// How a groom is cut into chunks, without a device; and on one, that it does not show: the bits of a groom in
// chunks are those of the same groom in one, and of a strand by itself.
#include "ringlet/solver/plan/groom_chunks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "layout/strands.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"
#include "tests/support/parity.h"
#include "tests/support/sample_bodies.h"

namespace ringlet::test::groom_chunks_test {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20;

TEST(GroomChunks, HoldEveryStrandOnceAndNoMoreThanTheyMay) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t n : {2u, 3u, 16u, 17u, 300u}) counts.insert(counts.end(), 7, n);
  for (const bool taps : {false, true}) {
    for (const bool movingRoots : {false, true}) {
      const GroomRecords records =
          groomRecords({}, {.features = {.roots = movingRoots}, .taps = taps}, {}, true);
      for (std::uint64_t most : {300u * 240u, 100'000u, 1u << 20}) {
        const auto chunks = cutGroom(counts, records, most);
        ASSERT_TRUE(chunks) << chunks.error().message;
        std::uint32_t strand = 0, particle = 0;
        for (const GroomChunk& chunk : *chunks) {
          EXPECT_EQ(chunk.strandBegin, strand);
          EXPECT_EQ(chunk.particleBegin, particle);
          for (; strand < chunk.strandEnd; ++strand) particle += counts[strand];
          EXPECT_EQ(chunk.particleEnd, particle);
          EXPECT_GT(chunk.strandCount(), 0u);
          EXPECT_LE(chunk.particleCount() * (taps ? 128 : 32), most);  // taps or rest, the largest
          EXPECT_LE(chunk.strandCount() * (movingRoots ? 9 * 64 : 112), most);
        }
        EXPECT_EQ(strand, counts.size());
        if (most == kMebibyte) {
          EXPECT_EQ(chunks->size(), 1u);
        }
      }
    }
  }
}

// What a groom of a million strands of 16 comes to where a buffer is 128 MiB.
TEST(GroomChunks, OfAMillionStrandsAreFour) {
  const std::vector<std::uint32_t> counts(1'000'000, 16);
  const auto chunks = cutGroom(counts, groomRecords({}, {}, {}, true), 128 * kMebibyte);
  ASSERT_TRUE(chunks);
  EXPECT_EQ(chunks->size(), 4u);
  EXPECT_EQ(chunks->front().particleCount(), 128 * kMebibyte / 32);
}

TEST(GroomChunks, WhatDoesNotFitIsSaidWithItsNumbers) {
  const GroomRecords records = groomRecords({}, {.taps = true}, {}, true);
  const std::vector<std::uint32_t> counts{10, 10, 5000};
  const auto tooLong = cutGroom(counts, records, 128 * 1000);
  ASSERT_FALSE(tooLong);
  expectParts(tooLong.error().message, {"5000 particles", "0.6 MiB", "0.1 MiB at most"});
  const auto whole = cutGroom(counts, records, 5000 * 128, "contacts");
  ASSERT_FALSE(whole);
  expectParts(whole.error().message,
              {"contacts need the whole groom in one piece", "3 strands of 5020 particles",
               "enough for 5000 particles", "use fewer"});
  EXPECT_TRUE(cutGroom(counts, records, 5020 * 128, "contacts"));
  EXPECT_TRUE(checkMemory("a groom", 100, 100));
  const Status status = checkMemory("a groom of 3 strands", 3 * kMebibyte, kMebibyte);
  ASSERT_FALSE(status);
  expectParts(status.error().message, {"a groom of 3 strands needs 3.0 MiB", "1.0 MiB left", "use fewer"});
}

TEST(GroomChunks, RangesAreCutWhereChunksAre) {
  const std::vector<StrandRange> ranges{{{1, 16}, 0, 5, 16}, {{2, 16}, 5, 9, 32}};
  const std::vector<GroomChunk> chunks{{0, 3, 0, 30}, {3, 6, 30, 70}, {6, 9, 70, 160}};
  const auto pieces = cutRanges(ranges, chunks);
  const auto text = [](const StrandRange& r) {
    return fmt::format("{}:{}-{} of {}", r.chunk, r.begin, r.end, r.longest);
  };
  std::vector<std::string> found;
  for (const StrandRange& piece : pieces) found.push_back(text(piece));
  EXPECT_EQ(found, (std::vector<std::string>{"0:0-3 of 16", "1:0-2 of 16", "1:2-3 of 32", "2:0-3 of 32"}));
  EXPECT_EQ(pieces[2].shape, (StrandShape{2, 16}));
}

HeadPose headAt(double t) {
  return {Vec3d{0.3 * t, 0.4 * t * t, -0.2 * t}, fromRotationVector(Vec3d{0.2, 1.5, -0.4} * (t + 2 * t * t))};
}

class ChunkedGroom : public GpuTest {
 protected:
  struct Case {
    const char* name;
    KernelChoice kernel;
    Settings settings;
    bool bodies = false;
    int longest = 30;  // particles; 16 and fewer are one shape, whose kernel with bodies compiles for seconds
    Material material = varyingMaterial();
  };

  Result<Simulation> make(const Groom& groom, const Case& c) {
    const std::vector<Vec3d> shifts(groom.strandCount(), {0.01, 0, 0.02});
    return Simulation::create(device(), groom, c.material, c.settings,
                              {.head = headAt(0),
                               .oneStepEarlier = headAt(-c.settings.stepSeconds()),
                               .bodies = c.bodies ? sampleBodies() : std::vector<Body>{},
                               .rootShifts = shifts},
                              c.kernel);
  }

  // Three frames from a state at random, roots on ways of their own where they have some; the last jumps.
  HairState moved(const Groom& groom, const Case& c, const HairState& start) {
    auto simulation = make(groom, c);
    EXPECT_TRUE(simulation) << c.name << ": " << simulation.error().message;
    if (!simulation) return {};
    const std::size_t steps = static_cast<std::size_t>(c.settings.stepsPerFrame);
    EXPECT_TRUE(simulation->setState(start));
    for (int frame = 0; frame < 3; ++frame) {
      std::vector<HeadPose> heads;
      std::vector<BodyPose> roots;
      for (std::size_t k = 1; k <= steps; ++k) {
        const double t = (double(frame) * double(steps) + double(k)) * c.settings.stepSeconds();
        heads.push_back(headAt(t));
        heads.back().shift = t;
        if (frame == 2) heads.back().position = heads.back().position + Vec3d{100, 0, 0};
        for (std::size_t s = 0; c.kernel.features.roots && s < groom.strandCount(); ++s) {
          const double way = t * (1 + 0.1 * double(s));
          roots.push_back({Vec3d{0.1 * way, 0.2 * way, 0}, fromRotationVector(Vec3d{way, 0, -way})});
        }
      }
      const Status status = simulation->stepFrame(heads, {}, roots);
      EXPECT_TRUE(status) << status.error().message;
    }
    reports_.push_back(*simulation->report());
    return *simulation->state();
  }

  // Two shapes of lanes, cut within both; the largest buffer, of particles or of roots, in three.
  void expectSameBits(Case c) {
    std::vector<int> counts;
    for (int s = 0; s < 40; ++s) counts.push_back(s % 3 == 0 ? c.longest : s % 3 == 1 ? 9 : 14);
    const Groom groom = randomGroom(counts, 11);
    const HairState start = randomState(groom, c.settings, 5);
    reports_.clear();
    const auto uncut = make(groom, c);
    const HairState whole = moved(groom, c, start);

    const GroomRecords records = groomRecords(c.settings, c.kernel, {}, device().gpu().properties().isCpu);
    const std::uint64_t ofParticles = groom.points.size() * records.particleRest;
    c.kernel.mostBufferBytes = std::max(ofParticles, groom.strandCount() * records.rootPoses) * 2 / 5;
    std::vector<std::uint32_t> sorted(counts.begin(), counts.end());
    std::ranges::sort(sorted);
    ASSERT_GE(cutGroom(sorted, records, c.kernel.mostBufferBytes)->size(), 3u) << c.name;
    const auto cut = make(groom, c);
    const HairState chunked = moved(groom, c, start);

    EXPECT_TRUE(chunked.positions == whole.positions) << c.name;
    EXPECT_TRUE(chunked.velocities == whole.velocities) << c.name;
    EXPECT_FALSE(chunked.positions == start.positions) << c.name;
    ASSERT_EQ(reports_.size(), 2u);
    EXPECT_EQ(reports_[0].maxEdgeStretch, reports_[1].maxEdgeStretch);
    EXPECT_EQ(reports_[0].limitedShare, reports_[1].limitedShare);
    EXPECT_EQ(reports_[0].nonfinite, 0u);
    ASSERT_TRUE(cut && uncut);
    EXPECT_EQ(Diagnostics(*cut).kernels(), Diagnostics(*uncut).kernels());
    EXPECT_EQ(Diagnostics(*cut).memory().total(), Diagnostics(*uncut).memory().total());
  }

  std::vector<SimulationReport> reports_;
};

TEST_F(ChunkedGroom, HasTheBitsOfTheWhole) {
  expectSameBits({"lanes", {}, {}});
  expectSameBits({"memory", {.form = KernelChoice::Form::memory}, {}});
  expectSameBits({"serial", {.form = KernelChoice::Form::serial}, {}});
  Settings paper;
  paper.integrator = Integrator::paper;
  expectSameBits({"paper", {}, paper});
}

TEST_F(ChunkedGroom, HasThemWithRootsThatMove) {
  expectSameBits({"lanes", {.features = {.roots = true}}, {}});
  expectSameBits({"serial", {.form = KernelChoice::Form::serial, .features = {.roots = true}}, {}});
}

TEST_F(ChunkedGroom, HasThemAmongBodiesInAir) {
  Settings airy;
  airy.air.on = true;
  airy.air.turbulence = 1;
  expectSameBits({"lanes", {}, airy, true, 12});
  expectSameBits({"serial", {.form = KernelChoice::Form::serial}, airy, true, 12});
}

// Two at a time, each with its own poses and its own positions.
TEST_F(ChunkedGroom, HasThemInFlight) {
  const Groom groom = randomGroom(std::vector<int>(40, 14), 11);
  const auto framesOf = [&](const Case& c) {
    std::vector<std::vector<Vec3f>> frames;
    auto simulation = make(groom, c);
    EXPECT_TRUE(simulation) << simulation.error().message;
    if (!simulation) return frames;
    for (int frame = 0; frame < 4; ++frame) {
      std::vector<HeadPose> heads;
      for (int k = 1; k <= c.settings.stepsPerFrame; ++k)
        heads.push_back(headAt((frame * c.settings.stepsPerFrame + k) * c.settings.stepSeconds()));
      EXPECT_TRUE(simulation->submitFrame(heads));
      if (frame == 0) continue;
      EXPECT_TRUE(simulation->waitFrame());
      frames.push_back(simulation->framePositions());
    }
    EXPECT_TRUE(simulation->waitFrame());
    frames.push_back(simulation->framePositions());
    return frames;
  };
  const auto whole = framesOf({"whole", {}, {}});
  const auto chunked = framesOf({"chunked", {.mostBufferBytes = 200 * sizeof(layout::ParticleRest)}, {}});
  ASSERT_EQ(whole.size(), 4u);
  EXPECT_TRUE(chunked == whole);
  EXPECT_FALSE(whole[3] == whole[2]);
}

TEST_F(ChunkedGroom, ALimitBelowOneStrandIsRefused) {
  const auto refused = make(randomGroom({9, 30}, 1), {"", {.mostBufferBytes = 29 * 32}, {}});
  ASSERT_FALSE(refused);
  expectParts(refused.error().message, {"a strand of 30 particles needs a buffer"});
}

TEST_F(ChunkedGroom, ContactsAndTapsWantItWhole) {
  const Groom groom = randomGroom(std::vector<int>(40, 20), 3);
  Case contacts{"contacts", {.mostBufferBytes = 400 * 48}, {}};
  contacts.material = {};
  contacts.settings.contacts.on = true;
  auto refused = make(groom, contacts);
  ASSERT_FALSE(refused);
  expectParts(refused.error().message,
              {"contacts need the whole groom in one piece", "40 strands of 800 particles", "400 particles"});
  contacts.kernel.mostBufferBytes = 800 * 48;
  EXPECT_TRUE(make(groom, contacts));
  refused = make(groom, {"taps", {.taps = true, .mostBufferBytes = 799 * 128}, {}});
  ASSERT_FALSE(refused);
  expectParts(refused.error().message, {"taps need the whole groom in one piece"});
}

TEST_F(ChunkedGroom, MoreThanTheDevicesMemoryIsRefusedWithTheNumbers) {
  const Groom groom = randomGroom(std::vector<int>(1000, 20), 3);
  const auto refused = make(groom, {"memory", {.mostDeviceBytes = kMebibyte}, {}, false, 30, {}});
  ASSERT_FALSE(refused);
  // 20,000 x 64 + 1,000 x 136 bytes, and for frames in flight 20,000 x 56; on GPUs 68, and 24 where those
  // come from there too.
  const char* needs = device().gpu().properties().isCpu  ? "needs 2.4 MiB"
                      : gpu::isOneMemory(device().gpu()) ? "needs 1.9 MiB"
                                                         : "needs 1.4 MiB";
  expectParts(refused.error().message,
              {"a groom of 1000 strands and 20000 particles", needs, "1.0 MiB left", "use fewer"});
}

}  // namespace
}  // namespace ringlet::test::groom_chunks_test
