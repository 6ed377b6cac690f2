// Implements groom/head_regions.h. All numbers are by eye, for a head like that of bodies/head_mesh.h.
#include "ringlet/groom/head_regions.h"

#include <algorithm>
#include <cmath>

namespace ringlet {
namespace {

constexpr double kPartingSide = 0.35;  // sine of the angle between a parting at a side and the middle

// The fringe: so far above the hairline in front, and so far to either side [rad].
constexpr double kFringeDepth = 0.4, kFringeWidth = 0.75;

// Angle from the face about the vertical, 0 in front to pi behind [rad].
double azimuthOf(Vec3d outward) { return std::atan2(std::abs(outward.x), outward.z); }

double elevationOf(Vec3d outward) { return std::asin(std::clamp(outward.y, -1.0, 1.0)); }

// 1 at `middle`, falling off to either side.
double bump(double x, double middle, double width) {
  const double d = (x - middle) / width;
  return std::exp(-d * d);
}

// Elevation at which the cap's edge crosses this azimuth: the edge is a plane circle.
double edgeOfCap(const HeadParameters& head, double azimuth) {
  const double tilt = (head.browElevation - head.napeElevation) / 2;
  const double lowest = std::sin((head.browElevation + head.napeElevation) / 2);
  // y cos(tilt) - z sin(tilt) = lowest with y = sin(e), z = cos(e) cos(azimuth).
  const double a = std::cos(tilt), b = std::sin(tilt) * std::cos(azimuth);
  const double size = std::hypot(a, b);
  return std::asin(std::clamp(lowest / size, -1.0, 1.0)) + std::atan2(b, a);
}

double naturalHairline(const HeadParameters& head, double azimuth) {
  const double bays = 0.16 * bump(azimuth, 0.62, 0.3), ears = 0.2 * bump(azimuth, 1.6, 0.3);
  return edgeOfCap(head, azimuth) + bays + ears;
}

}  // namespace

double smoothstep(double low, double high, double x) {
  const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

bool isAboveHairline(const HeadParameters& head, Vec3d outward) {
  return head.cut.hairline != "natural" || elevationOf(outward) > naturalHairline(head, azimuthOf(outward));
}

bool isFringe(const HeadParameters& head, Vec3d outward) {
  return head.cut.fringe > 0 && azimuthOf(outward) < kFringeWidth &&
         elevationOf(outward) < edgeOfCap(head, azimuthOf(outward)) + kFringeDepth;
}

double lengthFactor(const HeadParameters& head, Vec3d outward) {
  const HairCut& cut = head.cut;
  const double top = smoothstep(0.6, 0.85, outward.y);
  const double back = (1 - top) * smoothstep(0.1, 0.6, -outward.z), sides = 1 - top - back;
  const double byRegion = 1 + (cut.top - 1) * top + (cut.sides - 1) * sides + (cut.back - 1) * back;
  return byRegion * (1 - cut.layers * smoothstep(-0.6, 0.95, outward.y));
}

int sideOfParting(const HeadParameters& head, Vec3d outward) {
  if (head.cut.parting == "none") return 0;
  const double line = head.cut.parting == "left"    ? kPartingSide
                      : head.cut.parting == "right" ? -kPartingSide
                                                    : 0;
  return outward.x >= line ? 1 : -1;
}

}  // namespace ringlet
