// Runs of scenes: frames, files, checkpoints.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/assets.h"
#include "python/hair.h"
#include "python/poses.h"
#include "python/scenes.h"
#include "python/words.h"
#include "ringlet/pictures/follow_mover.h"
#include "ringlet/run/divided_hair.h"
#include "ringlet/run/run.h"
#include "ringlet/run/run_facts.h"
#include "ringlet/run/run_report.h"

namespace ringlet::python {
namespace {

// What a callback sees of a frame.
struct FrameObject {
  int number = 0;  // 1 for the first
  double seconds = 0;
  HeadPose head;
  double metresPerUnit = 1;
  py::object positions;
};

py::object framePointsOf(const FrameObject& frame) {
  const PointsIn in(frame.positions, "positions");
  std::vector<Vec3f> points(in.points().begin(), in.points().end());
  placeInWorld(points, frame.head, frame.metresPerUnit);
  return arrayOf(std::move(points));
}

struct RunResult {
  RunOutcome outcome;
  RunNames names;
  Settings settings;
  HeadPose head;  // at the end
  double metresPerUnit = 1;
};

// As Python has them.
struct RunAsked {
  std::optional<int> frames;
  DeviceHandle device;
  std::optional<std::vector<DeviceHandle>> devices;
  std::string kernel = "auto";
  std::optional<std::filesystem::path> folder;
  std::optional<std::vector<std::string>> files;
  std::optional<int> hairs;
  int checkpoint = 0;
  std::string leftovers = "refuse";
  bool measuresContacts = false;
};

Leftovers leftoversOf(const std::string& name) {
  if (name == "refuse") return Leftovers::refuse;
  if (name == "overwrite") return Leftovers::overwrite;
  if (name == "resume") return Leftovers::resume;
  if (name == "resume_or_overwrite") return Leftovers::resumeOrOverwrite;
  throw py::value_error(
      unknownName("leftovers", name, {"refuse", "overwrite", "resume", "resume_or_overwrite"}));
}

std::vector<ComputeDevice> devicesOf(const RunAsked& asked) {
  std::vector<ComputeDevice> devices;
  if (asked.devices) {
    if (asked.device) throw py::value_error("give device or devices, not both");
    if (asked.devices->empty()) throw py::value_error("devices must not be empty; None: one, Device()");
    for (const DeviceHandle& device : *asked.devices) {
      if (!device) throw py::type_error("devices must be of Device, got None");
      devices.push_back(device->device);
    }
  } else {
    devices.push_back(asked.device ? asked.device->device
                                   : withoutGil([] { return valueOf(ComputeDevice::open()); }));
  }
  return devices;
}

// What the scene's [output] says, and what was asked in its place.
SceneOutput outputOf(const SceneSource& source, const RunAsked& asked) {
  SceneOutput output = source.file ? source.file->output : SceneOutput{};
  if (asked.files) {
    if (Status chosen = chooseFiles(*asked.files, output); !chosen)
      throw py::value_error(chosen.error().message);
  }
  if (asked.hairs) output.hairs = *asked.hairs;
  return output;
}

RunOptions optionsOf(const SceneSource& source, const RunAsked& asked) {
  SceneFile file = source.file.value_or(SceneFile{});
  file.output = outputOf(source, asked);
  RunOptions options = runOptionsOf(file);
  options.folder = asked.folder.value_or("");
  options.checkpointFrames = asked.checkpoint;
  options.leftovers = leftoversOf(asked.leftovers);
  options.facts = source.facts;
  options.measuresContacts = asked.measuresContacts;
  options.words = {.overwrite = "leftovers=\"overwrite\"",
                   .resume = "leftovers=\"resume\"",
                   .elsewhere = "another folder",
                   .who = "ringlet in Python"};
  return options;
}

void check(const RunAsked& asked, int count, const py::object& callback) {
  if (count < 0) throw py::value_error(fmt::format("frames must be 0 or more, got {}", count));
  if (asked.checkpoint < 0)
    throw py::value_error(fmt::format("checkpoint must be 0 or more frames, got {}", asked.checkpoint));
  if (asked.hairs && *asked.hairs < 0)
    throw py::value_error(fmt::format("hairs must be 0 or more, got {}", *asked.hairs));
  if (!callback.is_none() && !PyCallable_Check(callback.ptr()))
    throw py::type_error("callback must be callable, got " + describe(callback));
  if (asked.folder) return;
  if (asked.files || asked.hairs || asked.checkpoint > 0 || asked.leftovers != "refuse")
    throw py::value_error("files, hairs, checkpoint and leftovers are of a run that writes; give a folder");
}

// Shows frames to the callback on the thread that called run, one after the other.
class Shown {
 public:
  Shown(const py::object& callback, double fps, double metresPerUnit)
      : callback_(callback), fps_(fps), metresPerUnit_(metresPerUnit) {}

  /// Without the GIL.
  void take(const ComputedFrame& frame) {
    head = frame.head;
    if (wantsFrames_) frame_ = frame;
  }
  /// Whether to go on. What the callback raises, and Ctrl-C, is raised again by raise.
  bool goesOn() {
    if (PyErr_CheckSignals() != 0) return fails();
    if (!frame_) return true;
    const FrameObject shown{frame_->number, frame_->number / fps_, frame_->head, metresPerUnit_,
                            arrayOf(std::move(frame_->positions))};
    frame_.reset();
    try {
      if (!callback_(shown).is(py::bool_(false))) return true;
    } catch (py::error_already_set& raised) {
      raised_.emplace(raised);
    }
    wantsFrames_ = false;
    return false;
  }
  void raise() {
    if (raised_) throw py::error_already_set(*raised_);
  }
  HeadPose head;

 private:
  bool fails() {
    raised_.emplace();
    wantsFrames_ = false;
    return false;
  }

  const py::object& callback_;
  double fps_, metresPerUnit_;
  bool wantsFrames_ = !callback_.is_none();
  std::optional<ComputedFrame> frame_{};
  std::optional<py::error_already_set> raised_{};
};

RunResult runScene(const SceneObject& self, const py::object& callback, const RunAsked& asked) {
  const int count = asked.frames.value_or(self.loaded.frameCount);
  check(asked, count, callback);
  const std::vector<ComputeDevice> devices = devicesOf(asked);
  KernelChoice kernel = kernelNamed(asked.kernel);
  RunOptions options = optionsOf(self.source, asked);
  options.mover = followOn(devices.front());
  std::optional<LoadedGroom> origin;
  LoadedScene scene = self.whole();
  scene.frameCount = count;
  Shown shown(callback, scene.settings.framesPerSecond, scene.groom.metresPerUnit);
  shown.head = scene.motion.poseAt(0);
  auto run = withoutGil([&] {
    if (self.source.file && asked.folder)
      demandScene(prepareRun(*self.source.file, self.source.path, origin, options));
    return sceneValueOf(Run::open(scene, std::move(options), hairOn(devices, kernel),
                                  {.computed = [&](const ComputedFrame& frame) { shown.take(frame); }}));
  });
  for (bool more = true; more;) {
    more = withoutGil([&] { return sceneValueOf(run.next()); });
    more = shown.goesOn() && more;
  }
  RunOutcome outcome = withoutGil([&] { return sceneValueOf(run.finish()); });
  shown.goesOn();
  shown.raise();
  outcome.warnings = inSceneWords(std::move(outcome.warnings));
  RunNames names;
  if (self.source.file) {
    names.integrator = self.source.file->simulation.integrator;
    if (self.source.file->hasMaterial) names.material = "scene";
  }
  return {std::move(outcome), std::move(names), scene.settings, shown.head, scene.groom.metresPerUnit};
}

py::object runReportOf(const RunResult& run) {
  const std::string text = runReport(run.names, run.settings, run.outcome);
  return py::module_::import("json").attr("loads")(text);
}

void addFrame(py::module_& module) {
  py::class_<FrameObject>(module, "Frame", "A frame of a scene's run, as its callback sees it.")
      .def_readonly("number", &FrameObject::number, "1 for the first.")
      .def_readonly("seconds", &FrameObject::seconds, "Its end, since the start [s].")
      .def_readonly("head", &FrameObject::head, "Where the head is at its end: a Pose.")
      .def_readonly(
          "positions", &FrameObject::positions,
          "(particles, 3) float32 [m], seen from the head, along the world's axes: the callback's own.")
      .def("points", &framePointsOf,
           "(particles, 3) float32: the same in the world, in the groom's unit, as files hold them.")
      .def(
          "__repr__", [](const FrameObject& f) { return fmt::format("<ringlet.Frame {}>", f.number); },
          "What it is, in a line.");
}

void addResult(py::module_& module) {
  py::class_<RunResult>(module, "RunResult", "What came of a scene's run. Constant.")
      .def_property_readonly(
          "frame_count", [](const RunResult& r) { return r.outcome.frameCount; },
          "Frames that are done, with those of a run before that was resumed.")
      .def_property_readonly(
          "interrupted", [](const RunResult& r) { return r.outcome.interrupted; },
          "Whether it ended before its last frame.")
      .def_property_readonly(
          "can_resume", [](const RunResult& r) { return r.outcome.canResume; },
          "Whether a checkpoint is there to go on from; files are then not finished.")
      .def_property_readonly(
          "resumed_from", [](const RunResult& r) { return r.outcome.resumedFrom; },
          "Frames that a run before had done.")
      .def_property_readonly(
          "positions_hash", [](const RunResult& r) { return r.outcome.positionsHash; },
          "Of positions(), as `ringlet simulate --json` tells it.")
      .def_property_readonly(
          "outputs", [](const RunResult& r) { return r.outcome.outputs; }, "The files: a list of paths.")
      .def_property_readonly(
          "warnings", [](const RunResult& r) { return r.outcome.warnings; },
          "What one should know of scene and run: a list of sentences.")
      .def_property_readonly("report", &runReportOf,
                             "All that is known of it: a dict, as `ringlet simulate --json` prints it.")
      .def_property_readonly(
          "head", [](const RunResult& r) { return r.head; }, "Where the head is at the end: a Pose.")
      .def(
          "positions", [](const RunResult& r) { return arrayOf(std::vector<Vec3f>(r.outcome.positions)); },
          "(particles, 3) float32 [m] after the last frame, seen from the head, along the world's axes.")
      .def(
          "points",
          [](const RunResult& r) {
            std::vector<Vec3f> points = r.outcome.positions;
            placeInWorld(points, r.head, r.metresPerUnit);
            return arrayOf(std::move(points));
          },
          "(particles, 3) float32: the same in the world, in the groom's unit, as files hold them.")
      .def(
          "__repr__",
          [](const RunResult& r) {
            return fmt::format("<ringlet.RunResult: {} frames{}>", r.outcome.frameCount,
                               r.outcome.interrupted ? ", interrupted" : "");
          },
          "What it is, in a line.");
}

}  // namespace

void addRuns(py::module_& module, py::class_<SceneObject>& scene) {
  addFrame(module);
  addResult(module);
  scene.def(
      "run",
      [](const SceneObject& self, const py::object& callback, std::optional<int> frames, DeviceHandle device,
         std::optional<std::vector<DeviceHandle>> devices, std::string kernel,
         std::optional<std::filesystem::path> folder, std::optional<std::vector<std::string>> files,
         std::optional<int> hairs, int checkpoint, std::string leftovers, bool measuresContacts) {
        return runScene(self, callback,
                        {frames, std::move(device), std::move(devices), std::move(kernel), std::move(folder),
                         std::move(files), hairs, checkpoint, std::move(leftovers), measuresContacts});
      },
      py::arg("callback") = py::none(), py::kw_only(), py::arg("frames") = py::none(),
      py::arg("device") = py::none(), py::arg("devices") = py::none(), py::arg("kernel") = "auto",
      py::arg("folder") = py::none(), py::arg("files") = py::none(), py::arg("hairs") = py::none(),
      py::arg("checkpoint") = 0, py::arg("leftovers") = "refuse",
      py::arg("measure_contacts").noconvert() = false,
      "Steps frame after frame, as `ringlet simulate` does, and returns a RunResult. callback: is given a "
      "Frame after each, while the device computes the next; where it returns False, the run ends with the "
      "one under way, and what it raises ends it too. frames: None: frame_count. device: None: Device(). "
      "devices: the strands are divided among them. folder: where files go; None: there are none. files: "
      "which, by name (hair.usda, hair.usdc, last.obj, sheet.png ...); None: what the scene's [output] says, "
      "as all else about them. hairs: animations have so many, which follow the strands; 0: the strands. "
      "checkpoint: frames from one to the next that a killed run can go on from; 0: none. leftovers: of what "
      "a run before left in the folder: refuse, overwrite, resume, resume_or_overwrite. measure_contacts: "
      "every step and frame; costs CPU time. ringlet.Error: of scene, device, folder and files; frames "
      "finished before it are kept.");
}

}  // namespace ringlet::python
