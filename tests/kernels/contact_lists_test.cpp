// The lists of the contact kernels against brute force: exactly the pairs that are near, whatever the input.
// Mirrors shaders/kernels/contact_count.comp to contact_query.comp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "ringlet/solver/simulation.h"
#include "tests/support/gpu_test.h"

namespace ringlet::test {
namespace {

constexpr double kRadius = 0.005, kR = 2 * kRadius;
constexpr double kSkin = 0.15 * kR;  // solver/contact_stage.cpp: lists hold what is within R and the skin

using Points = std::vector<Vec3f>;
using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

class ContactLists : public GpuTest {
 protected:
  // Strands of two particles, far from each other at rest, and then put at `points`, at rest, two by two;
  // after a step so short that what is near is so by place alone.
  Result<Simulation> stepped(const Points& points) {
    Groom groom;
    groom.metresPerUnit = 1;
    const std::size_t strandCount = points.size() / 2;
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(double(strandCount))));
    for (std::size_t s = 0; s < strandCount; ++s) {
      const Vec3f root(
          Vec3d{0.1 * double(s % side), 0.1 * double(s / side % side), 0.1 * double(s / side / side)});
      groom.addStrand(std::vector<Vec3f>{root, root + Vec3f{0, -0.02f, 0}});
    }
    Settings settings;
    settings.framesPerSecond = 1e6;
    settings.stepsPerFrame = 1;
    settings.contacts.on = true;
    settings.contacts.radius = kRadius;
    settings.contacts.prunePairs = false;
    auto simulation = Simulation::create(device(), groom, {}, settings);
    if (!simulation) return simulation;
    if (Status status = simulation->setState({points, Points(points.size())}); !status) return status.error();
    if (Status status = simulation->stepFrame(HeadPose{}); !status) return status.error();
    return simulation;
  }

  Pairs listed(const Points& points) {
    const auto simulation = stepped(points);
    EXPECT_TRUE(simulation) << simulation.error().message;
    Pairs pairs;
    const auto contacts = simulation->listedContacts();
    EXPECT_TRUE(contacts);
    for (const ListedContact& c : *contacts) EXPECT_TRUE(pairs.insert({c.a, c.b}).second);
    return pairs;
  }

  // Every pair of different strands that is nearer than R and the skin, and no other; roots follow the head,
  // and two of them do not meet. Squared distances in float, as the kernel has them; a pair on the edge to
  // the rounding of the bound may be either.
  void expectExact(const Points& points, const std::string& name) {
    const Pairs found = listed(points);
    std::size_t missed = 0, extra = found.size(), near = 0, onEdge = 0;
    const float bound = static_cast<float>(kR + kSkin) * static_cast<float>(kR + kSkin);
    for (std::uint32_t a = 0; a < points.size(); ++a) {
      for (std::uint32_t b = a + 1; b < points.size(); ++b) {
        if (a / 2 == b / 2 || (a % 2 == 0 && b % 2 == 0)) continue;
        const Vec3f d = points[a] - points[b];
        const float squared = d.x * d.x + d.y * d.y + d.z * d.z;
        if (!(squared < bound * 1.00001f)) continue;
        const bool isListed = found.contains({a, b});
        if (squared > bound * 0.99999f) {
          ++onEdge;
          extra -= isListed;
          continue;
        }
        ++near;
        extra -= isListed;
        missed += !isListed;
      }
    }
    fmt::print("{:<34} {:>6} particles, {:>8} pairs, {} on the edge\n", name, points.size(), near, onEdge);
    EXPECT_EQ(missed, 0u) << name;
    EXPECT_EQ(extra, 0u) << name;
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

// 4,000 in one place are 16 million neighbours, more than lavapipe's buffers hold.
TEST_F(ContactLists, MoreThanABufferHoldsIsAnError) {
  if (gpu().properties().maxStorageBufferRange > 128u << 20)
    GTEST_SKIP() << "this device's buffers are larger";
  const auto simulation = stepped(random(4000, {0.004, 0.004, 0.004}));
  ASSERT_FALSE(simulation);
  EXPECT_NE(simulation.error().message.find("128 MiB at most; use a smaller contact radius"),
            std::string::npos)
      << simulation.error().message;
}

// lavapipe ends loops that are too long without a word; pairs would be lost. The user is told instead.
TEST_F(ContactLists, MoreThanADeviceCanLookThroughIsAnError) {
  if (!device().limits().endsLoopsEarly) GTEST_SKIP() << "this device does not end loops early";
  const auto simulation = stepped(random(26000, {0.001, 0.001, 0.001}));
  ASSERT_FALSE(simulation);
  EXPECT_NE(simulation.error().message.find("more contact particles are near one another"), std::string::npos)
      << simulation.error().message;
}

// Positions that are no numbers meet nobody and harm nothing.
TEST_F(ContactLists, LostNumbers) {
  Points points = random(500, {0.1, 0.1, 0.1});
  points[11].x = std::nanf("");
  points[44].y = INFINITY;
  const Pairs pairs = listed(points);
  EXPECT_GT(pairs.size(), 100u);
  for (const auto& [a, b] : pairs) {
    EXPECT_FALSE(a == 11 || b == 11);
    EXPECT_FALSE(a == 44 || b == 44);
  }
}

}  // namespace
}  // namespace ringlet::test
