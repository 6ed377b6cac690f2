// Poses as Python says them, Pose objects or arrays of numbers; motions and bodies as it holds them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "python/binding.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/motion.h"

namespace ringlet::python {

/// A motion and a body, with what was odd about their files or meshes.
struct MotionObject {
  Motion motion;
  std::vector<std::string> warnings{};
};
struct BodyObject {
  Body body;
  std::vector<std::string> warnings{};
};
std::vector<Body> bodiesOf(std::span<const BodyObject> objects);

/// Of any length above 0, made 1; finite. Throws ValueError.
Quatd rotationOf(const py::object& value, const std::string& name);

/// A Pose; throws TypeError for anything else.
HeadPose poseOf(const py::object& value, const char* name);

/// Where the head goes in a frame: to one pose, by a smooth way, or through the poses at the end of each
/// step; nothing: it stays.
using HeadWay = std::variant<std::monostate, HeadPose, std::vector<HeadPose>>;
/// Of None, a Pose, a sequence of Poses, or an array (steps, 7), position and rotation, or (steps, 8), with
/// the roots' shift.
HeadWay headWayOf(const py::object& value);
/// A pose a step. Throws ValueError where `way` has another number of them.
std::vector<HeadPose> stepPosesOf(const HeadWay& way, const HeadPose& now, int stepsPerFrame);

/// Poses of `count` things, of None, a sequence of Poses, or an array (count, 7).
std::vector<BodyPose> bodyPosesOf(const py::object& value, const char* name);
/// Points of bodies that bend, of None or a list of arrays (points, 3) or (samples, points, 3).
std::vector<std::vector<Vec3d>> bodyPointsOf(const py::object& value);

/// (count, 8), and (steps, count / steps, 7).
py::object arrayOf(std::span<const HeadPose> poses);
py::object arrayOf(std::span<const BodyPose> poses, std::size_t stepCount);

}  // namespace ringlet::python
