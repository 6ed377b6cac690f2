// Strands whose measures are known in closed form, for the tests of measure/.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet::test {

using Strand = std::vector<Vec3d>;
inline constexpr double kPi = std::numbers::pi;

/// A helix that hangs from the origin along -Y [m].
struct Helix {
  double radius = 0.01, turns = 8, length = 0.25;
  int handedness = 1;
  double phase = 0;  // [rad]
};

inline Strand cut(const Helix& helix, int count) {
  Strand strand;
  for (int i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / (count - 1);
    const double angle = 2 * kPi * helix.turns * s + helix.phase;
    // Going along -Y, right-handed is from X to Z.
    strand.push_back({helix.radius * std::cos(angle), -helix.length * s,
                      helix.handedness * helix.radius * std::sin(angle)});
  }
  return strand;
}

/// A strand that changes hand half way (a perversion), as a helix on either side.
inline Strand perversion(const Helix& helix, int count) {
  Strand strand;
  for (int i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / (count - 1);
    const double angle = 2 * kPi * helix.turns * (s < 0.5 ? s : 1 - s);
    strand.push_back({helix.radius * std::cos(angle), -helix.length * s,
                      helix.handedness * helix.radius * std::sin(angle)});
  }
  return strand;
}

inline Strand moved(Strand strand, Quatd rotation, Vec3d by = {}) {
  for (Vec3d& p : strand) p = rotate(rotation, p) + by;
  return strand;
}

inline Quatd turnAbout(Vec3d axis, double degrees) {
  return fromRotationVector(axis * (degrees * kPi / 180));
}

inline std::vector<Vec3f> asFloats(const Strand& strand) {
  std::vector<Vec3f> points;
  for (Vec3d p : strand) points.push_back(Vec3f(p));
  return points;
}

/// A groom in metres.
inline Groom groomOf(const std::vector<Strand>& strands) {
  Groom groom;
  groom.metresPerUnit = 1;
  for (const Strand& strand : strands) groom.addStrand(asFloats(strand));
  return groom;
}

}  // namespace ringlet::test
