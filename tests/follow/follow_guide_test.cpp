// Hairs that follow guides, by the reference: curls, roots, blends, bodies, cuts. On poses that bend and
// turn.
#include "reference/follow_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "reference/equations/body_distance.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/curl_shape.h"
#include "tests/follow/guide_samples.h"

namespace ringlet::follow_guide_test {
namespace {

using namespace test;
using reference::followGuide;
using reference::followGuides;
using reference::GuidePose;
using reference::poseGuide;

const Quatd kTurned = normalized(Quatd{0.2, -0.5, 0.3, 0.8});

// The strand on a head that has turned, swung aside by up to half a radian at its tip.
Strand swung(const Strand& rest) {
  Strand pose;
  for (const Vec3d& p : rest) {
    const double drop = std::max(0.0, rest.front().y - p.y), angle = 2 * drop;
    const Vec3d swing = {drop * std::sin(angle), drop * (1 - std::cos(angle)), 0};
    pose.push_back(rotate(kTurned, p + swing));
  }
  return pose;
}

double meanDistance(const Strand& a, const Strand& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += length(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

TEST(FollowGuide, AHairThatDiffersInNothingIsItsGuide) {
  for (const Strand& strand : headOf(20)) {
    const GuideRest rest = restOfGuide(strand);
    EXPECT_LT(meanDistance(followGuide({}, poseGuide(rest, strand, {0, 0, 0, 1})), strand), 1e-12);
    const Strand pose = swung(strand);
    EXPECT_LT(meanDistance(followGuide({}, poseGuide(rest, pose, kTurned)), pose), 1e-12);
  }
}

// What is cut off goes its own way, and nothing of a hair stands between or is drawn out.
TEST(FollowGuide, AHairIsCutAsItsGuideIs) {
  const Strand strand = headOf(3)[1];
  GuideRest rest = restOfGuide(strand);
  rest.pieces = {25};
  Strand cut = strand;
  const Vec3d fell{0.01, -0.4, 0.02};
  for (std::size_t i = 25; i < cut.size(); ++i) cut[i] += fell;
  for (const float length : {1.f, 0.93f, 0.71f}) {
    const FollowHair hair{.offset = {0.004f, 0.003f, 0}, .phase = 0.6f, .radius = 0.8f, .length = length};
    const Strand whole = followGuide(hair, poseGuide(rest, strand, Quatd{}));
    const Strand parted = followGuide(hair, poseGuide(rest, cut, Quatd{}));
    const std::size_t kept = reference::pointsBefore(25, hair, strand.size());
    EXPECT_GT(kept, 24u);
    EXPECT_LT(kept, strand.size() - 1);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const Vec3d expected = whole[i] + (i < kept ? Vec3d{} : fell);
      EXPECT_LT(ringlet::length(parted[i] - expected), 1e-12) << i << " of a hair of " << length;
    }
  }
}

TEST(FollowGuide, RootsGoWithTheHead) {
  const auto strands = headOf(30);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 900});
  ASSERT_TRUE(hairs);
  for (const FollowHair& hair : *hairs) {
    const Strand& guide = strands[hair.guide];
    const Vec3d atRest = followGuide(hair, poseGuide(rests[hair.guide], guide, {0, 0, 0, 1})).front();
    const Vec3d moved = followGuide(hair, poseGuide(rests[hair.guide], swung(guide), kTurned)).front();
    EXPECT_LT(length(moved - rotate(kTurned, atRest)), 1e-12);
  }
}

// Radius and turns of a hair over its guide's, at rest and in a pose.
TEST(FollowGuide, CurlsStayCurls) {
  const auto strands = headOf(60);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 1200, .radius = 0, .length = 0});
  ASSERT_TRUE(hairs);
  for (const bool isMoved : {false, true}) {
    std::vector<double> radius, turns;
    int straight = 0, otherHand = 0;
    for (const FollowHair& hair : *hairs) {
      const Strand guide = isMoved ? swung(strands[hair.guide]) : strands[hair.guide];
      const Quatd head = isMoved ? kTurned : Quatd{0, 0, 0, 1};
      const CurlShape own = measureCurl(followGuide(hair, poseGuide(rests[hair.guide], guide, head)));
      const CurlShape its = measureCurl(guide);
      straight += own.turns == 0;
      otherHand += own.handedness != its.handedness;
      radius.push_back(std::abs(own.radius / its.radius - 1));
      turns.push_back(std::abs(own.turns / its.turns - 1));
    }
    EXPECT_EQ(straight, 0);
    EXPECT_EQ(otherHand, 0);
    EXPECT_LT(median(radius), 0.02) << isMoved;
    EXPECT_LT(median(turns), 0.02) << isMoved;
    EXPECT_LT(std::ranges::max(turns), 0.2) << isMoved;
  }
}

TEST(FollowGuide, DifferencesAreWhatIsAsked) {
  const auto strands = headOf(10);
  const auto rests = restsOf(strands);
  const Strand& guide = strands[3];
  const GuidePose pose = poseGuide(rests[3], guide, {0, 0, 0, 1});
  const auto curlOf = [&](const FollowHair& hair) { return measureCurl(followGuide(hair, pose)); };
  EXPECT_NEAR(curlOf({.radius = 1.2f}).radius / curlOf({}).radius, 1.2, 0.03);
  const auto arc = [](const Strand& strand) {
    double sum = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) sum += length(strand[i] - strand[i - 1]);
    return sum;
  };
  // 0.8 of 63 edges are 50.4.
  const double guideArc = arc({guide.begin(), guide.begin() + 51}) + 0.4 * length(guide[51] - guide[50]);
  EXPECT_NEAR(arc(followGuide({.length = 0.8f}, pose)) / guideArc, 1, 0.01);
  EXPECT_NEAR(curlOf({.length = 0.8f}).radius / measureCurl(std::span(guide).first(51)).radius, 1, 0.02);
  // Half a turn puts a point across the core.
  const Strand across = followGuide({.phase = std::numbers::pi_v<float>}, pose);
  const auto& place = pose.places[40];
  const Vec3d core{place.core.x(), place.core.y(), place.core.z()};
  EXPECT_LT(length((across[40] - core) + (guide[40] - core)), 0.1 * length(guide[40] - core));
  // An offset goes along unshortened, or as far as `spread` says, turned with the frame.
  const Vec3f offset{0.004f, 0.003f, 0};
  EXPECT_NEAR(length(followGuide({.offset = offset}, pose)[50] - guide[50]), 0.005, 1e-6);
  EXPECT_NEAR(length(followGuide({.offset = offset, .spread = 0.5f}, pose)[50] - guide[50]), 0.0025, 1e-6);
  EXPECT_NEAR(length(followGuide({.offset = offset, .spread = 0.5f}, pose)[0] - guide[0]), 0.005, 1e-6);
}

// A hair that follows its guide and two others, by so much of each.
FollowHair blendOf(const std::vector<GuideRest>& rests, std::array<std::uint32_t, 3> guides,
                   std::array<float, 2> shares, Vec3d root) {
  const auto from = [&](std::uint32_t g) {
    const MeasuringFrame& frame = rests[g].frame;
    const Vec3d v = root - rests[g].root;
    return Vec3f(Vec3d{dot(v, frame.normal), dot(v, frame.binormal), dot(v, frame.tangent)});
  };
  FollowHair hair{.guide = guides[0], .offset = from(guides[0])};
  for (std::size_t k = 0; k < 2; ++k) hair.others[k] = {guides[k + 1], shares[k], from(guides[k + 1])};
  return hair;
}

std::vector<GuidePose> posesOf(const std::vector<GuideRest>& rests, const std::vector<Strand>& strands,
                               Quatd head) {
  std::vector<GuidePose> poses;
  for (std::size_t g = 0; g < rests.size(); ++g) poses.push_back(poseGuide(rests[g], strands[g], head));
  return poses;
}

std::vector<Strand> swung(const std::vector<Strand>& strands) {
  std::vector<Strand> all;
  for (const Strand& strand : strands) all.push_back(swung(strand));
  return all;
}

TEST(FollowGuides, NothingOfTheOthersIsTheOneGuideForm) {
  const auto strands = headOf(20);
  const auto rests = restsOf(strands);
  const auto poses = posesOf(rests, swung(strands), kTurned);
  const Vec3d root = rests[3].root + Vec3d{0.003, 0.002, -0.001};
  const FollowHair none = blendOf(rests, {3, 5, 8}, {0, 0}, root);
  const FollowHair least = blendOf(rests, {3, 5, 8}, {1e-30f, 1e-30f}, root);
  EXPECT_EQ(meanDistance(followGuides(none, poses), followGuide(none, poses[3])), 0);
  EXPECT_LT(meanDistance(followGuides(least, poses), followGuide(none, poses[3])), 1e-15);
  // And so is a blend of a guide with itself.
  const FollowHair itself = blendOf(rests, {3, 3, 3}, {0.3f, 0.4f}, root);
  EXPECT_LT(meanDistance(followGuides(itself, poses), followGuide(none, poses[3])), 1e-12);
}

// On a head that turns, and on a scalp that takes roots its own way.
TEST(FollowGuides, RootsStayOnTheScalp) {
  const auto strands = headOf(40);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 400, .blend = 1});
  ASSERT_TRUE(hairs);
  const auto atRest = posesOf(rests, strands, Quatd{}), moved = posesOf(rests, swung(strands), kTurned);
  for (const FollowHair& hair : *hairs) {
    const Vec3d root = followGuides(hair, atRest).front();
    EXPECT_LT(length(root - followGuide(hair, atRest[hair.guide]).front()), 1e-9);
    EXPECT_LT(length(followGuides(hair, moved).front() - rotate(kTurned, root)), 1e-9);
    const Vec3d bent = rotate(kTurned, root) + Vec3d{0.004, -0.003, 0.002};
    EXPECT_LT(length(followGuides(hair, moved, {}, {}, bent).front() - bent), 1e-12);
  }
}

// Where blended positions lose a quarter of them.
TEST(FollowGuides, NoCurlIsLost) {
  const auto strands = headOf(600);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 1200, .radius = 0, .length = 0, .blend = 1});
  ASSERT_TRUE(hairs);
  std::size_t blended = 0;
  for (const bool isMoved : {false, true}) {
    const auto guides = isMoved ? swung(strands) : strands;
    const auto poses = posesOf(rests, guides, isMoved ? kTurned : Quatd{});
    std::vector<double> radius, turns;
    int straight = 0, otherHand = 0;
    for (const FollowHair& hair : *hairs) {
      const CurlShape own = measureCurl(followGuides(hair, poses)), its = measureCurl(guides[hair.guide]);
      straight += own.turns == 0;
      otherHand += own.handedness != its.handedness;
      radius.push_back(std::abs(own.radius / its.radius - 1));
      turns.push_back(std::abs(own.turns / its.turns - 1));
      blended += hair.others[0].share + hair.others[1].share > 0.4f;
    }
    EXPECT_EQ(straight, 0);
    EXPECT_EQ(otherHand, 0);
    EXPECT_LT(median(radius), 0.05) << isMoved;
    EXPECT_LT(median(turns), 0.05) << isMoved;
  }
  EXPECT_GT(blended, 500u);
}

// Straight guides, which have no curl of their own, at rest down, and each swung its own way. Roots go in
// small steps from the front to the back: a nearest guide becomes another at once.
TEST(FollowGuides, BlendsVaryWithTheRootAsNearestDoesNot) {
  const std::vector<Strand> strands = straight(headOf(300), [](Vec3d) { return Vec3d{0, -0.2, 0}; });
  std::size_t number = 0;
  const std::vector<Strand> pose = straight(strands, [&](Vec3d) {
    const auto g = static_cast<double>(number++);
    return Vec3d{0.02 * std::sin(2 * g), -0.2, 0.02 * std::cos(3 * g)};
  });
  const auto rests = restsOf(strands);
  const auto poses = posesOf(rests, pose, Quatd{});
  const auto farthestStep = [&](double blend, double step) {
    ScalpRoots roots;
    for (double angle = -0.5; angle < 0.5; angle += step)
      roots.places.push_back(Vec3d{0.01, std::cos(angle), std::sin(angle)} * 0.09);
    roots.ranks.assign(roots.places.size(), 0);
    std::vector<std::uint32_t> rootOf;
    const auto hairs = planHairs(
        rests, roots, {.phase = 0, .radius = 0, .length = 0, .gather = 0, .strayShare = 0, .blend = blend},
        {}, &rootOf);
    std::vector<Vec3d> tips(roots.places.size());
    for (std::size_t h = 0; h < hairs->size(); ++h) tips[rootOf[h]] = followGuides((*hairs)[h], poses).back();
    double farthest = 0;
    for (std::size_t i = 1; i < tips.size(); ++i)
      farthest = std::max(farthest, length(tips[i] - tips[i - 1]));
    return farthest;
  };
  EXPECT_LT(farthestStep(1, 5e-5), 0.12 * farthestStep(1, 5e-4)) << "a tenth of the way, a tenth of the step";
  EXPECT_GT(farthestStep(0, 5e-5), 0.9 * farthestStep(0, 5e-4));
}

double distanceFrom(const Body& body, const BodyPose& pose, Vec3d p) {
  const auto y = reference::toEigen<double>(rotate(pose.rotation.conjugate(), p - pose.position));
  return reference::bodyDistance<double>(body, y).distance;
}

// At a ball, where every distance is exact. Guides hang past it, and through it.
TEST(FollowGuide, HairsStayOutOfBodiesWhereTheirGuidesDo) {
  const std::vector<Strand> strands = headOf(40);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 800});
  ASSERT_TRUE(hairs) << hairs.error().message;
  const Body ball{.name = "ball", .shape = BodyShape::sphere, .radius = 0.11};
  const BodyPose pose{{0, -0.02, 0.02}, Quatd{}};
  std::size_t pressed = 0, through = 0;
  for (const FollowHair& hair : *hairs) {
    const GuidePose guide = poseGuide(rests[hair.guide], strands[hair.guide], Quatd{});
    const auto alone = followGuide(hair, guide);
    const auto found = followGuide(hair, guide, std::span(&ball, 1), std::span(&pose, 1));
    const double root = distanceFrom(ball, pose, alone.front());
    EXPECT_LT(length(found.front() - alone.front()), 1e-12) << "roots stay";
    const auto last = static_cast<double>(alone.size() - 1);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const double share = static_cast<double>(i) / last;
      const double along = static_cast<double>(i) *
                           (1 + (static_cast<double>(hair.length) - 1) * reference::risesOver(0.2, share));
      const auto k = std::min(static_cast<std::size_t>(along), alone.size() - 2);
      const double between = along - static_cast<double>(k);
      const double ofGuide = (1 - between) * distanceFrom(ball, pose, strands[hair.guide][k]) +
                             between * distanceFrom(ball, pose, strands[hair.guide][k + 1]);
      const double before = distanceFrom(ball, pose, alone[i]), after = distanceFrom(ball, pose, found[i]);
      const double kept = std::min({0.0, ofGuide, (1 - reference::risesOver(0.2, share)) * root});
      ASSERT_NEAR(after, std::max(before, kept), 1e-9);
      ASSERT_NEAR(length(found[i] - alone[i]), after - before, 1e-9) << "the short way out";
      pressed += after > before && ofGuide >= 0;
      through += ofGuide < 0 && after < 0;
    }
  }
  EXPECT_GT(pressed, 100u) << "the ball must press on hairs";
  EXPECT_GT(through, 100u) << "and some guides must go through it";
}

// A guide that moves through a body carries its hairs along: none jumps.
TEST(FollowGuide, HairsDoNotJumpWhereAGuideGoesThroughABody) {
  const std::vector<Strand> strands = headOf(12);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 240, .reach = 0.02});
  ASSERT_TRUE(hairs) << hairs.error().message;
  const Body ball{.name = "ball", .shape = BodyShape::sphere, .radius = 0.05};
  constexpr double kStep = 0.0005;  // [m]
  double farthest = 0;
  for (const FollowHair& hair : *hairs) {
    const GuidePose guide = poseGuide(rests[hair.guide], strands[hair.guide], Quatd{});
    std::vector<Vec3d> before;
    for (double x = -0.25; x < 0.25; x += kStep) {
      const BodyPose pose{{x, -0.1, 0.03}, Quatd{}};
      const auto found = followGuide(hair, guide, std::span(&ball, 1), std::span(&pose, 1));
      for (std::size_t i = 0; i < before.size(); ++i)
        farthest = std::max(farthest, length(found[i] - before[i]));
      before = found;
    }
  }
  // A point moves with the ball's surface, and beside it where its guide's distance counts too.
  EXPECT_LT(farthest, 12 * kStep);
}

// Of several guides their mean distance counts: where none is inside, the hair is not.
TEST(FollowGuides, BlendsStayOutOfBodiesWhereTheirGuidesDo) {
  const std::vector<Strand> strands = headOf(60);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = 1200, .length = 0, .blend = 1});
  ASSERT_TRUE(hairs) << hairs.error().message;
  const Body ball{.name = "ball", .shape = BodyShape::sphere, .radius = 0.11};
  const BodyPose place{{0, -0.02, 0.02}, Quatd{}};
  const auto guides = posesOf(rests, strands, Quatd{});
  std::size_t pressed = 0, through = 0;
  for (const FollowHair& hair : *hairs) {
    const auto alone = followGuides(hair, guides);
    const auto found = followGuides(hair, guides, std::span(&ball, 1), std::span(&place, 1));
    const double root = distanceFrom(ball, place, alone.front());
    const auto last = static_cast<double>(alone.size() - 1);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const double r = reference::risesOver(0.2, static_cast<double>(i) / last);
      double ofGuides = distanceFrom(ball, place, strands[hair.guide][i]);
      const double ofOwn = ofGuides;
      bool areAllOut = ofOwn >= 0;
      for (const FollowHair::Other& other : hair.others) {
        const double its = distanceFrom(ball, place, strands[other.guide][i]);
        ofGuides += double(other.share) * (its - ofOwn);
        areAllOut = areAllOut && (its >= 0 || other.share == 0);
      }
      const double before = distanceFrom(ball, place, alone[i]), after = distanceFrom(ball, place, found[i]);
      ASSERT_NEAR(after, std::max(before, std::min({0.0, ofGuides, (1 - r) * root})), 1e-9);
      if (areAllOut && r == 1) {
        ASSERT_GT(after, -1e-9);
      }
      pressed += after > before && areAllOut;
      through += after < 0 && !areAllOut;
    }
  }
  EXPECT_GT(pressed, 100u) << "the ball must press on hairs";
  EXPECT_GT(through, 100u) << "and some guides must go through it";
}

// Each guide swings at its own pace and in its own way: hairs that follow several jerk no more than those.
TEST(FollowGuides, TipsJerkNoMoreThanTheirGuides) {
  for (const double turns : {0.0, 4.0}) {
    const auto strands = headOf(60, turns);
    const auto rests = restsOf(strands);
    const auto hairs = planHairs(rests, {.hairCount = 300, .blend = 1});
    ASSERT_TRUE(hairs);
    const auto poseAt = [&](double t) {
      std::vector<Strand> pose = strands;
      for (std::size_t g = 0; g < pose.size(); ++g) {
        const double turn = 0.7 * double(g), swing = 0.4 * std::sin(2 * std::numbers::pi * 1.5 * t + turn);
        const Quatd aside = fromRotationVector(Vec3d{std::cos(turn), 0, std::sin(turn)} * swing);
        for (Vec3d& p : pose[g]) {
          const Vec3d fall = p - strands[g].front();
          p += (rotate(aside, fall) - fall) * std::min(1.0, 20 * length(fall));
        }
      }
      return pose;
    };
    std::vector<std::vector<Vec3d>> guideTips, hairTips;  // of three moments
    double ofGuides = 0, ofHairs = 0;
    const auto jerk = [](const std::vector<std::vector<Vec3d>>& tips) {
      double most = 0;
      for (std::size_t k = 0; k < tips.back().size(); ++k) {
        const std::size_t n = tips.size();
        most = std::max(most, length(tips[n - 1][k] - 2.0 * tips[n - 2][k] + tips[n - 3][k]));
      }
      return most;
    };
    for (int frame = 0; frame < 60; ++frame) {
      const auto pose = poseAt(frame / 96.0);
      const auto guides = posesOf(rests, pose, Quatd{});
      guideTips.emplace_back();
      for (const Strand& strand : pose) guideTips.back().push_back(strand.back());
      hairTips.emplace_back();
      for (const FollowHair& hair : *hairs) hairTips.back().push_back(followGuides(hair, guides).back());
      if (frame < 2) continue;
      ofGuides = std::max(ofGuides, jerk(guideTips));
      ofHairs = std::max(ofHairs, jerk(hairTips));
    }
    EXPECT_GT(ofGuides, 1e-4) << turns;
    EXPECT_LT(ofHairs, 1.5 * ofGuides) << turns;
  }
}

}  // namespace
}  // namespace ringlet::follow_guide_test
