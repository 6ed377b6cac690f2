// What all parts of the Python module share: how they fail, and how they let other threads of Python run.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/shown_text.h"

namespace ringlet::python {

namespace py = pybind11;

/// An Error of the library on its way to Python, where it is a ringlet.Error.
class Failure : public std::exception {
 public:
  explicit Failure(Error why) : error{shownText(why.message), why.fault} {}
  const char* what() const noexcept override { return error.message.c_str(); }

  Error error;
};

/// What a Result holds; throws Failure.
template <class T>
T valueOf(Result<T> result) {
  if (!result) throw Failure(result.error());
  return std::move(*result);
}
inline void demand(const Status& status) {
  if (!status) throw Failure(status.error());
}

/// Lets other threads of Python run until it ends. A daemon thread that is here when the interpreter ends
/// stays here: CPython would unwind it through destructors, which ends the process.
class GilReleased {
 public:
  GilReleased() : state_(PyEval_SaveThread()) {}
  ~GilReleased();
  GilReleased(const GilReleased&) = delete;
  /// Takes it for a moment: whether a signal's handler has raised something (Ctrl-C), which is to be raised
  /// again once this has ended.
  bool isInterrupted();
  GilReleased& operator=(const GilReleased&) = delete;

 private:
  void takeBack();
  PyThreadState* state_;
};

/// Work of the library's during which other threads of Python run. It touches nothing of Python's.
template <class Work>
auto withoutGil(Work&& work) {
  const GilReleased released;
  return work();
}

/// "there is no setting 'gravty'; did you mean gravity?"
std::string unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& names);

// The parts of the module, in the order in which they know each other.
void addGrooms(py::module_& module);
void addMaterials(py::module_& module);
void addSettings(py::module_& module);
void addMotions(py::module_& module);
void addBodies(py::module_& module);
void addFields(py::module_& module);
void addDevices(py::module_& module);
void addAssets(py::module_& module);
void addHair(py::module_& module);
void addFollowers(py::module_& module);
void addScenes(py::module_& module);
void addMeasures(py::module_& module);
void addAnimations(py::module_& module);
void addPictures(py::module_& module);

}  // namespace ringlet::python
