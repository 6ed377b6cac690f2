// Implements groom/ball.h.
#include "ringlet/groom/ball.h"

#include <algorithm>
#include <cmath>

#include "ringlet/base/mean.h"

namespace ringlet {
namespace {

// Roots in a cap of 37 degrees around a pole are this far from the ball's middle on average, in radii.
constexpr double kMostOneSided = 0.9;

constexpr std::size_t kLeastRoots = 30;
constexpr double kLeastRadius = 0.04, kGreatestRadius = 0.2;  // of a head [m]
constexpr double kMostUneven = 0.03;                          // rms of roots from it, share of the radius

}  // namespace

double Ball::distanceTo(Vec3d point) const { return std::abs(length(point - middle) - radius); }

// Least squares of |x|^2 = 2 c . x + k, about the mean: three equations for the middle.
Ball ballThrough(std::span<const Vec3d> points) {
  const Vec3d mean = meanOf(points);
  double squares = 0;
  for (const Vec3d& p : points) squares += dot(p - mean, p - mean);
  squares /= static_cast<double>(points.size());
  Vec3d rows[3]{}, right{};
  for (const Vec3d& p : points) {
    const Vec3d x = p - mean;
    rows[0] += x * x.x;
    rows[1] += x * x.y;
    rows[2] += x * x.z;
    right += x * ((dot(x, x) - squares) / 2);
  }
  const double volume = dot(rows[0], cross(rows[1], rows[2]));
  Ball ball;
  if (!(std::abs(volume) > 0)) return ball;
  const Vec3d columns[3] = {{rows[0].x, rows[1].x, rows[2].x},
                            {rows[0].y, rows[1].y, rows[2].y},
                            {rows[0].z, rows[1].z, rows[2].z}};
  const Vec3d middle = {dot(right, cross(columns[1], columns[2])) / volume,
                        dot(columns[0], cross(right, columns[2])) / volume,
                        dot(columns[0], cross(columns[1], right)) / volume};
  ball.middle = mean + middle;
  for (const Vec3d& p : points) ball.radius += length(p - ball.middle) / static_cast<double>(points.size());
  for (const Vec3d& p : points) ball.rms += std::pow(length(p - ball.middle) - ball.radius, 2);
  ball.rms = std::sqrt(ball.rms / static_cast<double>(points.size()));
  return ball;
}

bool isHead(const Ball& ball, std::span<const Vec3d> points, double mostUneven) {
  return ball.radius > 0 && std::isfinite(ball.radius) && ball.rms < mostUneven * ball.radius &&
         length(meanOf(points) - ball.middle) < kMostOneSided * ball.radius;
}

std::optional<Ball> headUnder(std::span<const Vec3d> roots) {
  if (roots.size() < kLeastRoots) return std::nullopt;
  const Ball ball = ballThrough(roots);
  if (!(ball.radius >= kLeastRadius && ball.radius <= kGreatestRadius &&
        ball.rms < kMostUneven * ball.radius))
    return std::nullopt;
  return ball;
}

}  // namespace ringlet
