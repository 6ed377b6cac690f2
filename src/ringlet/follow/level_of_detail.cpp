// Implements follow/level_of_detail.h.
#include "ringlet/follow/level_of_detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/follow/own_points.h"
#include "ringlet/follow/pick_guides.h"
#include "ringlet/follow/rest_shape.h"

namespace ringlet {
namespace {

constexpr std::size_t kCandidates = 4;  // guides that a strand is compared with
constexpr std::size_t kFitPart = 64;    // strands that a thread takes at once
constexpr double kFitFrom = 0.4;        // from here to the tip a hair is all in its guide's frame (follow.h)
constexpr double kLeastLength = 0.05, kMostFitRadius = 4, kMostSpread = 4;  // of a fit
constexpr double kLeastPart = 1e-6;  // of squares: less is rounding, and fits nothing

std::vector<Vec3d> metresOf(const Groom& groom, std::size_t strand) {
  std::vector<Vec3d> points;
  for (const Vec3f& p : groom.strand(strand)) points.push_back(Vec3d(p) * groom.metresPerUnit);
  return points;
}

Status checkStrands(const Groom& groom) {
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const auto strand = groom.strand(s);
    if (std::ranges::any_of(strand, [&](const Vec3f& p) { return !(p == strand.front()); })) continue;
    return Error{fmt::format(
        "strand {} of the groom has no length, so that it can neither lead nor follow; `ringlet info --fix` "
        "drops such strands",
        s + 1)};
  }
  return {};
}

// Of a curve with a point a particle, where share is 0 at the root and 1 at the tip.
Vec3d at(std::span<const Vec3d> curve, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * double(curve.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), curve.size() - 2);
  return curve[i] + (curve[i + 1] - curve[i]) * (place - double(i));
}

struct Fit {
  FollowHair hair;       // but for the guide's number
  double distance2 = 0;  // mean square from the strand's own points [m^2]
};

// What a point of a hair is made of where r = 1 (reference/equations/follow.h): with z the guide's curl,
//
//     point - core = spread F d + a F (z_x, z_y, 0) + b F (-z_y, z_x, 0) + radius F (0, 0, z_z)
//
// and a, b = radius cos phase, radius sin phase.
struct FitSample {
  Vec3d shift, curl, turned, rise, wanted;  // F d, the three after it without their factors, point - core
};

std::vector<FitSample> samplesOf(const RestShape& guide, const RestShape& strand, const FollowHair& hair) {
  std::vector<FitSample> samples;
  const std::size_t last = guide.points.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double share = double(i) / double(last);
    if (share < kFitFrom) continue;
    const double there = hair.length * share;
    const MeasuringFrame& frame = guide.frames[static_cast<std::size_t>(std::lround(there * double(last)))];
    const Vec3d z = at(guide.curl, there);
    samples.push_back({outOfFrame(frame, Vec3d(hair.offset)), outOfFrame(frame, {z.x, z.y, 0}),
                       outOfFrame(frame, {-z.y, z.x, 0}), outOfFrame(frame, {0, 0, z.z}),
                       at(strand.points, share) - at(guide.core, there)});
  }
  return samples;
}

// How a strand follows so much of a guide: least squares in spread, a and b, the curl's rise along the core
// left out. Curl and turned are at right angles and of one length.
Fit fitTo(const RestShape& guide, const RestShape& strand, double shareOfGuide) {
  Fit fit;
  FollowHair& hair = fit.hair;
  hair.offset = Vec3f(inFrame(guide.frames.front(), strand.points.front() - guide.points.front()));
  hair.length = static_cast<float>(std::clamp(shareOfGuide, kLeastLength, 1.0));
  const std::vector<FitSample> samples = samplesOf(guide, strand, hair);
  const auto sum = [&](Vec3d FitSample::*x, Vec3d FitSample::*y) {
    double total = 0;
    for (const FitSample& s : samples) total += dot(s.*x, s.*y);
    return total;
  };
  using S = FitSample;
  const double curls = sum(&S::curl, &S::curl), shifts = sum(&S::shift, &S::shift);
  const double onCurl = sum(&S::shift, &S::curl), onTurned = sum(&S::shift, &S::turned);
  const double ofCurl = sum(&S::wanted, &S::curl), ofTurned = sum(&S::wanted, &S::turned);
  const bool isCurled = curls > kLeastPart * guide.coreLength * guide.coreLength;
  const double part = isCurled ? 1 / curls : 0;  // of a straight guide there is nothing to turn
  const double own = shifts - part * (onCurl * onCurl + onTurned * onTurned);
  const double spread =
      own > kLeastPart * shifts
          ? (sum(&S::wanted, &S::shift) - part * (onCurl * ofCurl + onTurned * ofTurned)) / own
          : 1.0;
  hair.spread = static_cast<float>(std::clamp(spread, 0.0, kMostSpread));
  if (isCurled) {
    const double a = part * (ofCurl - hair.spread * onCurl), b = part * (ofTurned - hair.spread * onTurned);
    hair.phase = static_cast<float>(std::atan2(b, a));
    hair.radius = static_cast<float>(std::min(std::hypot(a, b), kMostFitRadius));
  }
  for (const FitSample& s : samples) {
    const Vec3d error =
        s.wanted - s.shift * hair.spread -
        (s.curl * std::cos(hair.phase) + s.turned * std::sin(hair.phase) + s.rise) * hair.radius;
    fit.distance2 += dot(error, error) / double(samples.size());
  }
  return fit;
}

// With the cores' lengths, which are uncertain by some of a turn at the tip.
Fit fitTo(const RestShape& guide, const RestShape& strand) {
  return fitTo(guide, strand, strand.coreLength / guide.coreLength);
}
// The same with the length that fits best.
Fit refined(Fit best, const RestShape& guide, const RestShape& strand) {
  const std::uint32_t number = best.hair.guide;
  for (const double step : {0.02, 0.005}) {
    const double middle = best.hair.length;
    for (int k = -3; k <= 3; ++k) {
      const Fit fit = fitTo(guide, strand, middle * (1 + k * step));
      if (fit.distance2 < best.distance2) best = fit;
    }
  }
  best.hair.guide = number;
  return best;
}

// A strand whose guides are looked for, and those it is most like, nearest first.
struct Candidates {
  const StrandTraits& traits;
  std::span<const RestShape> shapes;
  std::span<const std::uint32_t> guides;
  std::size_t strand;
  std::vector<std::uint32_t> near = traits.nearest(strand, guides, kCandidates);

  const RestShape& own() const { return shapes[strand]; }
  const RestShape& guide(std::uint32_t number) const { return shapes[guides[number]]; }
  double distance(std::uint32_t number) const {
    return std::sqrt(traits.apart(strand, guides[number]));
  }  // [m]
};

// The candidate that fits best.
FollowHair fittedHair(const Candidates& of) {
  Fit best{{}, std::numeric_limits<double>::infinity()};
  for (const std::uint32_t g : of.near) {
    Fit fit = fitTo(of.guide(g), of.own());
    fit.hair.guide = g;
    if (fit.distance2 < best.distance2) best = fit;
  }
  return refined(best, of.guide(best.hair.guide), of.own()).hair;
}

// What the three nearest have in its core, which vanishes where one is as far as the fourth (Franke and
// Nielson 1980).
void blend(const Candidates& of, FollowHair& hair) {
  if (of.near.size() < kCandidates) return;
  const double reach = of.distance(of.near.back());
  std::array<double, kCandidates - 1> shares{};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double distance = std::max(of.distance(of.near[k]), kLeastPart * reach);
    shares[k] = std::pow(std::max(reach - distance, 0.0) / (reach * distance), 2);
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  auto other = hair.others.begin();
  for (std::size_t k = 0; k < shares.size() && other != hair.others.end(); ++k) {
    if (of.near[k] == hair.guide || !(shares[k] > 0)) continue;
    const RestShape& its = of.guide(of.near[k]);
    *other++ = {of.near[k], static_cast<float>(shares[k] / sum),
                Vec3f(inFrame(its.frames.front(), of.own().points.front() - its.points.front()))};
  }
}

std::vector<RestShape> shapesOf(const Groom& groom) {
  std::vector<RestShape> shapes(groom.strandCount());
  eachInParallel(coreCount(), shapes.size(), kFitPart, [&](std::size_t s) {
    std::vector<Vec3d> points = metresOf(groom, s);
    const GuideRest rest = restOfGuide(points);
    shapes[s] = restShapeOf(std::move(points), rest);
  });
  return shapes;
}

LevelOfDetail levelOf(const Groom& groom, std::span<const RestShape> shapes, const StrandTraits& traits,
                      std::vector<std::uint32_t> guides) {
  LevelOfDetail level;
  level.groom.metresPerUnit = groom.metresPerUnit;
  std::vector<RestShape> ofGuides;
  for (const std::uint32_t s : guides) {
    level.groom.addStrand(groom.strand(s));
    ofGuides.push_back(shapes[s]);
  }
  level.hairs.resize(shapes.size());
  const auto follow = [&](std::size_t s) {
    const Candidates candidates{traits, shapes, guides, s};
    level.hairs[s] = fittedHair(candidates);
    blend(candidates, level.hairs[s]);
  };
  std::vector<std::vector<OwnPoint>> own(shapes.size());
  eachInParallel(coreCount(), shapes.size(), kFitPart, [&](std::size_t s) {
    const auto guide = std::ranges::lower_bound(guides, static_cast<std::uint32_t>(s));
    if (guide != guides.end() && *guide == s)
      level.hairs[s].guide = static_cast<std::uint32_t>(guide - guides.begin());
    else
      follow(s);
    own[s] = ownPointsOf(level.hairs[s], shapes[s].points, ofGuides);
  });
  level.own.firstPoint = groom.firstPoint;
  for (const auto& each : own) level.own.points.insert(level.own.points.end(), each.begin(), each.end());
  level.guides = std::move(guides);
  return level;
}

}  // namespace

void LevelOfDetail::leaveOutGuides() {
  RINGLET_ASSERT(!guides.empty() && guides.front() + guides.size() == hairs.size(),
                 "guides are not the last");
  hairs.resize(guides.front());
  own.firstPoint.resize(guides.front() + 1);
  own.points.resize(own.firstPoint.back());
  guides.clear();
}

void LevelOfDetail::addSample(const Groom& whole, std::size_t count) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t s = 0; s < hairs.size(); ++s)
    if (!std::ranges::binary_search(guides, s)) others.push_back(s);
  count = std::min(count, others.size());
  for (std::size_t k = 0; k < count; ++k) {
    sample.push_back(others[(2 * k + 1) * others.size() / (2 * count)]);
    groom.addStrand(whole.strand(sample.back()));
  }
}

Result<LevelOfDetail> levelOfDetail(const Groom& groom, double share) {
  if (!(share > 0 && share <= 1))
    return Error{fmt::format(
        "a share of {} of the strands cannot be simulated; it must be above 0 and at most 1", share)};
  const auto wanted = std::lround(share * static_cast<double>(groom.strandCount()));
  return levelOfDetailOfCount(groom, static_cast<std::size_t>(std::max(1l, wanted)));
}

Result<LevelOfDetail> levelOfDetailOfCount(const Groom& groom, std::size_t count) {
  if (Status checked = checkStrands(groom); !checked) return checked.error();
  const std::vector<RestShape> shapes = shapesOf(groom);
  const StrandTraits traits(shapes);
  return levelOf(groom, shapes, traits, pickGuides(traits, count));
}

Result<LevelOfDetail> levelOfDetailOfGuides(const Groom& groom, std::vector<std::uint32_t> guides) {
  if (Status checked = checkStrands(groom); !checked) return checked.error();
  const std::vector<RestShape> shapes = shapesOf(groom);
  return levelOf(groom, shapes, StrandTraits(shapes), std::move(guides));
}

}  // namespace ringlet
