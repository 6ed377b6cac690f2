// Implements bodies/head_mesh.h: a smooth union of a few shapes, seen from the scalp's middle. Every
// direction has one place on the surface, where its ray leaves the union for the last time, so that the mesh
// of a sphere moved there stays closed.
//
//         .---.
//       .'     '.      scalp: the sphere itself above the hairline
//   ---:    o    \     .
//      :          >    nose
//       \        :     face, down to the jaw
//        |    _.-'     chin
//        |___|         neck
#include "ringlet/bodies/head_mesh.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/bodies/icosphere.h"

namespace ringlet {
namespace {

constexpr int kFrequency = 14;  // of the icosphere: 3,920 triangles of 6 mm

// By eye, in metres, for a scalp of this radius; everything scales with it.
constexpr double kModelRadius = 0.09;
constexpr double kBlend = 0.02;  // over which two shapes melt into one
// Below the hairline, in radii: how far the sphere goes on, the longest edge of the icosphere, so that no
// triangle across the hairline lifts the scalp; and over how much more the face rises from it.
constexpr double kMargin = 0.09, kFade = 0.2;
constexpr double kFurthest = 0.2, kLookStep = 2.5e-4;  // of the search along a ray; no feature is thinner

struct Ellipsoid {
  Vec3d middle, radii;
};
constexpr Ellipsoid kFeatures[] = {
    {{0, -0.050, 0.026}, {0.061, 0.066, 0.064}},  // face and jaw
    {{0, -0.098, 0.062}, {0.024, 0.022, 0.024}},  // chin
    {{0, -0.026, 0.090}, {0.010, 0.022, 0.016}},  // nose
};
constexpr double kNeckRadius = 0.05, kNeckEnd = -0.13, kNeckBack = -0.018;  // its axis is at z = kNeckBack

// Negative inside; near the surface about the distance.
double outsideOf(const Ellipsoid& e, Vec3d p) {
  const Vec3d d = p - e.middle;
  const double scaled = length(Vec3d{d.x / e.radii.x, d.y / e.radii.y, d.z / e.radii.z});
  return (scaled - 1) * std::min({e.radii.x, e.radii.y, e.radii.z});
}

// The smaller one, and still less where the two are within kBlend: never more than either.
double smoothMin(double a, double b) {
  const double h = std::max(kBlend - std::abs(a - b), 0.0) / kBlend;
  return std::min(a, b) - h * h * kBlend / 4;
}

// A cylinder with a rounded end; within the scalp its other end does not show.
double outsideOfNeck(Vec3d p) {
  return -smoothMin(kNeckRadius - length(Vec3d{p.x, std::max(p.y, 0.0), p.z - kNeckBack}), p.y - kNeckEnd);
}

double outsideOfHead(Vec3d p) {
  double outside = length(p) - kModelRadius;
  outside = smoothMin(outside, outsideOfNeck(p));
  for (const Ellipsoid& feature : kFeatures) outside = smoothMin(outside, outsideOf(feature, p));
  return outside;
}

// Where a ray from the middle leaves the union for the last time.
double radiusAlong(Vec3d direction) {
  double inside = kFurthest;
  while (inside > kModelRadius && outsideOfHead(direction * inside) > 0) inside -= kLookStep;
  if (inside <= kModelRadius) return kModelRadius;
  double outside = inside + kLookStep;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (inside + outside) / 2;
    (outsideOfHead(direction * middle) > 0 ? outside : inside) = middle;
  }
  return inside;
}

double smoothstep(double low, double high, double x) {
  const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

}  // namespace

TriangleMesh makeHeadMesh(const HeadParameters& head) {
  RINGLET_ASSERT(head.scalpRadius > 0 && std::isfinite(head.scalpRadius), "a head needs a radius above 0");
  // The plane of the hairline, as generate_head.cpp has it.
  const double tilt = (head.browElevation - head.napeElevation) / 2;
  const double lowest = std::sin((head.browElevation + head.napeElevation) / 2);
  const Vec3d axis{0, std::cos(tilt), -std::sin(tilt)};

  TriangleMesh mesh = makeIcosphere(kFrequency);
  for (Vec3d& point : mesh.points) {
    const double below = lowest - dot(point, axis);
    double radius = kModelRadius;
    if (below > kMargin)
      radius += (radiusAlong(point) - kModelRadius) * smoothstep(kMargin, kMargin + kFade, below);
    point = point * (radius * head.scalpRadius / kModelRadius);
  }
  return mesh;
}

}  // namespace ringlet
