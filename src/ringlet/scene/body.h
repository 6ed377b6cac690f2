// Body: a solid that hair stays out of. A particle inside is pushed out.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/bending_mesh.h"
#include "ringlet/scene/distance_grid.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

enum class BodyShape {
  sphere,   // of `radius` about the frame's origin
  capsule,  // all within `radius` of the line of `length` along Y, its middle at the origin
  plane,    // the half space below Y = 0
  box,      // halfExtents to either side of the origin
  grid,     // the places where `grid` is negative
};

/// How the device computes distances, numbered as kShape... of shaders/layout/bodies.h: a sphere and a
/// capsule are boxes without width, rounded off.
enum class DeviceForm { box, plane, grid };

/// A place and an orientation: world (or head) from body.
struct BodyPose {
  Vec3d position;  // [m]
  Quatd rotation;

  bool operator==(const BodyPose&) const = default;
};

/// At fraction s of the way from a to b: linear in position, slerp in rotation.
inline BodyPose interpolate(const BodyPose& a, const BodyPose& b, double s) {
  return {a.position + (b.position - a.position) * s, slerp(a.rotation, b.rotation, s)};
}

/// A place in the world, seen from what is at `pose`.
inline Vec3d seenFrom(const BodyPose& pose, Vec3d place) {
  return rotate(pose.rotation.conjugate(), place - pose.position);
}

struct Body {
  std::string name{};  // for messages
  BodyShape shape = BodyShape::sphere;
  double radius = 0.1;                         // sphere, capsule [m], above 0
  double length = 0.1;                         // capsule [m]
  Vec3d halfExtents{0.1, 0.1, 0.1};            // box [m], above 0
  std::shared_ptr<const DistanceGrid> grid{};  // grid
  std::shared_ptr<const BendingMesh> mesh{};   // grid: of a body that bends; `grid` is of its shape at first
  double thickness = 0;                        // distance that hair keeps from the surface [m], 0 to 1
  double friction = 0.2;                       // Coulomb's coefficient, 0 to 100
  BodyPose place{};  // in the frame that carries it: the groom's axes at the head, or its own motion's
  std::optional<Motion> motion{};  // in the world; nullopt: the head carries it

  bool bends() const { return shape == BodyShape::grid && mesh != nullptr; }
  bool isCloth() const { return bends() && mesh->isCloth; }
  /// Its pose in the world, t seconds after the start, with the head at `head`.
  BodyPose poseAt(double t, const HeadPose& head) const;
};

/// Fails, with the body's name, on an invalid body: a radius of 0, a grid without cells, a number out of its
/// range.
Status checkBody(const Body& body);

/// Of each body that bends, in the order of the bodies: places of all points of its mesh in the world [m], at
/// times spread evenly over a frame, the last at its end; one time after the other, of all bodies as many. In
/// between points move straight, seen from what carries the body.
using BodyPoints = std::span<const std::span<const Vec3d>>;

/// The number of points of each mesh that bends.
std::vector<std::size_t> bendingPointCounts(std::span<const Body> bodies);
/// Fails where `points` is not empty and has not for each of these meshes as many samples of all its points,
/// at least one, none of them further away than 1e9 m along an axis.
Status checkBodyPoints(std::span<const std::size_t> pointCounts, BodyPoints points);

inline constexpr const char* kBodiesNeedJacobi = "bodies need the integrator jacobi; this run has another";

/// poses[step * bodies.size() + body], at the end of each step: stepPoses[k] is the head's at `times[k]` [s].
std::vector<BodyPose> bodyPosesOf(std::span<const Body> bodies, std::span<const HeadPose> stepPoses,
                                  std::span<const double> times);

}  // namespace ringlet
