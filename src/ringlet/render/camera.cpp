// Implements render/camera.h.
#include "ringlet/render/camera.h"

#include <algorithm>
#include <cmath>

namespace ringlet {
namespace {

constexpr double kFilled = 0.9;  // of the picture's width or height, by what it shows

}  // namespace

CameraAxes axesOf(const Camera& camera) {
  const Vec3d forward = normalizedOr(camera.target - camera.eye, Vec3d{0, 0, -1});
  const Vec3d right = normalizedOr(cross(forward, camera.up), anyNormal(forward));
  return {right, cross(right, forward), forward};
}

void Outline::add(Vec3d point) {
  const bool isFirst = points_.empty();
  std::size_t k = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const double reach = x * point.x + y * point.y + z * point.z;
        if (isFirst) {
          points_.push_back(point);
          reaches_.push_back(reach);
        } else if (reach > reaches_[k]) {
          points_[k] = point;
          reaches_[k] = reach;
        }
        ++k;
      }
    }
  }
}

Camera cameraAround(std::span<const Vec3d> points, Vec3d up, double aspect, const CameraPlace& place) {
  const Vec3d side{1, 0, 0}, front = cross(side, up);
  const Vec3d level = front * std::cos(place.azimuth) + side * std::sin(place.azimuth);
  const Vec3d away = level * std::cos(place.elevation) + up * std::sin(place.elevation);
  Camera camera{.eye = away, .target = {}, .up = up};
  const CameraAxes axes = axesOf(camera);

  // The middle of what is seen, across and up the picture.
  const Vec3d ways[] = {axes.right, axes.up, axes.forward};
  for (const Vec3d& way : ways) {
    double low = dot(points[0], way), high = low;
    for (const Vec3d& point : points)
      low = std::min(low, dot(point, way)), high = std::max(high, dot(point, way));
    camera.target += way * ((low + high) / 2);
  }
  // The least distance at which each point is between the picture's edges.
  const double high = kFilled * std::tan(camera.fieldOfView / 2), wide = high * aspect;
  double distance = 1e-6;
  for (const Vec3d& point : points) {
    const Vec3d at = point - camera.target;
    const double beside = std::max(std::abs(dot(at, axes.right)) / wide, std::abs(dot(at, axes.up)) / high);
    distance = std::max(distance, beside - dot(at, axes.forward));
  }
  camera.eye = camera.target + away * (place.distance * distance);
  return camera;
}

}  // namespace ringlet
