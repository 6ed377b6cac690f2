// Implements reference/follow_guide.h.
#include "reference/follow_guide.h"

#include "ringlet/measure/core.h"

namespace ringlet::reference {
namespace {

Rotation<double> rotationOf(const MeasuringFrame& frame) {
  Matrix3<double> axes;
  axes << toEigen<double>(frame.normal), toEigen<double>(frame.binormal), toEigen<double>(frame.tangent);
  return Rotation<double>(axes);
}

}  // namespace

GuidePose poseGuide(const GuideRest& rest, std::span<const Vec3d> positions, Quatd head) {
  const MeasuringFrame root = rotated(rest.frame, head);
  const std::vector<Vec3d> core = smoothCore(positions, rest.arcs, rest.window);
  const std::vector<MeasuringFrame> frames = framesAlong(core, root);
  GuidePose pose{{}, rotationOf(root)};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d curl = positions[i] - core[i];
    const MeasuringFrame& frame = frames[i];
    pose.places.push_back({toEigen<double>(core[i]),
                           {dot(curl, frame.normal), dot(curl, frame.binormal), dot(curl, frame.tangent)},
                           rotationOf(frame)});
  }
  return pose;
}

std::vector<Vec3d> followGuide(const FollowHair& hair, const GuidePose& guide) {
  const std::size_t last = guide.places.size() - 1;
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i <= last; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(last);
    // A shorter hair lags behind its guide, but for the root.
    const double along =
        static_cast<double>(i) * (1 + (static_cast<double>(hair.length) - 1) * risesOver(0.2, share));
    const std::size_t k = std::min(static_cast<std::size_t>(along), last - 1);
    const GuidePlace<double> place =
        placeBetween(guide.places[k], guide.places[k + 1], along - static_cast<double>(k));
    const Vector3<double> x = followedPoint(hair, place, guide.rootFrame, share);
    points.push_back({x.x(), x.y(), x.z()});
  }
  return points;
}

}  // namespace ringlet::reference
