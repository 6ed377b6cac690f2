// Implements motion/sampled_mesh.h.
#include "ringlet/motion/sampled_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ringlet {
namespace {

Status checkTimes(const std::vector<double>& seconds) {
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    if (!std::isfinite(seconds[k]) || (k > 0 && !(seconds[k] > seconds[k - 1])))
      return Error{fmt::format("sample {} is at {} s; expected a time after that of the sample before", k + 1,
                               seconds[k])};
  }
  return {};
}

Status checkPoses(const PointSamples& samples) {
  const std::size_t count = samples.seconds.size(), poses = samples.points.size() / samples.pointCount;
  const bool isEach = samples.poses.empty() ? poses == count : samples.poses.size() == count;
  if (!isEach || samples.points.size() != poses * samples.pointCount)
    return Error{fmt::format("found {} points in {} samples; expected {} in each", samples.points.size(),
                             count, samples.pointCount)};
  for (const std::uint32_t pose : samples.poses)
    if (pose >= poses)
      return Error{fmt::format("a sample has pose {}; expected at most {}", pose, poses - 1)};
  return {};
}

Status checkSamples(const std::vector<MeshMotion::Triangle>& triangles, const PointSamples& samples,
                    const PlacementSamples& placed) {
  const std::size_t count = samples.seconds.size();
  if (triangles.empty()) return Error{"it has no triangles"};
  if (count == 0 || samples.pointCount == 0) return Error{"it has no samples of points"};
  if (Status checked = checkPoses(samples); !checked) return checked;
  if (Status checked = checkTimes(samples.seconds); !checked) return checked;
  if (Status checked = checkPlacements(placed); !checked) return checked;
  for (const MeshMotion::Triangle& triangle : triangles) {
    const std::uint32_t last = *std::ranges::max_element(triangle);
    if (last >= samples.pointCount)
      return Error{
          fmt::format("a triangle has the corner {}; expected at most {}, since samples have {} points", last,
                      samples.pointCount - 1, samples.pointCount)};
  }
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    if (!isFinite(samples.points[i]))
      return Error{fmt::format("point {} of sample {} is not finite", i % samples.pointCount,
                               i / samples.pointCount + 1)};
  }
  return {};
}

// Sample k at or before a time, and the share of the way to the next; k = 0 before the first.
struct Between {
  std::size_t k = 0;
  double share = 0;
};
Between between(const std::vector<double>& seconds, double t) {
  const auto after = std::ranges::upper_bound(seconds, t) - seconds.begin();
  if (after == 0) return {};
  const auto k = static_cast<std::size_t>(after - 1);
  if (k + 1 == seconds.size()) return {k, 0};
  return {k, (t - seconds[k]) / (seconds[k + 1] - seconds[k])};
}

Vec3d mixed(Vec3d a, Vec3d b, double share) { return a + (b - a) * share; }

}  // namespace

Status checkPlacements(const PlacementSamples& placed) {
  if (placed.placements.empty() || placed.placements.size() != placed.seconds.size())
    return Error{fmt::format("found {} placements at {} times; expected one at each",
                             placed.placements.size(), placed.seconds.size())};
  if (Status checked = checkTimes(placed.seconds); !checked) return checked;
  if (!std::ranges::all_of(placed.placements, &Affine::isFinite)) return Error{"a placement is not finite"};
  return {};
}

Affine placementAt(const PlacementSamples& placed, double t) {
  const auto [k, share] = between(placed.seconds, t);
  const Affine& a = placed.placements[k];
  if (share == 0) return a;
  const Affine& b = placed.placements[k + 1];
  return {mixed(a.x, b.x, share), mixed(a.y, b.y, share), mixed(a.z, b.z, share),
          mixed(a.position, b.position, share)};
}

Result<SampledMesh> SampledMesh::of(std::vector<Triangle> triangles, PointSamples samples,
                                    PlacementSamples placed, std::vector<std::string> warnings) {
  if (Status checked = checkSamples(triangles, samples, placed); !checked) return checked.error();
  SampledMesh mesh;
  mesh.triangles_ = std::move(triangles);
  mesh.samples_ = std::move(samples);
  mesh.placed_ = std::move(placed);
  mesh.warnings_ = std::move(warnings);
  return mesh;
}

// One sample holds at all times and has no first one.
double SampledMesh::firstSeconds() const {
  if (placed_.seconds.size() < 2) return samples_.seconds.front();
  if (samples_.seconds.size() < 2) return placed_.seconds.front();
  return std::min(samples_.seconds.front(), placed_.seconds.front());
}
double SampledMesh::lastSeconds() const {
  if (placed_.seconds.size() < 2) return samples_.seconds.back();
  if (samples_.seconds.size() < 2) return placed_.seconds.back();
  return std::max(samples_.seconds.back(), placed_.seconds.back());
}

const Vec3f* SampledMesh::poseOf(std::size_t sample) const {
  const std::size_t pose = samples_.poses.empty() ? sample : samples_.poses[sample];
  return samples_.points.data() + pose * pointCount();
}

std::vector<Vec3d> SampledMesh::pointsAt(double t) const {
  const auto [k, share] = between(samples_.seconds, t);
  const Affine placement = placementAt(placed_, t);
  const Vec3f* before = poseOf(k);
  const Vec3f* next = share > 0 ? poseOf(k + 1) : before;
  std::vector<Vec3d> points;
  points.reserve(pointCount());
  for (std::size_t p = 0; p < pointCount(); ++p)
    points.push_back(placement(mixed(Vec3d(before[p]), Vec3d(next[p]), share)));
  return points;
}

}  // namespace ringlet
