// Implements measure/shape_distance.h.
#include "ringlet/measure/shape_distance.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/measure/core.h"

namespace ringlet {
namespace {

// Root mean square distance of two curves with the same arc positions.
double meanDistance(std::span<const Vec3d> a, std::span<const Vec3d> b, std::span<const double> at) {
  auto squareAt = [&](std::size_t i) { return dot(a[i] - b[i], a[i] - b[i]); };
  double sum = 0;
  for (std::size_t i = 1; i < at.size(); ++i)
    sum += (squareAt(i - 1) + squareAt(i)) / 2 * (at[i] - at[i - 1]);
  return std::sqrt(sum / at.back());
}

// 0 if either has no direction.
double degreesBetween(Vec3d a, Vec3d b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

// The measures of a pose of the groom.
struct Pose {
  std::span<const Vec3f> points;
  Quatd headRotation;
  std::vector<StrandMeasure> strands;
};

Result<Pose> measurePose(const GroomRuler& ruler, std::span<const Vec3f> points, double metresPerUnit) {
  RINGLET_ASSERT(points.size() == ruler.particleCount(), "one point per particle of the groom");
  const Quatd headRotation = ruler.headRotationOf(points, metresPerUnit);
  auto strands = ruler.measure(points, metresPerUnit, {0, 1, 0}, headRotation);
  if (!strands) return strands.error();
  return Pose{points, headRotation, std::move(*strands)};
}

// A strand with its root at the origin, in the head's frame [m].
std::vector<Vec3d> strandFromHead(const GroomRuler& ruler, const Pose& pose, double metresPerUnit,
                                  std::size_t s) {
  std::vector<Vec3d> strand = ruler.strandIn(pose.points, metresPerUnit, s);
  const Vec3d root = strand.front();
  for (Vec3d& p : strand) p = rotate(pose.headRotation.conjugate(), p - root);
  return strand;
}

}  // namespace

Result<std::vector<ShapeDistance>> shapeDistances(const GroomRuler& ruler, std::span<const Vec3f> points,
                                                  std::span<const Vec3f> other, double metresPerUnit) {
  const auto here = measurePose(ruler, points, metresPerUnit);
  if (!here) return here.error();
  const auto there = measurePose(ruler, other, metresPerUnit);
  if (!there) return there.error();

  std::vector<ShapeDistance> distances(ruler.strandCount());
  for (std::size_t s = 0; s < distances.size(); ++s) {
    const StrandRuler& strand = ruler.strand(s);
    const std::span<const double> at = strand.arcPositions();
    const double arcLength = strand.arcLength(), window = coreWindow(strand.shape(), arcLength);
    const std::vector<Vec3d> a = strandFromHead(ruler, *here, metresPerUnit, s);
    const std::vector<Vec3d> b = strandFromHead(ruler, *there, metresPerUnit, s);
    const std::vector<Vec3d> coreA = smoothCore(a, at, window), coreB = smoothCore(b, at, window);

    ShapeDistance& distance = distances[s];
    distance.particles = meanDistance(a, b, at) / arcLength;
    distance.tip = length(a.back() - b.back()) / arcLength;
    distance.core = meanDistance(coreA, coreB, at) / arcLength;
    distance.direction = degreesBetween(coreA.back() - coreA.front(), coreB.back() - coreB.front());
    if (strand.shape().turns == 0) continue;
    distance.turns = (here->strands[s].turns - there->strands[s].turns) / strand.rest().turns;
    distance.radius = (here->strands[s].meanRadius - there->strands[s].meanRadius) / strand.rest().meanRadius;
  }
  return distances;
}

}  // namespace ringlet
