// Implements follow/level_of_detail.h.
#include "ringlet/follow/level_of_detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "ringlet/follow/guide_rest.h"
#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/sample_elimination.h"

namespace ringlet {
namespace {

constexpr std::size_t kCandidates = 4;  // guides that a strand is compared with
constexpr double kFitFrom = 0.4;        // from here to the tip a hair is all in its guide's frame (follow.h)
constexpr double kLeastLength = 0.05, kMostFitRadius = 4, kMostSpread = 4;  // of a fit
constexpr double kLeastPart = 1e-6;  // of squares: less is rounding, and fits nothing

// A strand at rest [m], and what a hair takes from it: its core and, along the frames on the core, its curl.
struct Shape {
  std::vector<Vec3d> points, core, curl;
  std::vector<MeasuringFrame> frames;
  double coreLength = 0;
};

Vec3d inFrame(const MeasuringFrame& frame, Vec3d v) {
  return {dot(v, frame.normal), dot(v, frame.binormal), dot(v, frame.tangent)};
}
Vec3d along(const MeasuringFrame& frame, Vec3d v) {
  return frame.normal * v.x + frame.binormal * v.y + frame.tangent * v.z;
}

std::vector<Vec3d> metresOf(const Groom& groom, std::size_t strand) {
  std::vector<Vec3d> points;
  for (const Vec3f& p : groom.strand(strand)) points.push_back(Vec3d(p) * groom.metresPerUnit);
  return points;
}

Shape shapeOf(std::vector<Vec3d> points, const GuideRest& rest) {
  Shape shape{.points = std::move(points), .core = {}, .curl = {}, .frames = {}};
  shape.core = smoothCore(shape.points, rest.arcs, rest.window);
  shape.frames = framesAlong(shape.core, rest.frame);
  for (std::size_t i = 1; i < shape.core.size(); ++i)
    shape.coreLength += length(shape.core[i] - shape.core[i - 1]);
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    shape.curl.push_back(inFrame(shape.frames[i], shape.points[i] - shape.core[i]));
  return shape;
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

// The area that so many roots are spread over, as if they were as far apart as in a square grid [m^2]; any
// area where all are in one place.
double areaUnder(std::span<const GuideRest> strands, const NearGuides& near) {
  double sum = 0;
  for (const GuideRest& strand : strands) {
    for (const NearGuides::Near& other : near.at(strand.root, kCandidates)) {
      if (other.distance == 0) continue;  // itself, or another in the same place
      sum += other.distance * other.distance;
      break;
    }
  }
  return sum > 0 ? sum : 1;
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

std::vector<FitSample> samplesOf(const Shape& guide, const Shape& strand, const FollowHair& hair) {
  std::vector<FitSample> samples;
  const std::size_t last = guide.points.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double share = double(i) / double(last);
    if (share < kFitFrom) continue;
    const double there = hair.length * share;
    const MeasuringFrame& frame = guide.frames[static_cast<std::size_t>(std::lround(there * double(last)))];
    const Vec3d z = at(guide.curl, there);
    samples.push_back({along(frame, Vec3d(hair.offset)), along(frame, {z.x, z.y, 0}),
                       along(frame, {-z.y, z.x, 0}), along(frame, {0, 0, z.z}),
                       at(strand.points, share) - at(guide.core, there)});
  }
  return samples;
}

// How a strand follows so much of a guide: least squares in spread, a and b, the curl's rise along the core
// left out. Curl and turned are at right angles and of one length.
Fit fitTo(const Shape& guide, const Shape& strand, double shareOfGuide) {
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
Fit fitTo(const Shape& guide, const Shape& strand) {
  return fitTo(guide, strand, strand.coreLength / guide.coreLength);
}
// The same with the length that fits best.
Fit refined(Fit best, const Shape& guide, const Shape& strand) {
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

}  // namespace

Result<LevelOfDetail> levelOfDetail(const Groom& groom, double share) {
  if (!(share > 0 && share <= 1))
    return Error{fmt::format(
        "a share of {} of the strands cannot be simulated; it must be above 0 and at most 1", share)};
  if (Status checked = checkStrands(groom); !checked) return checked.error();
  const std::size_t count = groom.strandCount();
  std::vector<Shape> shapes;
  std::vector<GuideRest> rests;
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < count; ++s) {
    std::vector<Vec3d> points = metresOf(groom, s);
    rests.push_back(restOfGuide(points));
    roots.push_back(points.front());
    shapes.push_back(shapeOf(std::move(points), rests.back()));
  }
  LevelOfDetail level;
  const auto wanted = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(share * double(count))));
  level.guides = eliminateSamples(roots, wanted, areaUnder(rests, NearGuides(rests)));
  std::vector<GuideRest> guideRests;
  std::vector<std::int64_t> guideOf(count, -1);
  for (const std::uint32_t s : level.guides) {
    guideOf[s] = static_cast<std::int64_t>(guideRests.size());
    guideRests.push_back(rests[s]);
    level.groom.addStrand(groom.strand(s));
  }
  level.groom.metresPerUnit = groom.metresPerUnit;
  const NearGuides near(guideRests);
  for (std::size_t s = 0; s < count; ++s) {
    Fit best{{}, std::numeric_limits<double>::infinity()};
    if (guideOf[s] >= 0) {
      best.hair.guide = static_cast<std::uint32_t>(guideOf[s]);
    } else {
      for (const auto& [distance, g] : near.at(roots[s], kCandidates)) {
        Fit fit = fitTo(shapes[level.guides[g]], shapes[s]);
        fit.hair.guide = g;
        if (fit.distance2 < best.distance2) best = fit;
      }
      best = refined(best, shapes[level.guides[best.hair.guide]], shapes[s]);
    }
    level.hairs.push_back(best.hair);
  }
  return level;
}

}  // namespace ringlet
