// Implements motion/affine.h.
#include "ringlet/motion/affine.h"

#include <algorithm>
#include <cmath>

namespace ringlet {

bool Affine::isFinite() const {
  for (Vec3d v : {x, y, z, position}) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  }
  return true;
}

Affine affineOf(Vec3d position, Quatd rotation, Vec3d scale) {
  return {rotate(rotation, Vec3d{scale.x, 0, 0}), rotate(rotation, Vec3d{0, scale.y, 0}),
          rotate(rotation, Vec3d{0, 0, scale.z}), position};
}

// Shepperd 1978: from the largest of the four, so that nothing small is divided by.
Quatd rotationOf(Vec3d x, Vec3d y, Vec3d z) {
  const double trace = x.x + y.y + z.z;
  Quatd q;
  if (trace >= std::max({x.x, y.y, z.z})) {
    q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
  } else if (x.x >= y.y && x.x >= z.z) {
    q = {1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y};
  } else if (y.y >= z.z) {
    q = {x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z};
  } else {
    q = {z.x + x.z, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x};
  }
  return normalized(q);
}

// Higham 1986: the mean of a matrix and its inverse transposed, again and again, tends to the rotation of its
// polar decomposition; Newton's method, so digits double. Scaled by the determinant, which brings stretched
// ones near first.
std::optional<Quatd> nearestRotation(const Affine& map) {
  if (!map.isFinite()) return std::nullopt;
  double size = 0;  // brought to 1, so that no product under- or overflows
  for (Vec3d v : {map.x, map.y, map.z}) size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(size > 0)) return std::nullopt;
  Vec3d x = map.x / size, y = map.y / size, z = map.z / size;
  if (dot(cross(x, y), z) < 0) x = -x;
  constexpr int kMostTurns = 100;  // 6 to 10 are taken
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const double volume = dot(cross(x, y), z);
    if (!(volume > 1e-12)) return std::nullopt;
    const double grow = 1 / std::cbrt(volume);
    const Vec3d nextX = (x * grow + cross(y, z) / (volume * grow)) * 0.5;
    const Vec3d nextY = (y * grow + cross(z, x) / (volume * grow)) * 0.5;
    const Vec3d nextZ = (z * grow + cross(x, y) / (volume * grow)) * 0.5;
    const double change = length(nextX - x) + length(nextY - y) + length(nextZ - z);
    x = nextX, y = nextY, z = nextZ;
    if (change < 1e-14) break;
  }
  return rotationOf(x, y, z);
}

}  // namespace ringlet
