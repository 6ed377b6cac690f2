// The lists of the contact kernels against brute force: exactly the pairs that are near, whatever the input.
// Mirrors shaders/kernels/contact_count.comp to contact_query.comp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "parity/contacts.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test::contact_lists_test {
namespace {

using namespace parity;
constexpr double kR = kListedR, kSkin = kListedSkin;

using Points = std::vector<Vec3f>;
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class ContactLists : public GpuTest {
 protected:
  static Pairs listed(const Simulation& simulation) {
    Pairs pairs;
    const auto contacts = Diagnostics(simulation).listedContacts();
    EXPECT_TRUE(contacts);
    for (const ListedContact& c : *contacts) EXPECT_TRUE(pairs.insert({c.a, c.b}).second);
    return pairs;
  }

  void expectExact(const Points& points, const std::string& name, const Settings& settings = shortSteps()) {
    const auto lists = compareLists(device(), points, settings);
    ASSERT_TRUE(lists) << lists.error().message;
    fmt::print("{:<34} {:>6} particles, {:>8} pairs, {} on the edge\n", name, points.size(), lists->near,
               lists->onEdge);
    EXPECT_EQ(lists->missed, 0u) << name;
    EXPECT_EQ(lists->extra, 0u) << name;
    EXPECT_EQ(lists->repeated, 0u) << name << ": not once on each side";
  }

  Points random(int count, Vec3d size, Vec3d centre = {}) {
    std::uniform_real_distribution<double> share(-0.5, 0.5);
    Points points;
    for (int i = 0; i < count; ++i)
      points.push_back(
          Vec3f(centre + Vec3d{size.x * share(random_), size.y * share(random_), size.z * share(random_)}));
    return points;
  }
  std::mt19937 random_{7};
};

TEST_F(ContactLists, RandomPoints) {
  for (int count : {2, 4, 30, 1000, 20000}) {
    const double side = 0.012 * std::cbrt(double(count));
    expectExact(random(count, {side, side, side}), "evenly spread");
  }
}

TEST_F(ContactLists, Clusters) {
  Points points;
  for (int cluster = 0; cluster < 40; ++cluster) {
    const Points one = random(100, {0.02, 0.02, 0.02}, Vec3d(random(1, {2, 2, 2})[0]));
    points.insert(points.end(), one.begin(), one.end());
  }
  expectExact(points, "clusters");
}

TEST_F(ContactLists, DegenerateInputs) {
  expectExact(random(600, {0.01, 0.01, 0.01}), "all in one cell");
  expectExact(random(400, {0, 0, 0}), "all in one place");
  expectExact(random(4000, {4, 0, 0}), "all in a line along x");
  expectExact(random(4000, {0, 0, 4}), "all in a line along z");
  expectExact(random(4000, {0.4, 0, 0.4}), "all in a plane");
  expectExact(random(2000, {0.15, 0.15, 0.15}, {1000, -2000, 500}), "two kilometres away");
  expectExact(random(2000, {3000, 3000, 3000}), "kilometres apart");
}

// Which strands may touch is looked up in a table: of all of them, when it is as full as it becomes, and of
// some.
TEST_F(ContactLists, PrunedPairs) {
  Settings settings = shortSteps();
  settings.contacts.prunePairs = true;
  settings.contacts.minOverlaps = 1;
  for (const double enlargement : {100.0, 25.0}) {
    settings.contacts.enlargement = enlargement;
    expectExact(random(258, {0.04, 0.04, 0.04}), fmt::format("129 strands, enlarged {} x", enlargement),
                settings);
  }
}

// Lists are kept while no two particles can have come closer by more than the skin. Tips fly along x,
// either way, a quarter of the skin a step; roots stand, but leap in two of the steps. Whatever the lists are
// from, they hold every pair that may touch in the step.
TEST_F(ContactLists, KeptListsHoldAllThatMayTouch) {
  constexpr std::size_t kStrands = 300;
  constexpr int kSteps = 12;
  const std::set<int> leaps{5, 11};
  Settings settings = shortSteps();
  settings.maxStretch = 100;
  const double T = settings.stepSeconds();
  const Groom groom = farApart(kStrands);
  const auto direction = [&] {
    const Vec3d v(random(1, {2, 2, 2})[0]);
    return v / std::max(length(v), 1e-3);
  };
  HairState state{random(2 * kStrands, {0.1, 0.1, 0.1}), Points(2 * kStrands)};
  std::vector<BodyPose> roots;
  for (std::size_t s = 0; s < kStrands; ++s) {
    roots.push_back({static_cast<Vec3d>(state.positions[2 * s] - groom.strand(s)[0]), {}});
    state.velocities[2 * s + 1] = Vec3f(Vec3d{(s % 2 ? 0.24 : -0.24) * kSkin / T, 0, 0});
  }
  auto simulation = Simulation::create(device(), groom, {}, settings, {.roots = roots, .rootsEarlier = roots},
                                       {.features = {.roots = true}});
  ASSERT_TRUE(simulation) << simulation.error().message;
  ASSERT_TRUE(simulation->setState(state));

  std::size_t due = 0, missed = 0;
  for (int step = 0; step < kSteps; ++step) {
    const HairState start = *simulation->state();
    std::vector<Vec3d>
        velocities;  // of the step without contacts, but for what springs do in so short a time
    for (std::size_t s = 0; s < kStrands; ++s) {
      const Vec3d leap = leaps.contains(step) ? direction() * (1.5 * kSkin) : Vec3d{};
      roots[s].position += leap;
      velocities.push_back(leap / T);
      velocities.push_back(static_cast<Vec3d>(start.velocities[2 * s + 1]));
    }
    ASSERT_TRUE(simulation->stepFrame(std::vector<HeadPose>(1), {}, roots));
    const Pairs found = listed(*simulation);
    for (std::uint32_t a = 0; a < 2 * kStrands; ++a) {
      for (std::uint32_t b = a + 1; b < 2 * kStrands; ++b) {
        if (a / 2 == b / 2 || (a % 2 == 0 && b % 2 == 0)) continue;
        const double apart = length(static_cast<Vec3d>(start.positions[a] - start.positions[b]));
        const double reach = std::min(kR + T * length(velocities[a] - velocities[b]), 2 * kR);
        if (apart > reach - 0.1 * kSkin) continue;
        ++due;
        missed += !found.contains({a, b});
      }
    }
  }
  const std::uint64_t rebuilds = simulation->contactReport()->rebuilds;
  fmt::print("{} steps, {} lists; {} pairs that may touch, {} of them missed\n", kSteps, rebuilds, due,
             missed);
  EXPECT_EQ(missed, 0u);
  EXPECT_GT(rebuilds, 3u);
  EXPECT_LE(rebuilds, kSteps - 4u) << "lists were hardly kept";
}

// Strands closer to each other than two radii: lists are kept for some steps although hair moves far, and yet
// they lack few of the pairs that are nearer than they may be.
TEST_F(ContactLists, InDenseHairFewAreMissedAndListsAreKept) {
  constexpr int kSteps = 48;
  Settings settings = meetingSettings();
  settings.framesPerSecond = 192;
  settings.stepsPerFrame = 1;
  const double R = 2 * *settings.contacts.radius;
  Groom groom;
  groom.metresPerUnit = 1;
  for (int s = 0; s < 100; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < 24; ++i)
      strand.push_back(Vec3f(Vec3d{0.6 * R * (s % 10), -R * i, 0.6 * R * (s / 10)}));
    groom.addStrand(strand);
  }
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  std::size_t due = 0, missed = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const Points start = *simulation->positions();
    ASSERT_TRUE(
        simulation->stepFrame(HeadPose{{0.06 * std::sin(0.08 * step), 0, 0.04 * std::sin(0.13 * step)}, {}}));
    const Pairs found = listed(*simulation);
    for (std::uint32_t a = 0; a < start.size(); ++a) {
      for (std::uint32_t b = 24 * (a / 24 + 1); b < start.size(); ++b) {
        const double apart = length(static_cast<Vec3d>(start[a] - start[b]));
        if (apart > R || (a % 24 < 2 && b % 24 < 2)) continue;
        const double restApart = length(static_cast<Vec3d>(groom.points[a] - groom.points[b]));
        if (apart > std::min(R, restApart - 1e-4 * R) - 0.01 * R) continue;
        ++due;
        missed += !found.contains({a, b});
      }
    }
  }
  const std::uint64_t rebuilds = simulation->contactReport()->rebuilds;
  fmt::print("{} steps, {} lists; {} pairs nearer than they may be, {} of them missed\n", kSteps, rebuilds,
             due, missed);
  EXPECT_GT(due, 10000u);
  EXPECT_LE(missed, due / 100);
  EXPECT_LE(rebuilds, kSteps / 2u) << "lists were hardly kept";
}

// A bunch that meets as a volume, and strands of two particles whose tips fly through it and away, either way
// along x. Of the bunch only who is near them has a list; and whatever the lists are from, they hold all that
// is near enough to act, and nothing that was near before.
TEST_F(ContactLists, BesideAVolume) {
  constexpr std::size_t kStrands = 40, kBunch = 60, kLong = 12;
  constexpr int kSteps = 60;
  Settings settings = shortSteps();
  settings.contacts.method = ContactMethod::automatic;
  settings.maxStretch = 100;
  const double T = settings.stepSeconds();
  Groom groom = farApart(kStrands);
  for (std::size_t s = 0; s < kBunch; ++s) {
    std::vector<Vec3f> strand;
    for (std::size_t i = 0; i < kLong; ++i)
      strand.push_back(Vec3f(Vec3d{-1 + 0.001 * double(s % 8), -kR * double(i), 0.001 * double(s / 8)}));
    groom.addStrand(strand);
  }
  auto simulation = Simulation::create(device(), groom, {}, settings);
  ASSERT_TRUE(simulation) << simulation.error().message;
  ASSERT_EQ(simulation->contactReport()->volumeStrands, kBunch);
  HairState state{groom.points, Points(groom.points.size())};
  const Points places = random(2 * kStrands, {0.15, 0.12, 0.03}, {-1, -0.05, 0});
  for (std::size_t i = 0; i < 2 * kStrands; ++i) state.positions[i] = places[i];
  for (std::size_t s = 0; s < kStrands; ++s)
    state.velocities[2 * s + 1] = Vec3f(Vec3d{(s % 2 ? 0.3 : -0.3) * kR / T, 0, 0});
  ASSERT_TRUE(simulation->setState(state));

  std::size_t due = 0, missed = 0, far = 0, before = 0;
  const auto strandOf = [&](std::size_t i) { return i < 2 * kStrands ? i / 2 : i / kLong; };
  const auto isRoot = [&](std::size_t i) {
    return i < 2 * kStrands ? i % 2 == 0 : (i - 2 * kStrands) % kLong == 0;
  };
  for (int step = 0; step < kSteps; ++step) {
    const Points start = *simulation->positions();
    ASSERT_TRUE(simulation->stepFrame(HeadPose{}));
    const Pairs found = listed(*simulation);
    for (const auto& [a, b] : found)
      far += length(static_cast<Vec3d>(start[a] - start[b])) > 1.02 * (2 * kR + kSkin);
    before = std::max(before, found.size());
    for (std::uint32_t a = 0; a < 2 * kStrands; ++a) {
      for (std::uint32_t b = a + 1; b < start.size(); ++b) {
        if (strandOf(a) == strandOf(b) || (isRoot(a) && isRoot(b))) continue;
        const double ahead = T * length(static_cast<Vec3d>(state.velocities[a] - state.velocities[b]));
        const double reach = std::min(kR + ahead, 2 * kR);
        if (length(static_cast<Vec3d>(start[a] - start[b])) > reach - 0.1 * kSkin) continue;
        ++due;
        missed += !found.contains({a, b});
      }
    }
  }
  fmt::print(
      "{} pairs at the most; {} that may touch in all steps, {} of them missed; {} listed too far apart\n",
      before, due, missed, far);
  EXPECT_GT(due, 1000u);
  EXPECT_EQ(missed, 0u);
  EXPECT_EQ(far, 0u);
}

// 4,000 in one place are 16 million neighbours, more than lavapipe's buffers hold.
TEST_F(ContactLists, MoreThanABufferHoldsIsAnError) {
  if (gpu().properties().maxStorageBufferRange > 128u << 20)
    GTEST_SKIP() << "this device's buffers are larger";
  const auto simulation = stepAt(device(), random(4000, {0.004, 0.004, 0.004}));
  ASSERT_FALSE(simulation);
  EXPECT_NE(simulation.error().message.find("128 MiB at most; use a smaller contact radius"),
            std::string::npos)
      << simulation.error().message;
}

// Some versions of lavapipe end loops that are too long without a word; pairs would be lost. The user is told
// instead. Others look on until the lists are larger than a buffer.
TEST_F(ContactLists, MoreThanADeviceCanLookThroughIsAnError) {
  if (!device().limits().endsLoopsEarly) GTEST_SKIP() << "this device does not end loops early";
  const auto simulation = stepAt(device(), random(26000, {0.001, 0.001, 0.001}));
  ASSERT_FALSE(simulation);
  const std::string& message = simulation.error().message;
  EXPECT_TRUE(message.find("more contact particles are near one another") != std::string::npos ||
              message.find("this device's are 128 MiB at most") != std::string::npos)
      << message;
}

// Positions that are no numbers meet nobody and harm nothing.
TEST_F(ContactLists, LostNumbers) {
  Points points = random(500, {0.1, 0.1, 0.1});
  points[11].x = std::nanf("");
  points[44].y = INFINITY;
  const auto simulation = stepAt(device(), points);
  ASSERT_TRUE(simulation) << simulation.error().message;
  const Pairs pairs = listed(*simulation);
  EXPECT_GT(pairs.size(), 100u);
  for (const auto& [a, b] : pairs) {
    EXPECT_FALSE(a == 11 || b == 11);
    EXPECT_FALSE(a == 44 || b == 44);
  }
}

}  // namespace
}  // namespace ringlet::test::contact_lists_test
