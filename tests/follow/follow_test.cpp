// Hairs that follow guides: roots, curls, evenness, and what is refused. On poses that bend and turn.
#include "ringlet/follow/follow_hairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "reference/equations/body_distance.h"
#include "reference/follow_guide.h"
#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/generate.h"

namespace ringlet {
namespace {

using reference::followGuide;
using reference::followGuides;
using reference::GuidePose;
using reference::poseGuide;

using Strand = std::vector<Vec3d>;

std::vector<Strand> headOf(int strands, double turns = 8) {
  const Result<Groom> groom = makeHead({.curl = {.turns = turns}, .strandCount = strands});
  std::vector<Strand> all;
  for (std::size_t s = 0; s < groom->strandCount(); ++s) {
    Strand& strand = all.emplace_back();
    for (const Vec3f& p : groom->strand(s)) strand.push_back(Vec3d(p) * groom->metresPerUnit);
  }
  return all;
}

std::vector<GuideRest> restsOf(const std::vector<Strand>& strands) {
  std::vector<GuideRest> rests;
  for (const Strand& strand : strands) rests.push_back(restOfGuide(strand));
  return rests;
}

// From the same roots, each to where `way` leads.
template <class Way>
std::vector<Strand> straight(std::vector<Strand> strands, const Way& way) {
  for (Strand& strand : strands) {
    const Vec3d root = strand.front(), led = way(root);
    for (std::size_t i = 0; i < strand.size(); ++i)
      strand[i] = root + led * (double(i) / double(strand.size() - 1));
  }
  return strands;
}

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

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
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

TEST(PlanHairs, RootsAreEvenAndNearestToTheirGuide) {
  constexpr int kHairs = 6000;
  constexpr int kGuides = 600;  // 8 mm apart
  const auto strands = headOf(kGuides);
  const auto rests = restsOf(strands);
  const auto hairs = planHairs(rests, {.hairCount = kHairs});
  ASSERT_TRUE(hairs);
  ASSERT_EQ(hairs->size(), kHairs);
  std::vector<int> counts(rests.size(), 0);
  std::vector<Vec3d> roots;
  std::size_t nearerToAnother = 0;
  double offScalp = 0;
  for (const FollowHair& hair : *hairs) {
    ++counts[hair.guide];
    const MeasuringFrame& frame = rests[hair.guide].frame;
    const Vec3d offset = Vec3d(hair.offset);
    const Vec3d root = rests[hair.guide].root + frame.normal * offset.x + frame.binormal * offset.y +
                       frame.tangent * offset.z;
    for (const GuideRest& other : rests)
      nearerToAnother += length(root - other.root) < length(root - rests[hair.guide].root) - 1e-6;
    offScalp = std::max(offScalp, std::abs(length(root) - 0.09));
    roots.push_back(root);
  }
  EXPECT_EQ(std::ranges::count(counts, kHairs / kGuides), kGuides);
  EXPECT_EQ(nearerToAnother, 0u);
  EXPECT_LT(offScalp, 1e-4);
  // How even: the nearest other place of nearly all is not far below the mean one.
  std::vector<double> nearest;
  for (std::size_t i = 0; i < roots.size(); i += 7) {
    double best = 1;
    for (std::size_t k = 0; k < roots.size(); ++k)
      if (k != i) best = std::min(best, length(roots[k] - roots[i]));
    nearest.push_back(best);
  }
  const double spacing = median(nearest);
  EXPECT_NEAR(spacing, 0.0026, 0.0006);  // 6,000 on the cap
  std::ranges::sort(nearest);
  EXPECT_GT(nearest[nearest.size() / 20], 0.35 * spacing) << "of random places: 0.27";
}

TEST(PlanHairs, CountsNeedNotDivide) {
  const auto rests = restsOf(headOf(7));
  for (const int count : {1, 6, 7, 8, 100}) {
    const auto hairs = planHairs(rests, {.hairCount = count});
    ASSERT_TRUE(hairs);
    EXPECT_EQ(hairs->size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::ranges::is_sorted(*hairs, {}, &FollowHair::guide));
  }
  const auto one = planHairs(std::span(rests).first(1), {.hairCount = 50});
  ASSERT_TRUE(one);
  for (const FollowHair& hair : *one) EXPECT_LE(length(Vec3d(hair.offset)), 0.0025 * 1.001);
}

// Five roots a nanometre apart, a centimetre from the next five: most of the ground is nearer to another.
TEST(PlanHairs, RootsMayBeInClusters) {
  std::vector<GuideRest> rests;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.01 * (i / 5 % 5), y = 0.01 * (i / 25), angle = 2 * std::numbers::pi * (i % 5) / 5;
    const Vec3d root{x + 1e-9 * std::cos(angle), y, 1e-9 * std::sin(angle)};
    rests.push_back(restOfGuide(Strand{root, root + Vec3d{0, -0.1, 0.01}, root + Vec3d{0, -0.2, 0}}));
  }
  rests.push_back(restOfGuide(Strand{{0, 0, 0}, {0, -0.1, 0.01}, {0, -0.2, 0}}));  // in the middle of five
  const auto hairs = planHairs(rests, {.hairCount = 510});
  ASSERT_TRUE(hairs);
  EXPECT_EQ(hairs->size(), 510u);
  EXPECT_LT(length(Vec3d(hairs->back().offset)), 1e-9) << "it has no more ground than that";
}

// A factor on three options, up to what each may be; draws stay the same.
TEST(PlanHairs, FrizzIsAFactor) {
  const auto rests = restsOf(headOf(20));
  const auto plan = [&](const FollowOptions& options) { return *planHairs(rests, options); };
  const auto expectSame = [](const std::vector<FollowHair>& a, const std::vector<FollowHair>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t h = 0; h < a.size(); ++h) {
      EXPECT_EQ(a[h].phase, b[h].phase) << h;
      EXPECT_EQ(a[h].radius, b[h].radius) << h;
      EXPECT_EQ(a[h].length, b[h].length) << h;
      EXPECT_EQ(a[h].spread, b[h].spread) << h;
    }
  };
  expectSame(plan({.hairCount = 900, .frizz = 0}),
             plan({.hairCount = 900, .phase = 0, .radius = 0, .strayShare = 0}));
  expectSame(plan({.hairCount = 900, .frizz = 2}),
             plan({.hairCount = 900, .phase = 0.9, .radius = 0.24, .strayShare = 0.2}));
  expectSame(plan({.hairCount = 900, .phase = 2, .radius = 0.5, .strayShare = 0.3, .frizz = 10}),
             plan({.hairCount = 900, .phase = std::numbers::pi, .radius = 0.9, .strayShare = 1}));
}

// As NearGuides shares them, by so much; nothing else of a hair changes.
TEST(PlanHairs, BlendIsAShare) {
  const auto rests = restsOf(straight(headOf(80), [](Vec3d) { return Vec3d{0, -0.2, 0}; }));
  const auto plan = [&](double blend) { return *planHairs(rests, {.hairCount = 900, .blend = blend}); };
  const auto none = plan(0), half = plan(0.5), all = plan(1);
  const NearGuides near(rests);
  ASSERT_EQ(none.size(), all.size());
  double most = 0;
  for (std::size_t h = 0; h < all.size(); ++h) {
    EXPECT_EQ(none[h].offset, all[h].offset);
    EXPECT_EQ(none[h].phase, all[h].phase);
    EXPECT_EQ(none[h].guide, all[h].guide);
    const GuideRest& guide = rests[all[h].guide];
    const auto inGroom = [](const MeasuringFrame& frame, Vec3f v) {
      return frame.normal * double(v.x) + frame.binormal * double(v.y) + frame.tangent * double(v.z);
    };
    const Vec3d root = guide.root + inGroom(guide.frame, all[h].offset);
    const auto shares = near.sharesAt(root);
    EXPECT_EQ(shares[0].guide, all[h].guide);
    for (std::size_t k = 0; k < 2; ++k) {
      const FollowHair::Other& other = all[h].others[k];
      EXPECT_EQ(none[h].others[k].share, 0);
      EXPECT_NEAR(other.share, shares[k + 1].share, 1e-4);
      EXPECT_NEAR(half[h].others[k].share, 0.5 * shares[k + 1].share, 1e-4);
      if (other.share == 0) continue;
      EXPECT_EQ(other.guide, shares[k + 1].guide);
      const GuideRest& its = rests[other.guide];
      EXPECT_LT(length(its.root + inGroom(its.frame, other.offset) - root), 1e-7);
    }
    most = std::max(most, double(all[h].others[0].share));
  }
  EXPECT_GT(most, 0.3);
  EXPECT_LE(most, 0.5 + 1e-6) << "the guide itself is nearest";
}

// Hair combed to both sides: blends keep to theirs.
TEST(PlanHairs, GuidesThatPartAreNotBlended) {
  const auto rests = restsOf(straight(headOf(200), [](Vec3d root) {
    return Vec3d{root.x < 0 ? -0.1 : 0.1, -0.2, 0};
  }));
  const auto hairs = planHairs(rests, {.hairCount = 4000, .blend = 1});
  ASSERT_TRUE(hairs);
  std::size_t blended = 0;
  for (const FollowHair& hair : *hairs) {
    const bool isLeft = rests[hair.guide].root.x < 0;
    for (const FollowHair::Other& other : hair.others) {
      if (other.share == 0) continue;
      ++blended;
      EXPECT_EQ(rests[other.guide].root.x < 0, isLeft);
    }
  }
  EXPECT_GT(blended, 2000u);
}

// Each piece of a guide goes its own way once it is cut.
TEST(PlanHairs, GuidesThatAreCutAreNotBlended) {
  auto rests = restsOf(headOf(100));
  for (std::size_t g = 0; g < rests.size(); g += 3) rests[g].pieces = {4};
  const auto hairs = planHairs(rests, {.hairCount = 2000, .blend = 1});
  ASSERT_TRUE(hairs);
  std::size_t blended = 0;
  for (const FollowHair& hair : *hairs) {
    for (const FollowHair::Other& other : hair.others) {
      if (other.share == 0) continue;
      ++blended;
      EXPECT_TRUE(rests[hair.guide].pieces.empty() && rests[other.guide].pieces.empty());
    }
  }
  EXPECT_GT(blended, 500u);
}

TEST(PlanHairs, OptionsSayHowHairsDiffer) {
  const auto rests = restsOf(headOf(20));
  const auto plan = [&](const FollowOptions& options) { return *planHairs(rests, options); };
  const auto alike =
      plan({.hairCount = 2000, .phase = 0, .radius = 0, .length = 0, .gather = 0, .strayShare = 0});
  for (const FollowHair& hair : alike) {
    EXPECT_EQ(hair.phase, 0);
    EXPECT_EQ(hair.radius, 1);
    EXPECT_EQ(hair.length, 1);
    EXPECT_EQ(hair.spread, 1);
  }
  const auto hairs = plan({.hairCount = 2000});
  const auto strays = std::ranges::count(hairs, 1.4f, &FollowHair::spread);
  EXPECT_NEAR(static_cast<double>(strays), 200, 60);
  double widest = 0, narrowest = 2, shortest = 2, turned = 0;
  for (const FollowHair& hair : hairs) {
    widest = std::max(widest, double(hair.radius));
    narrowest = std::min(narrowest, double(hair.radius));
    shortest = std::min(shortest, double(hair.length));
    if (hair.spread < 1.4f) turned = std::max(turned, std::abs(double(hair.phase)));
  }
  EXPECT_NEAR(widest, 1.12, 0.005);
  EXPECT_NEAR(narrowest, 0.88, 0.005);
  EXPECT_NEAR(shortest, 0.85, 0.005);
  EXPECT_NEAR(turned, 0.43, 0.03);
  const auto again = plan({.hairCount = 2000}), other = plan({.hairCount = 2000, .seed = 2});
  const auto isSame = [](const FollowHair& a, const FollowHair& b) {
    return a.offset == b.offset && a.phase == b.phase && a.radius == b.radius && a.length == b.length &&
           a.spread == b.spread;
  };
  EXPECT_TRUE(std::ranges::equal(hairs, again, isSame));
  EXPECT_FALSE(std::ranges::equal(hairs, other, isSame));
}

TEST(PlanHairs, RootsStayWithinReach) {
  const auto rests = restsOf(headOf(20));
  const auto farthest = [&](double reach) {
    double distance = 0;
    const auto hairs = *planHairs(rests, {.hairCount = 2000, .reach = reach});
    for (const FollowHair& hair : hairs) distance = std::max(distance, length(Vec3d(hair.offset)));
    return distance;
  };
  EXPECT_NEAR(farthest(0.0025), 0.0025, 0.0002) << "also where the scalp is steep";
  EXPECT_GT(farthest(1), 0.01) << "else as far as the guide's part of the scalp";
}

TEST(PlanHairs, RefusesWhatMakesNoSense) {
  const auto rests = restsOf(headOf(3));
  const auto refusal = [&](const FollowOptions& options) {
    return planHairs(rests, options).error().message;
  };
  EXPECT_EQ(refusal({.hairCount = 0}), "the number of hairs is 0; it must be between 1 and 10000000");
  EXPECT_EQ(refusal({.reach = 0}).find("the reach of hairs [m] is 0;"), 0u);
  EXPECT_EQ(refusal({.phase = -1}).find("the largest turn of a hair's curl is -1;"), 0u);
  EXPECT_EQ(refusal({.radius = 1}).find("the variation of the curl radius is 1;"), 0u);
  EXPECT_EQ(refusal({.length = std::nan("")}).find("the variation of the length is nan;"), 0u);
  EXPECT_EQ(refusal({.gather = 2}).find("the share by which hairs gather is 2;"), 0u);
  EXPECT_EQ(refusal({.strayShare = -0.1}).find("the share of strays is -0.1;"), 0u);
  EXPECT_EQ(refusal({.frizz = 11}).find("the frizz of hairs is 11;"), 0u);
  EXPECT_EQ(planHairs({}, {}).error().message, "there is no guide that hairs could follow");
}

}  // namespace
}  // namespace ringlet
