// Implements view/orbit_camera.h.
#include "view/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ringlet::view {
namespace {

constexpr double kLeastPole = 0.02;                           // angle to the up axis [rad]
constexpr double kLeastDistance = 0.02, kMostDistance = 1e4;  // [m]

// Möller and Trumbore 1997; infinite where the ray misses.
double distanceTo(const Ray& ray, Vec3d a, Vec3d b, Vec3d c) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Vec3d ab = b - a, ac = c - a, across = cross(ray.along, ac);
  const double det = dot(ab, across);
  if (std::abs(det) < 1e-18) return kMiss;
  const Vec3d from = ray.from - a;
  const double u = dot(from, across) / det;
  const Vec3d other = cross(from, ab);
  const double v = dot(ray.along, other) / det, t = dot(ac, other) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : kMiss;
}

}  // namespace

OrbitCamera::OrbitCamera(std::span<const Vec3d> points, Vec3d up, double aspect)
    : camera_(cameraAround(points, up, aspect, {.azimuth = 0.6, .elevation = 0.09, .distance = 1.15})),
      first_(camera_) {}

void OrbitCamera::orbit(double right, double up) {
  const Vec3d axis = camera_.up;
  Vec3d away = rotate(fromRotationVector(axis * right), camera_.eye - camera_.target);
  const double distance = length(away);
  const double polar = std::acos(std::clamp(dot(away, axis) / distance, -1.0, 1.0));
  const double wanted = std::clamp(polar - up, kLeastPole, std::numbers::pi - kLeastPole);
  const Vec3d side = normalizedOr(cross(axis, away), anyNormal(axis));
  away = rotate(fromRotationVector(side * (wanted - polar)), away);
  camera_.eye = camera_.target + away;
}

void OrbitCamera::pan(double right, double down, int height) {
  const Vec3d move = moveOf(camera_.target, right, down, height);
  camera_.eye -= move;
  camera_.target -= move;
}

void OrbitCamera::zoom(double factor) {
  const Vec3d away = camera_.eye - camera_.target;
  const double distance = std::clamp(length(away) * factor, kLeastDistance, kMostDistance);
  camera_.eye = camera_.target + away * (distance / length(away));
}

Ray OrbitCamera::rayThrough(double across, double down, double aspect) const {
  const CameraAxes axes = axesOf(camera_);
  const double high = std::tan(camera_.fieldOfView / 2);
  const Vec3d along =
      axes.forward + axes.right * ((2 * across - 1) * high * aspect) + axes.up * ((1 - 2 * down) * high);
  return {camera_.eye, normalizedOr(along, axes.forward)};
}

Vec3d OrbitCamera::moveOf(Vec3d place, double right, double down, int height) const {
  const CameraAxes axes = axesOf(camera_);
  const double far = dot(place - camera_.eye, axes.forward);
  const double metres = 2 * std::tan(camera_.fieldOfView / 2) * far / height;
  return (axes.right * right - axes.up * down) * metres;
}

std::optional<Vec3d> OrbitCamera::project(Vec3d place, int width, int height) const {
  const CameraAxes axes = axesOf(camera_);
  const Vec3d at = place - camera_.eye;
  const double far = dot(at, axes.forward);
  if (far <= 0.001) return std::nullopt;
  const double pixels = height / 2.0 / std::tan(camera_.fieldOfView / 2) / far;
  return Vec3d{width / 2.0 + dot(at, axes.right) * pixels, height / 2.0 - dot(at, axes.up) * pixels, far};
}

std::optional<Hit> hitBy(const Ray& ray, std::span<const SolidMesh> solids,
                         std::span<const SolidPlace> places) {
  std::optional<Hit> hit;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < solids.size(); ++s) {
    const Quatd back = places[s].rotation.conjugate();
    const Ray inside{rotate(back, ray.from - places[s].position), rotate(back, ray.along)};
    const auto& points = solids[s].points;
    for (const auto& [a, b, c] : solids[s].triangles) {
      const double distance = distanceTo(inside, points[a], points[b], points[c]);
      if (distance >= nearest) continue;
      nearest = distance;
      hit = Hit{s, ray.from + ray.along * distance};
    }
  }
  return hit;
}

}  // namespace ringlet::view
