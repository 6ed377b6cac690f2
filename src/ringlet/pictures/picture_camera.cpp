// Implements picture_camera.h.
#include "ringlet/pictures/picture_camera.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ringlet {
namespace {

constexpr double kTravels = 2;  // if all frames need this factor more room than one frame, the camera moves
                                // along with the hair

double radiusOf(const Bounds& bounds) { return bounds.diagonal() / 2; }

}  // namespace

Bounds boundsOf(std::span<const Vec3f> points, double metresPerUnit, double margin) {
  Bounds bounds = Bounds::none();
  for (const Vec3f& point : points) bounds.add(Vec3d(point) * metresPerUnit);
  const Vec3d beyond = Vec3d{1, 1, 1} * margin;
  return {bounds.low - beyond, bounds.high + beyond};
}

void PictureCamera::see(std::span<const Vec3f> points, double metresPerUnit, const Bounds& box) {
  if (!all_) all_ = Bounds::none();
  for (const Vec3d& corner : {box.low, box.high}) all_->add(corner);
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
  if (radiusOf(*all_) > kTravels * largest_) {  // the camera moves along
    const Vec3d middle = here.middle(), half = Vec3d{1, 1, 1} * (largest_ / std::sqrt(3.0));
    shown = {middle - half, middle + half};
  }
  CameraPlace place = choice_.place;
  place.azimuth += choice_.orbit * turned;
  return cameraAround(shown, up_, aspect_, place);
}

}  // namespace ringlet
