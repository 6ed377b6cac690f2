// Implements bodies/bust_mesh.h: rings about a vertical, from the crown down, between the rows of a table.
//
//          .--.
//         (    )     a ring is an ellipse that leans: its front is lower than its back
//          \  _>     below the chin, where the jaw ends in the throat
//       .--'  '--.
//      /          \   .
//     '------------'
#include "ringlet/bodies/bust_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace ringlet {
namespace {

constexpr int kSegments = 48;       // of a ring
constexpr int kRingsBetween = 2;    // from a row of the table to the next
constexpr double kCrowding = 0.35;  // of segments in front, where the face is

// By eye [m]: heights and depths of a ring's front and back, and half its width.
using Row = std::array<double, 5>;
constexpr Row kRows[] = {
    {0.120, 0.120, -0.010, -0.010, 0},  // crown
    {0.113, 0.114, 0.032, -0.049, 0.035},   {0.098, 0.100, 0.058, -0.074, 0.055},
    {0.074, 0.078, 0.077, -0.093, 0.070},   {0.045, 0.048, 0.087, -0.101, 0.077},    // forehead
    {0.015, 0.016, 0.090, -0.102, 0.078},                                            // eyes
    {-0.018, -0.014, 0.089, -0.096, 0.075}, {-0.050, -0.040, 0.089, -0.085, 0.069},  // nose
    {-0.080, -0.062, 0.088, -0.072, 0.061},                                          // mouth
    {-0.104, -0.080, 0.083, -0.063, 0.052},                                          // chin
    {-0.117, -0.094, 0.065, -0.060, 0.048}, {-0.126, -0.109, 0.042, -0.060, 0.049},  // throat
    {-0.146, -0.126, 0.031, -0.064, 0.053}, {-0.170, -0.143, 0.029, -0.071, 0.060},  // neck
    {-0.191, -0.160, 0.035, -0.081, 0.082}, {-0.206, -0.175, 0.047, -0.092, 0.120},
    {-0.221, -0.193, 0.060, -0.101, 0.161},  // shoulders
    {-0.242, -0.216, 0.074, -0.108, 0.188}, {-0.270, -0.248, 0.090, -0.112, 0.202},
    {-0.302, -0.285, 0.101, -0.112, 0.206},  // chest
    {-0.332, -0.320, 0.104, -0.109, 0.203}, {-0.349, -0.342, 0.096, -0.100, 0.188},
    {-0.356, -0.352, 0.072, -0.076, 0.145}, {-0.358, -0.355, 0.036, -0.038, 0.072},
    {-0.358, -0.356, -0.001, -0.001, 0},  // the middle of its underside
};

// What stands out of the face, or lies in it: so far, at a place and as wide as that [m].
struct Bump {
  double height, x, y, width, tall;
};
constexpr Bump kBumps[] = {
    {0.017, 0, -0.036, 0.013, 0.016},                                          // nose
    {0.009, 0, -0.012, 0.011, 0.020},                                          // its bridge
    {-0.008, 0.033, -0.002, 0.017, 0.013},                                     // eyes
    {-0.008, -0.033, -0.002, 0.017, 0.013}, {0.005, 0, -0.070, 0.022, 0.010},  // lips
    {0.005, 0, -0.103, 0.022, 0.014},                                          // chin
};

// Through the rows, smoothly (Catmull-Rom), `share` of the way from row k to the next.
Row rowAt(std::size_t k, double share) {
  const std::size_t last = std::size(kRows) - 1;
  const Row &before = kRows[k == 0 ? 0 : k - 1], &from = kRows[k], &to = kRows[std::min(k + 1, last)],
            &after = kRows[std::min(k + 2, last)];
  Row row{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double in = (to[i] - before[i]) / 2, out = (after[i] - from[i]) / 2, step = to[i] - from[i];
    row[i] = from[i] + share * (in + share * (3 * step - 2 * in - out + share * (in + out - 2 * step)));
  }
  return row;
}

Vec3d onEllipse(const Row& row, double angle) {  // 0 in front
  const auto [yFront, yBack, zFront, zBack, half] = row;
  const double forward = std::cos(angle);
  return {half * std::sin(angle), (yFront + yBack + (yFront - yBack) * forward) / 2,
          (zFront + zBack + (zFront - zBack) * forward) / 2};
}

Vec3d placeOn(const Row& row, double angle) {
  const double forward = std::cos(angle);
  Vec3d place = onEllipse(row, angle);
  for (const Bump& bump : kBumps) {
    const double x = (place.x - bump.x) / bump.width, y = (place.y - bump.y) / bump.tall;
    if (forward > 0) place.z += bump.height * forward * std::exp(-x * x - y * y);
  }
  return place;
}

}  // namespace

Vec3d placeOnBust(double ring, double angle) {
  const double row = std::clamp(ring, 0.0, static_cast<double>(std::size(kRows) - 1));
  return onEllipse(rowAt(static_cast<std::size_t>(row), row - std::floor(row)), angle);
}

TriangleMesh makeBustMesh() {
  TriangleMesh mesh;
  const int ringCount = (static_cast<int>(std::size(kRows)) - 1) * kRingsBetween - 1;
  mesh.points.push_back(placeOn(kRows[0], 0));
  for (int ring = 1; ring <= ringCount; ++ring) {
    const Row row =
        rowAt(static_cast<std::size_t>(ring / kRingsBetween), ring % kRingsBetween / double(kRingsBetween));
    for (int k = 0; k < kSegments; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSegments;
      mesh.points.push_back(placeOn(row, angle - kCrowding * std::sin(angle)));
    }
  }
  const auto last = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(placeOn(std::end(kRows)[-1], 0));
  const auto pointOf = [&](int ring, int k) {
    return ring == 0          ? 0
           : ring > ringCount ? last
                              : static_cast<std::uint32_t>(1 + (ring - 1) * kSegments + k % kSegments);
  };
  for (int ring = 0; ring <= ringCount; ++ring)
    for (int k = 0; k < kSegments; ++k) {
      const std::uint32_t a = pointOf(ring, k), b = pointOf(ring, k + 1), c = pointOf(ring + 1, k),
                          d = pointOf(ring + 1, k + 1);
      if (a != b) mesh.triangles.push_back({a, d, b});
      if (c != d) mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

}  // namespace ringlet
