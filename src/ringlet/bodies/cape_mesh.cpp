// Implements bodies/cape_mesh.h: rows from the collar's rim down, between the two edges in front.
//
//         \  /        collar: out and up from the neck
//       .--'--'--.     on the shoulders: off the bust, along its normals
//      /          \   .
//      |          |    hem: straight down, a little outwards
#include "ringlet/bodies/cape_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "ringlet/bodies/bust_mesh.h"

namespace ringlet {
namespace {

constexpr int kColumns = 44;
constexpr double kOpen = 0.75;  // of the front, to either side [rad]
constexpr double kGap = 0.004;  // from the bust [m]

constexpr int kCollarRows = 4;
constexpr Vec3d kCollarStep{0.004, 0.0085, 0};  // out, and up, a row [m]

constexpr int kBodyRows = 18;
constexpr double kFirstRing = 12, kLastRing = 19.75;  // from the neck to where the bust is widest

constexpr int kHemRows = 13;
constexpr Vec3d kHemStep{0.0012, -0.0125, 0};

// Away from the bust's axis, level.
Vec3d outwards(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

Vec3d offBust(double ring, double angle) {
  constexpr double h = 1e-4;
  const Vec3d down = placeOnBust(ring + h, angle) - placeOnBust(ring - h, angle),
              along = placeOnBust(ring, angle + h) - placeOnBust(ring, angle - h);
  const Vec3d normal = cross(down, along);
  return placeOnBust(ring, angle) + normal * (kGap / length(normal));
}

}  // namespace

CapeMesh makeCapeMesh() {
  CapeMesh cape;
  constexpr int rows = kCollarRows + kBodyRows + kHemRows;
  for (int r = 0; r < rows; ++r) {
    const int above = kCollarRows - r, below = r - (rows - kHemRows) + 1;
    const double ring =
        kFirstRing + (kLastRing - kFirstRing) *
                         std::clamp(static_cast<double>(r - kCollarRows) / (kBodyRows - 1), 0.0, 1.0);
    for (int c = 0; c < kColumns; ++c) {
      const double angle = kOpen + (2 * std::numbers::pi - 2 * kOpen) * c / (kColumns - 1);
      Vec3d place = offBust(ring, angle);
      const Vec3d step = above > 0 ? kCollarStep * above : kHemStep * std::max(below, 0);
      place += outwards(angle) * step.x + Vec3d{0, step.y, 0};
      cape.mesh.points.push_back(place);
      cape.hang.push_back(std::max(below, 0) / static_cast<double>(kHemRows));
    }
  }
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < kColumns; ++c) {
      const std::uint32_t a = r * kColumns + c, b = a + 1, below = a + kColumns;
      cape.mesh.triangles.push_back({a, below, b});
      cape.mesh.triangles.push_back({b, below, below + 1});
    }
  return cape;
}

}  // namespace ringlet
