// Implements picture_camera.h.
#include "program/picture_camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ringlet::program {
namespace {

constexpr double kTravels = 2;  // hair that needs so much more room than a frame of it: the camera goes along

Vec3d lowest(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d highest(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

double radiusOf(const Bounds& bounds) { return length(bounds.high - bounds.low) / 2; }

}  // namespace

Bounds boundsOf(std::span<const Vec3f> points, double metresPerUnit, double margin) {
  Bounds bounds{Vec3d(points[0]) * metresPerUnit, Vec3d(points[0]) * metresPerUnit};
  for (const Vec3f& point : points) {
    const Vec3d p = Vec3d(point) * metresPerUnit;
    bounds = {lowest(bounds.low, p), highest(bounds.high, p)};
  }
  const Vec3d beyond = Vec3d{1, 1, 1} * margin;
  return {bounds.low - beyond, bounds.high + beyond};
}

void PictureCamera::see(std::span<const Vec3f> points, double metresPerUnit, const Bounds& box) {
  all_ = all_ ? Bounds{lowest(all_->low, box.low), highest(all_->high, box.high)} : box;
  for (const Vec3f& p : points) outline_.add(Vec3d(p) * metresPerUnit);
  largest_ = std::max(largest_, radiusOf(box));
}

Camera PictureCamera::at(double frame, double turned, const Bounds& here) const {
  if (choice_.ofScene) {
    const double seconds = frame / framesPerSecond_;
    const CameraView view = choice_.ofScene->viewAt(seconds, head_ ? head_->poseAt(seconds) : HeadPose{});
    return {view.eye, view.target, view.up, view.fieldOfView};
  }
  std::vector<Vec3d> shown = outline_.points();
  if (radiusOf(*all_) > kTravels * largest_) {  // the camera goes along
    const Vec3d middle = (here.low + here.high) / 2.0, half = Vec3d{1, 1, 1} * (largest_ / std::sqrt(3.0));
    shown = {middle - half, middle + half};
  }
  CameraPlace place = choice_.place;
  place.azimuth += choice_.orbit * turned;
  return cameraAround(shown, up_, aspect_, place);
}

}  // namespace ringlet::program
