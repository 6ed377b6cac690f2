// Implements groom/root_surface.h.
#include "ringlet/groom/root_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ringlet/base/mean.h"

namespace ringlet {
namespace {

constexpr double kOfMost = 0.7;        // of places, the nearest to the surface; others may be off
constexpr int kSurfaceFits = 8;        // each without the farthest of the one before
constexpr double kBallIsBetter = 0.5;  // whose rms is this share of the plane's
constexpr double kLeastWide = 1e-3;    // of places in a row: their width over their length

double rmsOf(const RootSurface& surface, std::span<const Vec3d> places) {
  double sum = 0;
  for (const Vec3d& place : places) sum += std::pow(surface.heightOf(place), 2);
  return std::sqrt(sum / static_cast<double>(places.size()));
}

// Through places, by the axis across which they spread least: powers of a matrix whose largest axis that is.
std::optional<RootSurface> planeThrough(std::span<const Vec3d> places) {
  RootSurface plane;
  plane.middle = meanOf(places);
  Vec3d rows[3]{};
  for (const Vec3d& place : places) {
    const Vec3d x = place - plane.middle;
    rows[0] += x * x.x;
    rows[1] += x * x.y;
    rows[2] += x * x.z;
  }
  const double all = rows[0].x + rows[1].y + rows[2].z;
  if (!(all > 0) || !std::isfinite(all)) return std::nullopt;
  Vec3d power[3] = {Vec3d{all, 0, 0} - rows[0], Vec3d{0, all, 0} - rows[1], Vec3d{0, 0, all} - rows[2]};
  for (int doubling = 0; doubling < 10; ++doubling) {
    const double scale = power[0].x + power[1].y + power[2].z;
    for (Vec3d& row : power) row = row / scale;
    Vec3d squared[3];
    for (int i = 0; i < 3; ++i)
      squared[i] = power[0] * power[i].x + power[1] * power[i].y + power[2] * power[i].z;
    std::ranges::copy(squared, power);
  }
  plane.normal = normalizedOr(*std::ranges::max_element(power, {}, [](Vec3d row) { return dot(row, row); }),
                              Vec3d{0, 1, 0});
  // In a row the places spread across any other axis as little.
  const Vec3d across = anyNormal(plane.normal), along = cross(plane.normal, across);
  double xx = 0, yy = 0, xy = 0;
  for (const Vec3d& place : places) {
    const double x = dot(place - plane.middle, across), y = dot(place - plane.middle, along);
    xx += x * x, yy += y * y, xy += x * y;
  }
  const double mean = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
  if (!(mean - apart > kLeastWide * kLeastWide * (mean + apart))) return std::nullopt;
  return plane;
}

std::optional<RootSurface> surfaceThrough(std::span<const Vec3d> places, bool isFlat) {
  std::optional<RootSurface> plane = planeThrough(places);
  if (!plane || isFlat) return plane;
  RootSurface round;
  round.ball = ballThrough(places);
  const bool isBall = round.ball.radius > 0 && std::isfinite(round.ball.radius) &&
                      rmsOf(round, places) < kBallIsBetter * rmsOf(*plane, places);
  return isBall ? round : plane;
}

}  // namespace

std::optional<RootSurface> surfaceThroughMost(std::span<const Vec3d> roots, bool isFlat) {
  std::optional<RootSurface> surface = surfaceThrough(roots, isFlat);
  std::vector<Vec3d> order(roots.begin(), roots.end());
  const auto keep = static_cast<std::ptrdiff_t>(kOfMost * static_cast<double>(roots.size()));
  for (int fit = 0; fit < kSurfaceFits && surface; ++fit) {
    std::ranges::nth_element(order, order.begin() + keep, {},
                             [&](Vec3d root) { return std::abs(surface->heightOf(root)); });
    surface = surfaceThrough(std::span(order).first(static_cast<std::size_t>(keep)), isFlat);
  }
  if (surface) surface->rms = rmsOf(*surface, std::span(order).first(static_cast<std::size_t>(keep)));
  return surface;
}

}  // namespace ringlet
