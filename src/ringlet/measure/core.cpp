// Implements measure/core.h.
//
//   points      o--o--o--o--o--o--o--o--o--o
//   mean once   . . ----o--o--o--o--o---- . .     exists where the window fits; dots: gone on straight
//   mean twice  o--o--o--o--o--o--o--o--o--o      the window fits everywhere
#include "ringlet/measure/core.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

// Share of a straight strand over which it is smoothed.
constexpr double kStraightWindowShare = 0.1;

// The slope at an end of the first mean is not used if it spans less than this share of the window.
constexpr double kShortestSlope = 1e-6;

// A polyline as a curve over a coordinate, and its integral, piecewise quadratic.
class Curve {
 public:
  Curve(std::span<const Vec3d> points, std::span<const double> at)
      : points_(points.begin(), points.end()), at_(at.begin(), at.end()), integral_(points.size()) {
    for (std::size_t i = 1; i < points_.size(); ++i) {
      integral_[i] = integral_[i - 1] + (points_[i - 1] + points_[i]) * ((at_[i] - at_[i - 1]) / 2);
    }
  }

  Vec3d mean(double from, double to) const { return (integralTo(to) - integralTo(from)) / (to - from); }

  Vec3d pointAt(double s) const {
    const std::size_t i = edgeAt(s);
    const double span = at_[i + 1] - at_[i];
    const double share = span > 0 ? std::clamp((s - at_[i]) / span, 0.0, 1.0) : 0;
    return points_[i] + (points_[i + 1] - points_[i]) * share;
  }

 private:
  std::size_t edgeAt(double s) const {
    const auto above = std::upper_bound(at_.begin() + 1, at_.end() - 1, s);
    return static_cast<std::size_t>(above - at_.begin()) - 1;
  }
  Vec3d integralTo(double s) const {
    const std::size_t i = edgeAt(s);
    return integral_[i] + (points_[i] + pointAt(s)) * ((s - at_[i]) / 2);
  }

  std::vector<Vec3d> points_;
  std::vector<double> at_;
  std::vector<Vec3d> integral_;  // from the first point to each
};

// `v` turned by the smallest rotation that takes the unit vector `from` to `to`; about any axis if opposite.
Vec3d turnedWith(Vec3d v, Vec3d from, Vec3d to) {
  const double cosine = dot(from, to);
  if (cosine < -1 + 1e-12) {
    const Vec3d axis = anyNormal(from);
    return axis * (2 * dot(axis, v)) - v;
  }
  const Vec3d axis = cross(from, to);
  return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1 + cosine));
}

// Central differences; where they have no length, the tangent of the neighbour.
std::vector<Vec3d> tangentsOf(std::span<const Vec3d> core) {
  const std::size_t count = core.size();
  std::vector<Vec3d> tangents(count);
  Vec3d last{};
  std::size_t firstKnown = count;
  for (std::size_t i = 0; i < count; ++i) {
    last = normalizedOr(core[std::min(i + 1, count - 1)] - core[i == 0 ? 0 : i - 1], last);
    tangents[i] = last;
    if (firstKnown == count && dot(last, last) > 0) firstKnown = i;
  }
  const Vec3d first = firstKnown < count ? tangents[firstKnown] : Vec3d{0, 0, 1};
  std::fill(tangents.begin(), tangents.begin() + static_cast<std::ptrdiff_t>(firstKnown), first);
  return tangents;
}

}  // namespace

std::vector<double> arcPositions(std::span<const Vec3d> rest) {
  std::vector<double> arcs(rest.empty() ? 0 : rest.size() - 1), positions(rest.size());
  measureArcs(rest, arcs);
  for (std::size_t i = 0; i < arcs.size(); ++i) positions[i + 1] = positions[i] + arcs[i];
  return positions;
}

double coreWindow(const CurlShape& shape, double arcLength) {
  return shape.turns > 0 ? std::min(shape.turnLength, arcLength) : kStraightWindowShare * arcLength;
}

std::vector<Vec3d> smoothCore(std::span<const Vec3d> points, std::span<const double> arcPositions,
                              double window) {
  RINGLET_ASSERT(points.size() >= 2 && points.size() == arcPositions.size(), "one arc position per particle");
  const double end = arcPositions.back();
  RINGLET_ASSERT(window > 0 && window <= end, "the window fits into the strand");
  const Curve strand(points, arcPositions);

  // The first mean, where the window fits.
  const double half = window / 2;
  const double first = half, last = std::max(half, end - half);
  auto meanAt = [&](double s) { return strand.mean(s - half, std::min(s + half, end)); };
  std::vector<double> at{first};
  std::vector<Vec3d> means{meanAt(first)};
  for (double s : arcPositions) {
    if (s <= first || s >= last) continue;
    at.push_back(s);
    means.push_back(meanAt(s));
  }
  if (last > first) {
    at.push_back(last);
    means.push_back(meanAt(last));
  }

  // Extend the mean straight at both ends, with the slope of the mean there; if the mean is a single point,
  // with that of the whole strand.
  Vec3d rootSlope = (strand.pointAt(window) - strand.pointAt(0)) / window, tipSlope = rootSlope;
  const double reach = std::min(window, last - first);
  if (reach > kShortestSlope * window) {
    rootSlope = (meanAt(first + reach) - means.front()) / reach;
    tipSlope = (means.back() - meanAt(last - reach)) / reach;
  }
  at.insert(at.begin(), -half);
  means.insert(means.begin(), means.front() - rootSlope * window);
  at.push_back(end + half);
  means.push_back(means.back() + tipSlope * (end + half - last));

  // The second mean, at the particles.
  const Curve once(means, at);
  std::vector<Vec3d> core;
  core.reserve(points.size());
  for (double s : arcPositions) core.push_back(once.mean(s - half, s + half));
  return core;
}

MeasuringFrame rootFrameOf(std::span<const Vec3d> core) {
  const Vec3d tangent = tangentsOf(core).front();
  const Vec3d normal = anyNormal(tangent);
  return {normal, cross(tangent, normal), tangent};
}

MeasuringFrame rotated(const MeasuringFrame& frame, Quatd rotation) {
  return {rotate(rotation, frame.normal), rotate(rotation, frame.binormal), rotate(rotation, frame.tangent)};
}

std::vector<MeasuringFrame> framesAlong(std::span<const Vec3d> core, const MeasuringFrame& root) {
  std::vector<MeasuringFrame> frames;
  frames.reserve(core.size());
  Vec3d normal = root.normal, before = root.tangent;
  for (Vec3d tangent : tangentsOf(core)) {
    normal = turnedWith(normal, before, tangent);
    normal = normalizedOr(normal - tangent * dot(normal, tangent), anyNormal(tangent));
    frames.push_back({normal, cross(tangent, normal), tangent});
    before = tangent;
  }
  return frames;
}

}  // namespace ringlet
