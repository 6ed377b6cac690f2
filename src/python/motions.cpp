// Poses and motions of heads.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "python/arrays.h"
#include "python/poses.h"
#include "python/words.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/outside_numbers.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet::python {
namespace {

std::optional<Quatd> unit(Quatd q) {
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  if (std::abs(length - 1) < 1e-12) return q;  // so that what was told comes back with its bits
  return Quatd{q.x / length, q.y / length, q.z / length, q.w / length};
}

// Where float32 still tells places apart for hair that is seen from there.
void demandNear(Vec3d position, const std::string& name) {
  if (!contains(kPosePlace, position))
    throw py::value_error(
        fmt::format("{} must be finite and at most 1e9 m away along each axis, got ({}, {}, {})", name,
                    position.x, position.y, position.z));
}

double shiftIn(double shift) {
  if (!kOutsidePlace.contains(shift))
    throw py::value_error(fmt::format("shift must be finite, from {} to {}, got {}", kOutsidePlace.low,
                                      kOutsidePlace.high, shift));
  return shift;
}

// A row of 7 numbers or more.
template <class Pose>
Pose poseOfRow(const double* row, const char* name) {
  const auto rotation = unit({row[3], row[4], row[5], row[6]});
  if (!rotation)
    throw py::value_error(fmt::format("{} must have rotations (x, y, z, w) of a length above 0", name));
  Pose pose;
  pose.position = {row[0], row[1], row[2]};
  demandNear(pose.position, name);
  pose.rotation = *rotation;
  return pose;
}

bool isListOfPoses(const py::object& value) {
  if (py::isinstance<py::array>(value) || !PySequence_Check(value.ptr())) return false;
  const auto sequence = py::reinterpret_borrow<py::sequence>(value);
  return py::len(value) > 0 && py::isinstance<HeadPose>(py::object(sequence[0]));
}

std::string poseReprOf(const HeadPose& pose) {
  const auto& [p, r, shift] = pose;
  return fmt::format("ringlet.Pose(({}, {}, {}), ({}, {}, {}, {}){})", p.x, p.y, p.z, r.x, r.y, r.z, r.w,
                     shift != 0 ? fmt::format(", shift={}", shift) : "");
}

void addPose(py::module_& module) {
  py::class_<HeadPose>(
      module, "Pose",
      "Where something is and how it is turned: world from groom, x_world = position + rotate(rotation, "
      "x_groom). Constant.")
      .def(
          py::init([](const py::object& position, const py::object& rotation, double shift) {
            return HeadPose{vectorOf(position, "position"), rotationOf(rotation, "rotation"), shiftIn(shift)};
          }),
          py::arg("position") = py::make_tuple(0, 0, 0), py::arg("rotation") = py::make_tuple(0, 0, 0, 1),
          py::arg("shift") = 0.0,
          "position [m]; rotation: a quaternion x, y, z, w of any length above 0; shift: of a head's roots "
          "that move beside it, the share of each one's root_shifts (Hair).")
      .def_static(
          "turned",
          [](const py::object& rotation, const py::object& position) {
            return HeadPose{vectorOf(position, "position"),
                            fromRotationVector(vectorOf(rotation, "rotation_vector")), 0};
          },
          py::arg("rotation_vector"), py::arg("position") = py::make_tuple(0, 0, 0),
          "Turned by the vector's length [rad] about its direction.")
      .def_property_readonly(
          "position",
          [](const HeadPose& p) { return py::make_tuple(p.position.x, p.position.y, p.position.z); }, "[m]")
      .def_property_readonly(
          "rotation",
          [](const HeadPose& p) {
            return py::make_tuple(p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w);
          },
          "A quaternion x, y, z, w of length 1.")
      .def_readonly("shift", &HeadPose::shift, "Of roots beside the head: the share of each one's shift.")
      .def(
          "__eq__",
          [](const HeadPose& a, const py::object& other) {
            if (!py::isinstance<HeadPose>(other)) return false;
            const auto& b = other.cast<const HeadPose&>();
            return a.position == b.position && a.rotation == b.rotation && a.shift == b.shift;
          },
          py::arg("other"), "Whether every number is the same.")
      .def("__repr__", &poseReprOf, "What makes it again.")
      .attr("__hash__") = py::none();
}

// None: the kind's own.
struct MotionNumbers {
  py::object axis, amplitude, frequency, easeSeconds, untilSeconds;
};

MotionObject makeMotion(const std::string& kind, const py::object& up, const MotionNumbers& numbers,
                        const py::object& start) {
  auto named = motionByName(kind, vectorOf(up, "up"));
  if (!named) {
    const bool isFile = std::filesystem::path(kind).has_extension();
    throw py::value_error(unknownName("motion", kind, namesIn(motionNames())) +
                          (isFile ? "; Motion.load reads files" : ""));
  }
  Motion motion = *named;
  if (!numbers.axis.is_none()) {
    const Vec3d given = vectorOf(numbers.axis, "axis");
    if (!(length(given) > 0)) throw py::value_error("axis must have a length above 0");
    motion.axis = normalizedOr(given, motion.axis);
  }
  const auto set = [](const py::object& value, const char* name, double low, double& number) {
    if (value.is_none()) return;
    const double given = numberOf(value, name);
    if (!(given >= low) || !std::isfinite(given))
      throw py::value_error(fmt::format("{} must be a finite number{}, got {}", name,
                                        std::isfinite(low) ? fmt::format(" from {} up", low) : "", given));
    number = given;
  };
  set(numbers.amplitude, "amplitude", -std::numeric_limits<double>::infinity(), motion.amplitude);
  set(numbers.frequency, "frequency", 0, motion.frequency);
  set(numbers.easeSeconds, "ease_seconds", 0, motion.easeSeconds);
  set(numbers.untilSeconds, "until_seconds", 0, motion.untilSeconds);
  motion.start = vectorOf(start, "start");
  return {motion};
}

MotionObject keyframeMotion(const py::object& poses, const py::object& times, double secondsPerKey,
                            const std::string& interpolation, bool restsAtEnds) {
  Keyframes keys;
  const HeadWay way = headWayOf(poses);
  if (const auto* given = std::get_if<std::vector<HeadPose>>(&way)) keys.poses = *given;
  if (keys.poses.empty())
    throw py::value_error("poses must be a list of Poses or an array (keys, 7), at least one");
  if (!(secondsPerKey > 0) || !std::isfinite(secondsPerKey))
    throw py::value_error(fmt::format("seconds_per_key must be above 0, got {}", secondsPerKey));
  keys.secondsPerKey = secondsPerKey;
  if (!times.is_none()) {
    const auto array = py::array::ensure(times);
    if (!array || array.ndim() != 1) {
      PyErr_Clear();
      throw py::type_error("times must be numbers in one dimension, got " + describe(times));
    }
    keys.times = rowsOf(times, "times", static_cast<std::size_t>(array.shape(0))).values;
    if (keys.times.size() != keys.poses.size())
      throw py::value_error(
          fmt::format("times has {} numbers and poses {}", keys.times.size(), keys.poses.size()));
    for (std::size_t k = 1; k < keys.times.size(); ++k)
      if (!(keys.times[k] > keys.times[k - 1])) throw py::value_error("times must rise from key to key");
  }
  if (interpolation != "cubic" && interpolation != "linear")
    throw py::value_error(unknownName("interpolation", interpolation, {"cubic", "linear"}));
  if (interpolation == "linear") keys.interpolation = Keyframes::Interpolation::linear;
  keys.restsAtEnds = restsAtEnds;
  return {
      Motion{.kind = MotionKind::keyframes, .keyframes = std::make_shared<const Keyframes>(std::move(keys))}};
}

// What is up in the file is fileUp; empty: what the file's kind says.
MotionObject loadMotion(MotionFileChoice choice, const std::string& up, const std::string& fileUp) {
  if (motionFileKind(choice.path.string()) == MotionFileKind::none)
    throw py::value_error(noMotionFile(choice.path).message);
  if (choice.metresPerUnit && !(*choice.metresPerUnit > 0 && std::isfinite(*choice.metresPerUnit)))
    throw py::value_error(fmt::format("metres_per_unit must be above 0, got {}", *choice.metresPerUnit));
  if (choice.skippedFrames < 0)
    throw py::value_error(fmt::format("skip_frames must be 0 or more, got {}", choice.skippedFrames));
  if (up != "Y" && up != "Z") throw py::value_error(unknownName("up axis", up, {"Y", "Z"}));
  choice.up = fileAxisNamed(fileUp);
  if (!fileUp.empty() && !choice.up)
    throw py::value_error(unknownName("up axis of a file", fileUp, namesIn(kFileAxisNames)));
  MotionObject loaded;
  withoutGil([&] {
    loaded.motion = valueOf(inWords(kMotionWords, readMotionFile(choice, up == "Z", loaded.warnings)));
    loaded.warnings = inWords(kMotionWords, std::move(loaded.warnings));
  });
  return loaded;
}

HeadPose poseAt(const MotionObject& self, double seconds) {
  if (!std::isfinite(seconds)) throw py::value_error(fmt::format("seconds must be finite, got {}", seconds));
  return self.motion.poseAt(seconds);
}

py::object motionFramePoses(const MotionObject& self, int frame, const Settings& settings) {
  std::vector<HeadPose> poses;
  for (int step = 1; step <= settings.stepsPerFrame; ++step) {
    const double steps = static_cast<double>(frame) * settings.stepsPerFrame + step;
    poses.push_back(self.motion.poseAt(steps / (settings.framesPerSecond * settings.stepsPerFrame)));
  }
  return arrayOf(poses);
}

using MotionClass = py::class_<MotionObject>;

// The ways to make one.
void addMotionSources(MotionClass& motion) {
  motion
      .def(
          py::init([](const std::string& kind, const py::object& up, const py::object& axis,
                      const py::object& amplitude, const py::object& frequency, const py::object& easeSeconds,
                      const py::object& untilSeconds, const py::object& start) {
            return makeMotion(kind, up,
                              {.axis = axis,
                               .amplitude = amplitude,
                               .frequency = frequency,
                               .easeSeconds = easeSeconds,
                               .untilSeconds = untilSeconds},
                              start);
          }),
          py::arg("kind") = "still", py::kw_only(), py::arg("up") = py::make_tuple(0, 1, 0),
          py::arg("axis") = py::none(), py::arg("amplitude") = py::none(), py::arg("frequency") = py::none(),
          py::arg("ease_seconds") = py::none(), py::arg("until_seconds") = py::none(),
          py::arg("start") = py::make_tuple(0, 0, 0),
          "One of kinds(), for a head whose up axis is `up`; what is None is the kind's own.\n\n"
          "axis: of travel or turning; amplitude: [m], or of kinds that turn [rad], spin [rad/s], glide "
          "[m/s]; frequency [Hz]; ease_seconds: in which it grows from 0; until_seconds: when it is over; "
          "start: added to all positions [m].")
      .def_static(
          "kinds", [] { return namesIn(motionNames()); }, "The names of built-in motions: a list.")
      .def_static(
          "keyframes", &keyframeMotion, py::arg("poses"), py::arg("times") = py::none(), py::kw_only(),
          py::arg("seconds_per_key") = 1.0 / 24, py::arg("interpolation") = "cubic",
          py::arg("rests_at_ends") = false,
          "Through poses: a list of Poses or an array (keys, 7) of positions and rotations. times: of each "
          "[s], rising; None: seconds_per_key apart, from 0 on. interpolation: \"cubic\" or \"linear\". "
          "rests_at_ends: the head stands still before the first key.")
      .def_static(
          "load",
          [](const std::filesystem::path& path, const std::string& joint, std::optional<double> metresPerUnit,
             int skipFrames, const std::string& animation, const std::string& up, const std::string& fileUp) {
            return loadMotion({.path = path,
                               .joint = joint,
                               .metresPerUnit = metresPerUnit,
                               .skippedFrames = skipFrames,
                               .animation = animation},
                              up, fileUp);
          },
          py::arg("path"), py::kw_only(), py::arg("joint") = "Head", py::arg("metres_per_unit") = py::none(),
          py::arg("skip_frames") = 0, py::arg("animation") = "", py::arg("up") = "Y", py::arg("file_up") = "",
          "The way of a joint of a .bvh file or of a node of a .gltf, .glb or .vrm file. metres_per_unit: "
          "None: of a .bvh so that its person is 1.7 m tall, of glTF 1. file_up: the file's up axis, one of "
          "Y, Z, X, -Y, -Z, -X; \"\": of a .bvh the axis along which its person stands, of glTF Y. "
          "skip_frames: of a .bvh, at the start; animation: of glTF, a name or number, else the first; up: "
          "of the head's world, \"Y\" or \"Z\". ringlet.Error names the joints where there is none of that "
          "name.");
}

void addMotionPoses(MotionClass& motion) {
  motion.def("pose_at", &poseAt, py::arg("seconds"), "The Pose at a time [s], before 0 too.")
      .def(
          "frame_poses", &motionFramePoses, py::arg("frame"), py::arg("settings"),
          "(steps, 8): where the head is at the end of each step of a frame, 0 the first, as Hair.step takes "
          "it: position, rotation, shift.")
      .def_property_readonly(
          "kind", [](const MotionObject& self) { return motionName(self.motion.kind); },
          "Its name; \"keyframes\" for one by keys or from a file.")
      .def_property_readonly(
          "seconds",
          [](const MotionObject& self) -> std::optional<double> {
            if (!self.motion.keyframes) return std::nullopt;
            return self.motion.keyframes->seconds();
          },
          "When its last key is reached [s]; None for a built-in motion.")
      .def_readonly("warnings", &MotionObject::warnings,
                    "What was taken for granted of its file: a list of sentences.")
      .def(
          "__repr__",
          [](const MotionObject& self) {
            const auto& keys = self.motion.keyframes;
            return fmt::format("<ringlet.Motion: {}{}>", motionName(self.motion.kind),
                               keys ? fmt::format(", {} s", keys->seconds()) : "");
          },
          "What it is, in a line.");
}

void addMotion(py::module_& module) {
  MotionClass motion(module, "Motion", "The way a head moves: a pose at any time. Constant.");
  addMotionSources(motion);
  addMotionPoses(motion);
}

}  // namespace

std::vector<Body> bodiesOf(std::span<const BodyObject> objects) {
  std::vector<Body> bodies;
  for (const BodyObject& object : objects) bodies.push_back(object.body);
  return bodies;
}

Quatd rotationOf(const py::object& value, const std::string& name) {
  const Rows rows = rowsOf(value, name.c_str(), 4);
  const auto rotation = rows.shape.empty()
                            ? unit({rows.values[0], rows.values[1], rows.values[2], rows.values[3]})
                            : std::nullopt;
  if (!rotation)
    throw py::value_error(
        fmt::format("{} takes a quaternion (x, y, z, w) of a length above 0, got {}", name, describe(value)));
  return *rotation;
}

HeadPose poseOf(const py::object& value, const char* name) {
  if (!py::isinstance<HeadPose>(value))
    throw py::type_error(fmt::format("{} must be a ringlet.Pose, got {}", name, describe(value)));
  const auto& pose = value.cast<const HeadPose&>();
  demandNear(pose.position, name);
  return pose;
}

HeadWay headWayOf(const py::object& value) {
  if (value.is_none()) return {};
  if (py::isinstance<HeadPose>(value)) return poseOf(value, "head");
  std::vector<HeadPose> poses;
  if (isListOfPoses(value)) {
    for (const auto& pose : value) poses.push_back(poseOf(py::reinterpret_borrow<py::object>(pose), "head"));
    return poses;
  }
  const char* name = "head (a Pose, a list of them, or an array of a pose a step)";
  const Rows rows = rowsOf(value, name, 7, 8);
  if (rows.shape.size() != 1)
    throw py::value_error(fmt::format("{} has two dimensions, got {}", name, describe(value)));
  const std::size_t width = rows.shape[0] > 0 ? rows.values.size() / rows.shape[0] : 7;
  for (std::size_t k = 0; k < rows.shape[0]; ++k) {
    poses.push_back(poseOfRow<HeadPose>(&rows.values[k * width], name));
    if (width == 8) poses.back().shift = shiftIn(rows.values[k * width + 7]);
  }
  return poses;
}

std::vector<HeadPose> stepPosesOf(const HeadWay& way, const HeadPose& now, int stepsPerFrame) {
  if (const auto* poses = std::get_if<std::vector<HeadPose>>(&way)) {
    if (poses->size() == static_cast<std::size_t>(stepsPerFrame)) return *poses;
    throw py::value_error(fmt::format("a frame takes a pose of the head for each of its {} steps, got {}",
                                      stepsPerFrame, poses->size()));
  }
  const auto* end = std::get_if<HeadPose>(&way);
  std::vector<HeadPose> poses;
  for (int k = 1; k <= stepsPerFrame; ++k)
    poses.push_back(end ? interpolate(now, *end, double(k) / stepsPerFrame) : now);
  return poses;
}

std::vector<std::vector<Vec3d>> bodyPointsOf(const py::object& value) {
  std::vector<std::vector<Vec3d>> all;
  if (value.is_none()) return all;
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::array>(value))
    throw py::type_error(
        fmt::format("body_points is a list with an array for each body that bends, got {}", describe(value)));
  for (const py::handle each : value) {
    const Rows rows = rowsOf(py::reinterpret_borrow<py::object>(each), "body_points", 3);
    std::vector<Vec3d>& points = all.emplace_back();
    for (std::size_t i = 0; i < rows.count(3); ++i)
      points.push_back({rows.values[3 * i], rows.values[3 * i + 1], rows.values[3 * i + 2]});
  }
  return all;
}

std::vector<BodyPose> bodyPosesOf(const py::object& value, const char* name) {
  std::vector<BodyPose> poses;
  if (value.is_none()) return poses;
  if (isListOfPoses(value)) {
    for (const auto& entry : value) {
      const HeadPose pose = poseOf(py::reinterpret_borrow<py::object>(entry), name);
      poses.push_back({pose.position, pose.rotation});
    }
    return poses;
  }
  const Rows rows = rowsOf(value, name, 7);
  for (std::size_t k = 0; k < rows.count(7); ++k)
    poses.push_back(poseOfRow<BodyPose>(&rows.values[7 * k], name));
  return poses;
}

py::object arrayOf(std::span<const HeadPose> poses) {
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), py::ssize_t{8}});
  double* out = array.mutable_data();
  for (const HeadPose& pose : poses) {
    for (const double number : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.x,
                                pose.rotation.y, pose.rotation.z, pose.rotation.w, pose.shift})
      *out++ = number;
  }
  return array;
}

py::object arrayOf(std::span<const BodyPose> poses, std::size_t stepCount) {
  py::array_t<double> array({static_cast<py::ssize_t>(stepCount),
                             static_cast<py::ssize_t>(poses.size() / stepCount), py::ssize_t{7}});
  double* out = array.mutable_data();
  for (const BodyPose& pose : poses) {
    for (const double number : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.x,
                                pose.rotation.y, pose.rotation.z, pose.rotation.w})
      *out++ = number;
  }
  return array;
}

void addMotions(py::module_& module) {
  addPose(module);
  addMotion(module);
}

}  // namespace ringlet::python
