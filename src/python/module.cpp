// The Python module `ringlet`: the library for scripts and notebooks. Its parts are in the other files.
#include <cxxabi.h>
#include <fmt/format.h>
#include <unistd.h>

#include "python/binding.h"
#include "ringlet/base/nearest_name.h"
#include "ringlet/version.h"

namespace ringlet::python {
namespace {

constexpr const char* kModuleDoc =
    "Ringlet: curly hair on Vulkan devices.\n\n"
    "    groom = ringlet.make_head(strands=200)\n"
    "    asset = ringlet.Asset(ringlet.Device(), groom, ringlet.Material.preset(\"ringlet\"))\n"
    "    hair = ringlet.Hair(asset)\n"
    "    hair.step(ringlet.Pose((0.02, 0, 0)))\n"
    "    hair.positions()                        # (particles, 3) float32 [m]\n\n"
    "Lengths are in metres, times in seconds, rotations are quaternions x, y, z, w. Points are NumPy arrays "
    "of float32 with shape (particles, 3), in the groom's order: strand after strand, root first.\n\n"
    "Errors: ringlet.Error where files, settings, memory or the device are at fault; ValueError and "
    "TypeError where an argument is; KeyError and AttributeError for a name that there is not.\n\n"
    "Threads: while the device works, other threads of Python run. Two that use one object at a time wait "
    "for each other; several hairs on one device may each have a thread.";

const char* nameOf(Fault fault) {
  switch (fault) {
    case Fault::input:
      return "input";
    case Fault::output:
      return "output";
    case Fault::diskFull:
      return "disk_full";
    case Fault::busy:
      return "busy";
    case Fault::hostMemory:
      return "host_memory";
    case Fault::deviceMemory:
      return "device_memory";
    case Fault::deviceLost:
      return "device_lost";
    case Fault::compile:
      return "compile";
    case Fault::other:
      break;
  }
  return "other";
}

PyObject* errorType = nullptr;  // ringlet.Error; lives as long as the program

void addError(py::module_& module) {
  errorType = PyErr_NewExceptionWithDoc(
      "ringlet.Error",
      "What a file, the settings, memory or the device are at fault for, as a sentence: what was tried, what "
      "was found, what to do.\n\n"
      "`fault` says whose it is: \"input\", \"output\", \"disk_full\", \"busy\", \"host_memory\", "
      "\"device_memory\", \"device_lost\", \"compile\" or \"other\".",
      PyExc_RuntimeError, nullptr);
  if (!errorType) throw py::error_already_set();
  py::setattr(errorType, "fault", py::str(nameOf(Fault::other)));
  module.add_object("Error", errorType);
  // NOLINTNEXTLINE(performance-unnecessary-value-param): by value is pybind11's signature
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      const py::object error = py::reinterpret_borrow<py::object>(errorType)(failure.error.message);
      error.attr("fault") = nameOf(failure.error.fault);
      PyErr_SetObject(errorType, error.ptr());
    }
  });
}

}  // namespace

GilReleased::~GilReleased() { takeBack(); }

bool GilReleased::isInterrupted() {
  takeBack();
  const bool isIt = PyErr_CheckSignals() != 0;
  state_ = PyEval_SaveThread();
  return isIt;
}

void GilReleased::takeBack() {
  try {
    PyEval_RestoreThread(state_);
  } catch (abi::__forced_unwind&) {
    while (true) pause();
  }
}

std::string unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& names) {
  const std::size_t nearest = nearestName(name, names);
  return fmt::format("there is no {} '{}'{}", what, name,
                     nearest < names.size() ? "; did you mean " + names[nearest] + "?" : "");
}

}  // namespace ringlet::python

PYBIND11_MODULE(ringlet, module) {
  using namespace ringlet::python;
  module.doc() = kModuleDoc;
  module.attr("__version__") = RINGLET_VERSION;
  addError(module);
  addGrooms(module);
  addMaterials(module);
  addSettings(module);
  addMotions(module);
  addBodies(module);
  addFields(module);
  addDevices(module);
  addAssets(module);
  addHair(module);
  addFollowers(module);
  addScenes(module);
  addMeasures(module);
  addAnimations(module);
  addPictures(module);
}
