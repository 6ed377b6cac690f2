// Hairs that follow guides: the device against the reference, over grooms of every kind that makes a core.
#include "ringlet/follow/follow_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "embedded_modules.h"
#include "layout/hair_points.h"
#include "parity/sample_bodies.h"
#include "parity/tolerances.h"
#include "reference/follow_guide.h"
#include "ringlet/follow/core_weights.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "tests/support/gpu_test.h"
#include "tests/support/kernel_inputs.h"

namespace ringlet::test::follow_stage_test {
namespace {

using Strand = std::vector<Vec3d>;

// Hanging from y = 0: a helix of so many turns (none: straight) of a radius that grows from the root.
Strand strandOf(int particles, double length, double turns, double radius, Vec3d root) {
  Strand strand;
  for (int i = 0; i < particles; ++i) {
    const double s = static_cast<double>(i) / (particles - 1), angle = 2 * std::numbers::pi * turns * s;
    const double r = radius * std::min(1.0, 4 * s);
    strand.push_back(root + Vec3d{r * std::cos(angle), -length * s, r * std::sin(angle)});
  }
  return strand;
}

struct Guides {
  std::string name;
  std::vector<Strand> strands;
};

// Curls, waves, straight hair, two particles, and all of them in one groom.
std::vector<Guides> allGuides() {
  std::vector<Guides> all;
  const auto add = [&](const char* name, int particles, double turns, double radius) {
    Guides guides{name, {}};
    for (int s = 0; s < 9; ++s)
      guides.strands.push_back(
          strandOf(particles, 0.2 + 0.01 * s, turns, radius, {0.02 * (s % 3), 0.001 * s, 0.02 * (s / 3)}));
    all.push_back(guides);
  };
  add("curls", 64, 8, 0.008);
  add("coarse curls", 20, 3, 0.01);
  add("long curls", 300, 20, 0.006);
  add("straight", 33, 0, 0);
  add("two particles", 2, 0, 0);
  Guides mixed{"mixed", {}};
  for (const Guides& guides : all)
    for (std::size_t s = 0; s < 3; ++s) mixed.strands.push_back(guides.strands[3 * s + all.size() % 3]);
  all.push_back(mixed);
  return all;
}

const Quatd kTurned = normalized(Quatd{0.2, -0.5, 0.3, 0.8});

// On a head that has turned and moved, each strand swung aside.
Strand posed(const Strand& rest) {
  Strand pose;
  for (const Vec3d& p : rest) {
    const double drop = std::max(0.0, rest.front().y - p.y), angle = 4 * drop;
    pose.push_back(rotate(kTurned, p + Vec3d{drop * std::sin(angle), drop * (1 - std::cos(angle)), 0}) +
                   Vec3d{0.3, -0.2, 0.1});
  }
  return pose;
}

struct Plan {
  std::vector<GuideRest> guides;
  std::vector<FollowHair> hairs;
  OwnPoints own{};

  std::size_t pointCount(std::size_t hair) const { return pointCountOf(hairs[hair], guides, own.of(hair)); }
};

Plan planOf(const Guides& guides, int hairCount, double blend = 0) {
  Plan plan;
  for (const Strand& strand : guides.strands) plan.guides.push_back(restOfGuide(strand));
  plan.hairs = *planHairs(plan.guides, {.hairCount = hairCount, .blend = blend});
  return plan;
}

// Each hair with two points up to more than its guide has, some way beside where the guide alone would have
// them, some of them in one place.
OwnPoints anyOwnPoints(const Plan& plan) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> shift(-0.004f, 0.004f), step(0, 1);
  OwnPoints own{.firstPoint = {0}, .points = {}};
  for (std::size_t h = 0; h < plan.hairs.size(); ++h) {
    const auto last = static_cast<float>(plan.guides[plan.hairs[h].guide].arcs.size() - 1);
    const std::size_t count = 2 + 7 * h % 90;
    std::vector<float> steps{0};
    for (std::size_t i = 1; i < count; ++i)
      steps.push_back(steps.back() + std::max(step(random) - 0.1f, 0.f));
    for (const float at : steps)
      own.points.push_back({.shift = {shift(random), shift(random), shift(random)},
                            .along = last * plan.hairs[h].length * at / std::max(steps.back(), 0.1f)});
    own.firstPoint.push_back(static_cast<std::uint32_t>(own.points.size()));
  }
  return own;
}

// The same hairs as they are, and with points of their own.
std::vector<Plan> bothOf(const Plan& plan) {
  std::vector<Plan> both{plan, plan};
  both[1].own = anyOwnPoints(plan);
  return both;
}

struct Met {
  std::vector<Body> bodies;
  std::vector<BodyPose> poses;
  std::vector<std::vector<Vec3d>> points{};  // of those that bend, seen from what carries them
};

// Whether a hair's edge from point i on crosses a cut of its guide.
bool isCutAfter(const Plan& plan, const std::vector<std::uint32_t>& cutBeyond, std::uint32_t hair,
                std::size_t i) {
  std::size_t first = 0;  // of the guide's particles
  for (std::uint32_t g = 0; g < plan.hairs[hair].guide; ++g) first += plan.guides[g].arcs.size();
  const std::size_t particles = plan.guides[plan.hairs[hair].guide].arcs.size();
  for (const std::uint32_t particle : cutBeyond) {
    if (particle < first || particle >= first + particles) continue;
    if (reference::pointsBefore(particle + 1 - first, plan.hairs[hair], plan.pointCount(hair),
                                plan.own.of(hair)) == i + 1)
      return true;
  }
  return false;
}

// What else hairs follow.
struct Following {
  Met met{};
  std::vector<Vec3d> roots{};
  std::vector<std::uint32_t> cutBeyond{};
  bool rootsLast = false;  // by themselves, after the pose
};

// The points that the device finds, in the order of hairs.
std::vector<Vec3d> followIn(FollowStage& stage, gpu::Device& device, const Plan& plan,
                            const std::vector<Strand>& pose, Quatd head, const Following& following) {
  const auto& [met, roots, cutBeyond, rootsLast] = following;
  stage.setBodies(met.poses, met.points);
  std::vector<Vec3d> positions;
  for (const Strand& strand : pose) positions.insert(positions.end(), strand.begin(), strand.end());
  EXPECT_TRUE(stage.setPose(positions, rootsLast ? std::vector<Vec3d>(roots.size()) : roots, cutBeyond));
  std::vector<Vec3d> guideRoots;
  for (const Strand& strand : pose) guideRoots.push_back(strand.front());
  if (rootsLast) {
    EXPECT_TRUE(stage.setRoots(roots, guideRoots));
  }
  auto recorder = gpu::Recorder::create(device, "follow");
  EXPECT_TRUE(recorder->begin());
  stage.record(*recorder, head);
  EXPECT_TRUE(recorder->submitAndWait());
  const auto records = downloadAll<layout::uvec4>(stage.points(), stage.pointCount());
  std::vector<Vec3d> points;
  std::uint32_t hair = 0;
  for (std::size_t i = 0; i < records->size(); ++i) {
    const layout::uvec4& record = (*records)[i];
    points.push_back(
        {std::bit_cast<float>(record.x), std::bit_cast<float>(record.y), std::bit_cast<float>(record.z)});
    const bool isEnd = i + 1 == stage.firstPoint()[hair + 1];
    const bool isCut = isCutAfter(plan, cutBeyond, hair, i - stage.firstPoint()[hair]);
    EXPECT_EQ(record.w, isEnd || isCut ? hair | layout::kHairEnd : hair) << i;
    hair += isEnd;
  }
  EXPECT_EQ(hair, plan.hairs.size());
  return points;
}
std::vector<Vec3d> followOn(gpu::Device& device, const Plan& plan, const std::vector<Strand>& pose,
                            Quatd head, const Following& following = {}) {
  auto stage = FollowStage::create(device, plan.guides, plan.hairs, following.met.bodies,
                                   !following.roots.empty(), plan.own);
  EXPECT_TRUE(stage) << stage.error().message;
  return followIn(*stage, device, plan, pose, head, following);
}

// From the reference, of each point.
std::vector<double> differences(const Plan& plan, const std::vector<Strand>& pose, Quatd head,
                                const std::vector<Vec3d>& found, const Met& met = {},
                                const std::vector<Vec3d>& roots = {}) {
  std::vector<double> all;
  const std::vector<Body> bodies = reference::bodiesMetAt(met.bodies, met.points);
  std::vector<reference::GuidePose> guides;
  for (std::size_t g = 0; g < pose.size(); ++g)
    guides.push_back(reference::poseGuide(plan.guides[g], pose[g], head));
  for (std::size_t h = 0; h < plan.hairs.size(); ++h) {
    const auto root = roots.empty() ? std::nullopt : std::optional(roots[h]);
    for (const Vec3d& expected :
         reference::followGuides(plan.hairs[h], guides, bodies, met.poses, root, plan.own.of(h)))
      all.push_back(length(expected - found.at(all.size())));
  }
  EXPECT_EQ(all.size(), found.size());
  return all;
}
double largestDifference(const Plan& plan, const std::vector<Strand>& pose, Quatd head,
                         const std::vector<Vec3d>& found, const Met& met = {},
                         const std::vector<Vec3d>& roots = {}) {
  double largest = 0;
  for (const double difference : differences(plan, pose, head, found, met, roots))
    if (!(difference <= largest)) largest = difference;  // NaN too
  return largest;
}

std::size_t countOther(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

TEST(CoreWeights, AreTheCoreOfAnyPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Guides& guides : allGuides()) {
    SCOPED_TRACE(guides.name);
    for (const Strand& strand : guides.strands) {
      const GuideRest rest = restOfGuide(strand);
      std::vector<Vec3d> points(strand.size());
      for (Vec3d& point : points) point = {any(random), any(random), any(random)};
      const std::vector<Vec3d> core = smoothCore(points, rest.arcs, rest.window);
      const auto rows = coreWeightsOf(rest);
      ASSERT_EQ(rows.size(), points.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        Vec3d sum;
        for (std::size_t k = 0; k < rows[i].weights.size(); ++k)
          sum += points.at(rows[i].first + k) * static_cast<double>(rows[i].weights[k]);
        ASSERT_LT(length(sum - core[i]), 1e-5) << "particle " << i << " of " << rows.size();
      }
    }
  }
}

using FollowStageTest = GpuTest;

TEST_F(FollowStageTest, IsTheReference) {
  for (const Guides& guides : allGuides()) {
    SCOPED_TRACE(guides.name);
    std::vector<Strand> pose;
    for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
    for (const Plan& plan : bothOf(planOf(guides, 500))) {
      for (const bool isPosed : {false, true}) {
        const auto& strands = isPosed ? pose : guides.strands;
        const Quatd head = isPosed ? kTurned : Quatd{};
        const auto found = followOn(gpu(), plan, strands, head);
        const double largest = largestDifference(plan, strands, head, found);
        EXPECT_LT(largest, parity::kFollowMetres) << isPosed;
        if (isPosed) RecordProperty(guides.name + "_m", std::to_string(largest));
      }
    }
  }
}

TEST_F(FollowStageTest, StorageAndTexelsGiveTheSameBits) {
  const Guides guides = allGuides().back();
  const auto few = gpu::Device::open("", {.mostTexelRecords = 16});
  ASSERT_TRUE(few) << few.error().message;
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  for (const double blend : {0.0, 1.0}) {
    for (const Plan& plan : bothOf(planOf(guides, 300, blend))) {
      const auto texels = followOn(gpu(), plan, pose, kTurned);
      EXPECT_EQ(followOn(**few, plan, pose, kTurned), texels) << blend;
      EXPECT_EQ(followOn(gpu(), plan, pose, kTurned), texels) << "a second time";
    }
  }
}

// Of guides beside each other that swing their own ways; in the last groom they differ in particles too.
TEST_F(FollowStageTest, BlendsAreTheReference) {
  for (Guides guides : allGuides()) {
    SCOPED_TRACE(guides.name);
    for (std::size_t s = 0; s < guides.strands.size(); ++s)  // roots of the last are in the same places
      for (Vec3d& p : guides.strands[s]) p += Vec3d{0.003, 0, 0.001} * static_cast<double>(s);
    const Plan plan = planOf(guides, 300, 1), alone = planOf(guides, 300);
    const auto isOfThree = [](const FollowHair& hair) { return hair.others[1].share > 0.05f; };
    EXPECT_GT(std::ranges::count_if(plan.hairs, isOfThree), 30);
    std::vector<Strand> pose;
    for (std::size_t s = 0; s < guides.strands.size(); ++s) {
      pose.push_back(posed(guides.strands[s]));
      const Quatd swing = fromRotationVector(Vec3d{0.2, 0.1, -0.1} * std::sin(2.0 * static_cast<double>(s)));
      for (Vec3d& p : pose[s]) p = pose[s].front() + rotate(swing, p - pose[s].front());
    }
    for (const Plan& each : bothOf(plan))
      EXPECT_LT(largestDifference(each, pose, kTurned, followOn(gpu(), each, pose, kTurned)),
                parity::kFollowMetres);
    const auto found = followOn(gpu(), plan, pose, kTurned);
    const auto unblended = followOn(gpu(), alone, pose, kTurned);
    EXPECT_GT(countOther(found, unblended), found.size() / 4);
    Plan none = plan;  // shares of nothing beside one hair that is blended
    for (std::size_t h = 1; h < none.hairs.size(); ++h) none.hairs[h].others = {};
    const auto one = followOn(gpu(), none, pose, kTurned);
    const std::size_t first = plan.guides[none.hairs[0].guide].arcs.size();
    double largest = 0;
    for (std::size_t i = first; i < one.size(); ++i)
      largest = std::max(largest, length(one[i] - unblended[i]));
    EXPECT_LT(largest, 1e-6);
  }
}

// Guides in up to three pieces, the last of a single particle, of which every other is cut by now.
TEST_F(FollowStageTest, PiecesOfCutGuidesAreTheReference) {
  const auto few = gpu::Device::open("", {.mostTexelRecords = 16});
  ASSERT_TRUE(few) << few.error().message;
  for (const Guides& guides : allGuides()) {
    SCOPED_TRACE(guides.name);
    Plan plan = planOf(guides, 300);
    std::vector<Strand> pose;
    std::vector<std::uint32_t> cutBeyond;
    std::uint32_t first = 0;
    for (std::size_t g = 0; g < guides.strands.size(); ++g) {
      Strand& strand = pose.emplace_back(posed(guides.strands[g]));
      const auto count = static_cast<std::uint32_t>(strand.size());
      if (count > 4 && g % 3 > 0) plan.guides[g].pieces = {count / 2 + 1};
      if (count > 4 && g % 3 == 2) plan.guides[g].pieces.push_back(count - 1);
      for (const std::uint32_t begin : plan.guides[g].pieces) {
        if (g % 2 == 0) continue;
        for (std::uint32_t i = begin; i < count; ++i) strand[i] -= Vec3d{0.02, 0.1, -0.03};
        cutBeyond.push_back(first + begin - 1);
      }
      first += count;
    }
    for (const Plan& each : bothOf(plan)) {
      const auto found = followOn(gpu(), each, pose, kTurned, {.cutBeyond = cutBeyond});
      EXPECT_LT(largestDifference(each, pose, kTurned, found), parity::kFollowMetres);
      EXPECT_EQ(followOn(**few, each, pose, kTurned, {.cutBeyond = cutBeyond}), found)
          << "storage for texels";
    }
  }
}

// Somewhere about the middle of the strands, or their roots, each turned its own way, so that all press on
// hair.
Met metBy(const std::vector<Body>& bodies, const std::vector<Strand>& strands, bool atRoots = false) {
  Met met{bodies, {}};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Strand& strand = strands[b % strands.size()];
    const double turn = 0.7 * static_cast<double>(b + 1);
    // A plane goes through them; what is round has them at its side.
    const Vec3d aside = bodies[b].shape == BodyShape::plane ? Vec3d{}
                        : atRoots                           ? Vec3d{0.03, 0.06, 0.02}
                                                            : Vec3d{0.03, -0.11, 0.02};
    met.poses.push_back(
        {strand[atRoots ? 0 : strand.size() / 2] + aside, fromRotationVector(Vec3d{0.3, 0.2, 0.1} * turn)});
  }
  return met;
}

TEST_F(FollowStageTest, AmongBodiesItIsTheReference) {
  const Guides guides = allGuides().front();
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  std::vector<Met> all;
  for (const Body& body : parity::sampleBodies()) all.push_back(metBy({body}, pose));
  all.push_back(metBy(parity::sampleBodies(), pose));
  all.push_back(metBy({parity::sampleBodies().front()}, pose, true));
  const auto few = gpu::Device::open("", {.mostTexelRecords = 16});
  ASSERT_TRUE(few) << few.error().message;
  std::vector<Plan> plans = bothOf(planOf(guides, 300));
  plans.push_back(planOf(guides, 300, 0.8));
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const Plan& plan = plans[p];
    const auto alone = followOn(gpu(), plan, pose, kTurned);
    for (const Met& met : all) {
      SCOPED_TRACE(met.bodies.size() == 1 ? met.bodies.front().name : "all of them");
      SCOPED_TRACE(p);
      const auto found = followOn(gpu(), plan, pose, kTurned, {.met = met});
      EXPECT_GT(countOther(found, alone), found.size() / 100) << "the body must press on hair";
      EXPECT_LT(largestDifference(plan, pose, kTurned, found, met), parity::kFollowMetres);
      EXPECT_EQ(followOn(**few, plan, pose, kTurned, {.met = met}), found)
          << "storage buffers in place of texels";
    }
  }
}

// The points of those of `bodies` that bend, each swollen along a direction of its own, by a share of
// `swell`.
std::vector<std::vector<Vec3d>> swollen(const std::vector<Body>& bodies, double swell) {
  std::vector<std::vector<Vec3d>> all;
  for (const Body& body : bodies) {
    if (!body.bends()) continue;
    std::vector<Vec3d>& points = all.emplace_back(body.mesh->points);
    const Vec3d way{1, 0.5, -0.3 * static_cast<double>(all.size())}, along = way / length(way);
    for (Vec3d& p : points) p += along * (swell * dot(p, along));
  }
  return all;
}

// One stage, pose after pose. Among the bodies are one that does not bend and cloth, which hairs do not see.
TEST_F(FollowStageTest, BodiesThatBendAreMetWhereTheirPointsAre) {
  const Guides guides = allGuides().front();
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  const auto few = gpu::Device::open("", {.mostTexelRecords = 16});
  ASSERT_TRUE(few) << few.error().message;
  const Body ball = parity::bendingBall(0.1, 0.006);
  const Plan plan = planOf(guides, 300, 0.8);
  for (const std::vector<Body>& bodies :
       {std::vector{ball},
        {parity::gridBall(0.1, 0.005), ball, parity::sheet(0.3), parity::bendingBall(0.08, 0.007)}}) {
    SCOPED_TRACE(bodies.size());
    Met met = metBy(bodies, pose);
    auto stage = FollowStage::create(gpu(), plan.guides, plan.hairs, bodies);
    auto other = FollowStage::create(**few, plan.guides, plan.hairs, bodies);
    ASSERT_TRUE(stage && other);
    std::vector<Vec3d> before;
    for (const double swell : {0.0, 0.4, 0.4, -0.3}) {
      SCOPED_TRACE(swell);
      met.points = swollen(bodies, swell);
      const auto found = followIn(*stage, gpu(), plan, pose, kTurned, {.met = met});
      const auto from = differences(plan, pose, kTurned, found, met);
      // A distance that is just between two halves is rounded to one or the other, and turns the way out.
      EXPECT_LT(std::ranges::count_if(from, [](double d) { return !(d < parity::kFollowMetres); }),
                std::ssize(from) / 100);
      EXPECT_LT(std::ranges::max(from), parity::kFollowMetres + 0x1p-10 * (ball.mesh->cell + 0.1));
      EXPECT_EQ(followIn(*other, **few, plan, pose, kTurned, {.met = met}), found) << "storage for texels";
      before = found;
    }
    // Without points they stay as they were.
    Met still = met;
    still.points.clear();
    EXPECT_EQ(followIn(*stage, gpu(), plan, pose, kTurned, {.met = still}), before);
    EXPECT_GT(countOther(before, followOn(gpu(), plan, pose, kTurned, {.met = still})), before.size() / 100)
        << "the body must press on hair otherwise when it is swollen";
  }
}

// A scalp that bends takes each root its own way, here by up to a centimetre.
TEST_F(FollowStageTest, RootsOnAScalpAreWhereItHasThem) {
  const Guides guides = allGuides().front();
  Plan plan = planOf(guides, 300);
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.006, 0.006);
  std::vector<Vec3d> roots;
  for (const FollowHair& hair : plan.hairs)
    roots.push_back(pose[hair.guide].front() + Vec3d{any(random), any(random), any(random)});
  const auto few = gpu::Device::open("", {.mostTexelRecords = 16});
  ASSERT_TRUE(few) << few.error().message;
  for (const double blend : {0.0, 1.0}) {
    plan = planOf(guides, 300, blend);
    for (const Met& met : {Met{}, metBy(parity::sampleBodies(), pose)}) {
      const auto found = followOn(gpu(), plan, pose, kTurned, {.met = met, .roots = roots});
      EXPECT_LT(largestDifference(plan, pose, kTurned, found, met, roots), parity::kFollowMetres);
      EXPECT_GT(countOther(found, followOn(gpu(), plan, pose, kTurned, {.met = met})), found.size() / 20);
      EXPECT_EQ(followOn(**few, plan, pose, kTurned, {.met = met, .roots = roots}), found)
          << "storage in place of texels";
      EXPECT_EQ(followOn(gpu(), plan, pose, kTurned, {.met = met, .roots = roots, .rootsLast = true}), found)
          << "roots by themselves";
      if (!met.bodies.empty()) continue;
      double farthest = 0;
      for (std::size_t h = 0; h < roots.size(); ++h)
        farthest = std::max(farthest, length(found[h * pose.front().size()] - roots[h]));
      EXPECT_LT(farthest, 1e-6);
    }
  }
}

// A body's grid goes with its turn, where its middle is not its origin.
TEST_F(FollowStageTest, BodiesFarFromTheirOriginTurn) {
  const Guides guides = allGuides().front();
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  const Plan plan = planOf(guides, 300);
  const auto alone = followOn(gpu(), plan, pose, kTurned);
  for (const Vec3d way : {Vec3d{0.1, 0, 0}, {0, 0.2, -0.1}}) {
    for (const Vec3d turn : {Vec3d{}, {0, std::numbers::pi, 0}, {0.5, 1, 2}}) {
      const Quatd rotation = fromRotationVector(turn);
      Met met = metBy({parity::gridBall(0.1, 0.005)}, pose);
      const BodyPose ball = met.poses[0];
      met.bodies = {parity::gridBall(0.1, 0.005, way)};  // the same ball
      met.poses = {{ball.position - rotate(rotation, way), rotation}};
      const auto found = followOn(gpu(), plan, pose, kTurned, {.met = met});
      EXPECT_GT(countOther(found, alone), found.size() / 100) << "the body must press on hair";
      EXPECT_LT(largestDifference(plan, pose, kTurned, found, met), parity::kFollowMetres);
    }
  }
}

const InputException kUnset[] = {
    {"BodyPose.moves", "hairs that follow see a body where it is, not how it moves"},
    {"BodyPose.turn", "likewise"},
    {"BodyPose.velocity", "likewise"},
    {"BodyPose.field", "a body that bends has one field, of the pose"},
    {"BodyRest.firstKey", "likewise"},
    {"BodyRest.triangleBits", "likewise"},
    {"BodyRest.firstWay", "likewise"},
    {"BodyRest.triangleCount", "likewise"},
    {"BodyRest.friction", "nothing holds hairs that follow back"},
    {"BodyRest.lists", "hairs that follow do not see cloth"},
    {"FollowBlend.unused", "unused"},
    {"FollowGuide.unused", "unused"},
};

// A groom and its hairs in a pose, as a case of KernelInputs.
struct InputsCase {
  const char* name;
  Guides guides;
  int hairCount;
  double blend;
  Quatd head;
  std::size_t bodyCount = 0;
  bool onScalp = false, isCut = false, hasOwn = false;
};

void runCase(gpu::Device& device, const InputsCase& c) {
  SCOPED_TRACE(c.name);
  Guides guides = c.guides;
  for (std::size_t s = 0; s < guides.strands.size(); ++s)  // no two roots in one place
    for (Vec3d& p : guides.strands[s]) p += Vec3d{0.003, 0, 0.001} * static_cast<double>(s);
  std::vector<Strand> pose;
  for (const Strand& strand : guides.strands) pose.push_back(posed(strand));
  Plan plan = planOf(guides, c.hairCount, c.blend);
  if (c.hasOwn) plan.own = anyOwnPoints(plan);
  std::vector<Body> bodies = parity::sampleBodies();
  bodies.push_back(parity::gridBall(0.1, 0.005, {0.1, 0.2, -0.1}));
  bodies.resize(c.bodyCount);
  for (std::size_t b = 0; b < bodies.size(); ++b) bodies[b].thickness = 0.001 * static_cast<double>(b);
  const Met met = metBy(bodies, pose);
  std::vector<Vec3d> roots;
  for (std::size_t h = 0; c.onScalp && h < plan.hairs.size(); ++h)
    roots.push_back(pose[plan.hairs[h].guide].front() + Vec3d{0.001, 0.002, -0.003});
  std::vector<std::uint32_t> cutBeyond;
  if (c.isCut) {
    const auto half = static_cast<std::uint32_t>(pose[0].size()) / 2;
    plan.guides[0].pieces = {half};
    cutBeyond = {half - 1};
  }
  const auto found = followOn(device, plan, pose, c.head, {met, roots, cutBeyond});
  EXPECT_LT(largestDifference(plan, pose, c.head, found, met, roots), parity::kFollowMetres);
}

// Every input of the kernels is set by a case, each of which is the reference's.
TEST_F(FollowStageTest, EachInputIsSetBySomeCase) {
  if (gpu().properties().type != "cpu") GTEST_SKIP() << "the host does not see this device's buffers";
  const auto opened = gpu::Device::open();
  ASSERT_TRUE(opened) << opened.error().message;
  KernelInputs inputs(kEmbeddedModules, kFollowInputs);
  const Guides all = allGuides().back(), curls = allGuides().front();
  {
    KernelSpy spy(**opened);
    for (const InputsCase& c :
         {InputsCase{"hair of every kind", all, 300, 0, {}},
          InputsCase{"curls, turned", curls, 200, 0, kTurned},
          InputsCase{"three guides", all, 300, 1, kTurned},
          InputsCase{"three guides among bodies", all, 300, 1, kTurned, 6},
          InputsCase{"on a scalp among bodies", curls, 200, 1, {}, 2, true},
          InputsCase{"cut among bodies", all, 300, 0, kTurned, 6, false, true},
          InputsCase{"points of their own", all, 300, 0, kTurned, 6, false, false, true},
          InputsCase{"likewise of three guides", all, 300, 1, {}, 0, false, false, true}}) {
      spy.onDone = [&](const SpiedCommands& commands) { inputs.look(spy, commands, c.name); };
      runCase(**opened, c);
    }
  }
  expectNoMessages(*(*opened)->validationLog());
  inputs.expectAllSet(kUnset);
}

// Bodies may be anywhere in a world: what counts is where they are from where particles are seen.
TEST_F(FollowStageTest, BodiesAreSeenFromTheOrigin) {
  const Guides guides = allGuides().front();
  const Plan plan = planOf(guides, 100);
  const Met met = metBy({parity::sampleBodies().front()}, guides.strands);
  auto stage = FollowStage::create(gpu(), plan.guides, plan.hairs, met.bodies);
  ASSERT_TRUE(stage) << stage.error().message;
  const Vec3d origin{3, -2, 5};
  BodyPose there = met.poses.front();
  there.position += origin;
  std::vector<Vec3d> positions;
  for (const Strand& strand : guides.strands) positions.insert(positions.end(), strand.begin(), strand.end());
  ASSERT_TRUE(stage->setPose(positions));
  stage->setBodies(std::span(&there, 1), {}, origin);
  auto recorder = gpu::Recorder::create(gpu(), "follow");
  ASSERT_TRUE(recorder->begin());
  stage->record(*recorder, Quatd{});
  ASSERT_TRUE(recorder->submitAndWait());
  const auto records = downloadAll<layout::uvec4>(stage->points(), stage->pointCount());
  const auto expected = followOn(gpu(), plan, guides.strands, Quatd{}, {.met = met});
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_LT(std::abs(std::bit_cast<float>((*records)[i].x) - expected[i].x), 1e-6) << i;
}

TEST_F(FollowStageTest, TooManyHairsAreRefusedWithTheNumberThereIsRoomFor) {
  Guides guides{"one", {strandOf(64, 0.2, 8, 0.008, {})}};
  Plan plan = planOf(guides, 1);
  const auto& limits = gpu().properties();
  const std::uint64_t most =
      std::min(limits.maxStorageBufferRange / 16, std::uint64_t{limits.maxGroupCount} * 256) / 64;
  if (most > 4'000'000) GTEST_SKIP() << "the device sees " << most << " hairs at once";
  plan.hairs.resize(most + 1, plan.hairs.front());
  const auto stage = FollowStage::create(gpu(), plan.guides, plan.hairs);
  ASSERT_FALSE(stage);
  expectParts(stage.error().message, {std::to_string(most + 1) + " hairs", "of " + std::to_string(most)});
}

}  // namespace
}  // namespace ringlet::test::follow_stage_test
