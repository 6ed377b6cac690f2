// Whole scenes: built-in ones and files, and their runs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/grooms.h"
#include "python/hair.h"
#include "python/materials.h"
#include "python/poses.h"
#include "python/scenes.h"
#include "python/words.h"
#include "ringlet/run/scene_run.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::python {
namespace {

SceneObject sceneOf(std::string name, std::string summary, LoadedScene loaded, SceneSource source) {
  loaded.warnings = inSceneWords(std::move(loaded.warnings));
  auto groom = std::make_shared<GroomObject>(LoadedGroom{std::move(loaded.groom), {}});
  loaded.groom = {};
  return {std::move(name), std::move(summary), std::move(groom), std::move(loaded), std::move(source)};
}

SceneReach reachOf(bool isConfined) { return isConfined ? SceneReach::ownFolder : SceneReach::anywhere; }

// A value as a scene file has it. A text needs no quotes (SceneChange).
std::string changeText(const py::handle& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  py::detail::make_caster<bool> truth;  // NumPy's too
  if (truth.load(value, false)) return truth ? "true" : "false";
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::vector<std::string> texts;
    for (const py::handle each : value)
      texts.push_back(py::isinstance<py::str>(each) ? fmt::format("'{}'", changeText(each))
                                                    : changeText(each));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  if (PyIndex_Check(value.ptr())) return py::str(py::int_(py::reinterpret_borrow<py::object>(value)));
  if (PyNumber_Check(value.ptr())) return py::repr(py::float_(py::reinterpret_borrow<py::object>(value)));
  throw py::type_error(fmt::format("a change is a number, a bool, a text or a list of these, got {}",
                                   std::string(py::repr(value))));
}

std::vector<SceneChange> changesOf(const py::dict& changed) {
  std::vector<SceneChange> changes;
  for (const auto& [key, value] : changed) {
    if (!py::isinstance<py::str>(key))
      throw py::type_error(fmt::format("a key of a scene is a text, got {}", std::string(py::repr(key))));
    changes.push_back({key.cast<std::string>(), changeText(value)});
  }
  return changes;
}

SceneObject loadSceneFile(const std::filesystem::path& path, const py::dict& changed, bool isConfined) {
  const std::vector<SceneChange> changes = changesOf(changed);
  return withoutGil([&] {
    const SceneFile file = sceneValueOf(readScene(path, changes, reachOf(isConfined)));
    return sceneOf(path.stem().string(), "", sceneValueOf(loadScene(file)), {file, path, {}});
  });
}
SceneObject parseText(const std::string& text, const std::filesystem::path& folder, const py::dict& changed,
                      bool isConfined) {
  const std::vector<SceneChange> changes = changesOf(changed);
  return withoutGil([&] {
    const SceneFile file = sceneValueOf(parseScene(text, "the scene", folder, changes, reachOf(isConfined)));
    return sceneOf("text", "", sceneValueOf(loadScene(file)), {file, {}, {}});
  });
}

SceneObject builtin(const std::string& name, const SceneOptions& options) {
  return withoutGil([&] {
    BuiltinScene made = valueOf(makeScene(name, options));
    SceneSource source{{}, {}, {{"scene", name}}};
    const auto add = [&](const char* option, const auto& value) {
      if (value) source.facts.push_back({option, fmt::format("{}", *value)});
    };
    add("particles", options.particles), add("strands", options.strands), add("preload", options.preload);
    add("contacts", options.contacts), add("seconds", options.seconds);
    return sceneOf(std::move(made.name), std::move(made.summary), std::move(made), std::move(source));
  });
}

SceneFrame frameOf(const LoadedScene& scene, int frame) {
  return withoutGil([&] { return valueOf(SceneFrames(scene).at(frame)); });
}

// As hair takes it.
HairObject::Frame posesOf(const SceneFrame& frame) {
  return {frame.heads, frame.bodies, frame.roots, frame.points};
}

void demandFrame(int frame) {
  if (frame < -kMostFrame || frame > kMostFrame)
    throw py::value_error(fmt::format("frame is from {} to {}, got {}", -kMostFrame, kMostFrame, frame));
}

// All that the scene says of a frame but where things are; none is in flight.
void prepareFrame(const SceneFrame& frame, HairObject& hair) {
  hair.ask([&](Simulation& simulation) { demand(prepare(frame, simulation)); });
}

void stepFrame(const SceneObject& self, HairObject& hair, int frame) {
  demandFrame(frame);
  const SceneFrame now = frameOf(self.loaded, frame);
  hair.demandNoneInFlight("Scene.step");
  if (hair.asset()->groom != self.groom)
    throw py::value_error("hair is of another scene; expected what start() of this one gave");
  prepareFrame(now, hair);
  hair.step(posesOf(now));
}

// The hair as it begins the first frame.
HairHandle startHair(const SceneObject& self, DeviceHandle device, const std::string& kernel) {
  if (!device)
    device = std::make_shared<DeviceObject>(
        DeviceObject{withoutGil([] { return valueOf(ComputeDevice::open()); })});
  const LoadedScene& scene = self.loaded;
  const AssetHandle asset =
      buildAsset(std::move(device), self.groom, MaterialObject{scene.material, {}}, scene.settings,
                 {.features = featuresOf(scene), .heads = 1, .kernel = kernel});
  const SceneFrames frames(scene);
  const ScenePlaces start = frames.placesAt(frames.first());
  HairHandle hair = makeHair(asset, stateOf(start, scene));
  if (scene.start) hair->setState(startOf({hair->positions(), hair->velocities()}, start, scene));
  for (int frame = frames.first(); frame < 0; ++frame) {
    const SceneFrame now = frameOf(scene, frame);
    prepareFrame(now, *hair);
    hair->step(posesOf(now));
  }
  return hair;
}

py::tuple sceneFramePoses(const SceneObject& self, int frame) {
  demandFrame(frame);
  const SceneFrame now = frameOf(self.loaded, frame);
  const auto given = [&](const std::vector<BodyPose>& each) {
    return each.empty() ? py::object(py::none()) : arrayOf(each, now.stepCount());
  };
  return py::make_tuple(arrayOf(now.heads), given(now.bodies), given(now.roots));
}

py::list sceneFramePoints(const SceneObject& self, int frame) {
  demandFrame(frame);
  const SceneFrame now = frameOf(self.loaded, frame);
  py::list all;
  for (const std::vector<Vec3d>& points : now.points)
    all.append(arrayOf(points).attr("reshape")(now.stepCount(), -1, 3));
  return all;
}

using SceneClass = py::class_<SceneObject>;

// The ways to make one.
void addSceneSources(SceneClass& scene) {
  scene
      .def_static(
          "load", &loadSceneFile, py::arg("path"), py::kw_only(), py::arg("changes") = py::dict(),
          py::arg("confined").noconvert() = false,
          "Reads a scene file (TOML) and all that it names: the groom, a motion by .bvh or glTF, meshes. "
          "changes: {key: value}, set before the file is read, as `ringlet sweep --vary` sets them: "
          "{'material.dials.hold': 2, 'body.1.radius': 0.1}. confined: for a file of a stranger's, which may then "
          "name files in or below its own folder only. "
          "ringlet.Error with file and line for what is wrong.")
      .def_static("parse", &parseText, py::arg("text"), py::arg("folder") = "", py::kw_only(),
                  py::arg("changes") = py::dict(), py::arg("confined").noconvert() = false,
                  "The same from text; its paths are relative to folder.")
      .def_static(
          "builtin",
          [](const std::string& name, std::optional<int> particles, std::optional<int> strands,
             std::optional<double> preload, std::optional<double> bendStiffness, std::optional<bool> contacts,
             std::optional<int> stepsPerFrame, std::optional<double> seconds) {
            return builtin(name, {.particles = particles,
                                  .strands = strands,
                                  .preload = preload,
                                  .bendStiffness = bendStiffness,
                                  .contacts = contacts,
                                  .stepsPerFrame = stepsPerFrame,
                                  .seconds = seconds});
          },
          py::arg("name"), py::kw_only(), py::arg("particles") = py::none(), py::arg("strands") = py::none(),
          py::arg("preload") = py::none(), py::arg("bend_stiffness") = py::none(),
          py::arg("contacts") = py::none(), py::arg("steps_per_frame") = py::none(),
          py::arg("seconds") = py::none(),
          "One of names(). What is None is the scene's own: particles of a strand, strands, the share of "
          "gravity balanced at rest, the material's bend_stiffness [w], contacts on or off, steps_per_frame, "
          "its length in seconds. ringlet.Error for another name, or a number out of its range.")
      .def_static(
          "names",
          [] {
            py::dict names;
            for (const std::string& name : sceneNames()) names[name.c_str()] = sceneSummary(name);
            return names;
          },
          "The built-in scenes by name, with what each shows: a dict.");
}

// What is in it.
void addSceneParts(SceneClass& scene) {
  scene.def_readonly("name", &SceneObject::name, "The built-in scene's, or the file's without its ending.")
      .def_readonly("summary", &SceneObject::summary, "What a built-in scene shows.")
      .def_readonly("groom", &SceneObject::groom, "The Groom, placed in the head's frame.")
      .def_property_readonly(
          "material",
          [](const SceneObject& s) {
            return MaterialObject{s.loaded.material, {}};
          },
          "A copy of the Material, its dials worked in.")
      .def_property_readonly(
          "settings", [](const SceneObject& s) { return s.loaded.settings; }, "A copy of the Settings.")
      .def_property_readonly(
          "motion", [](const SceneObject& s) { return MotionObject{s.loaded.motion}; }, "The head's Motion.")
      .def_property_readonly(
          "bodies",
          [](const SceneObject& s) {
            std::vector<BodyObject> bodies;
            for (const Body& body : s.loaded.bodies) bodies.push_back({body});
            return bodies;
          },
          "What hair stays out of: a list of Body.")
      .def_property_readonly(
          "root_shifts",
          [](const SceneObject& s) -> py::object {
            if (s.loaded.rootShifts.empty()) return py::none();
            return arrayOf(s.loaded.rootShifts);
          },
          "(strands, 3) [m], how far each root moves beside the head at shift 1; or None.")
      .def_property_readonly(
          "pre_roll_seconds", [](const SceneObject& s) { return s.loaded.preRollSeconds; },
          "How long the head moves before the first frame [s].")
      .def_property_readonly(
          "frame_count", [](const SceneObject& s) { return s.loaded.frameCount; },
          "How many frames a run has, unless it is told.")
      .def_property_readonly(
          "warnings", [](const SceneObject& s) { return s.loaded.warnings; },
          "What one should know of it: a list of sentences.");
}

// Its hair, frame by frame.
void addSceneFrames(SceneClass& scene) {
  scene
      .def("frame_poses", &sceneFramePoses, py::arg("frame"),
           "Where everything is at the end of each step of a frame, 0 the first: (head, body_poses, "
           "root_poses), as Hair.step takes them; None where there are none.")
      .def("frame_points", &sceneFramePoints, py::arg("frame"),
           "Where the meshes of bodies that bend are at the end of each step of a frame: body_points as "
           "Hair.step takes them, (steps, points, 3) each.")
      .def(
          "start",
          [](const SceneObject& self, const DeviceHandle& device, const std::string& kernel) {
            return startHair(self, device, kernel);
          },
          py::arg("device") = py::none(), py::kw_only(), py::arg("kernel") = "auto",
          "The scene's Hair as it begins the first frame, to be stepped with step, or with frame_poses. "
          "device: None: Device().")
      .def("step", &stepFrame, py::arg("hair"), py::arg("frame"),
           "Steps hair of start() through a frame, 0 the first, as a run does: with what keys, fields, holds "
           "and cuts give it then, where frame_poses has the motion only. Each cut is made by its own frame.")
      .def(
          "__repr__",
          [](const SceneObject& s) {
            return fmt::format("<ringlet.Scene {}: {} strands, {} frames>", s.name,
                               s.groom->groom().strandCount(), s.loaded.frameCount);
          },
          "What it is, in a line.");
}

}  // namespace

void addScenes(py::module_& module) {
  SceneClass scene(module, "Scene",
                   "All that a run starts from: groom, material, settings, motion, bodies. Constant.");
  addSceneSources(scene);
  addSceneParts(scene);
  addSceneFrames(scene);
  addRuns(module, scene);
}

}  // namespace ringlet::python
