// Arrays of NumPy's and lists of the library's. What has another shape or type than said is refused with both
// in words.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "python/binding.h"
#include "ringlet/base/vec3.h"

namespace ringlet::python {

/// (particles, 3) float32 as the library reads it: without a copy where that is the type and rows follow each
/// other in memory. Other real numbers are converted. Keeps the array alive.
class PointsIn {
 public:
  /// `count`: how many it must have; none: any. Throws TypeError for what is no array of real numbers,
  /// ValueError for another shape, masked elements and what float32 does not hold; `name` is for messages.
  PointsIn(const py::object& value, const char* name, std::optional<std::size_t> count = {});

  std::span<const Vec3f> points() const { return points_; }

 private:
  py::array_t<float, py::array::c_style> array_;
  std::span<const Vec3f> points_;
};

/// Throws ValueError for one that is not finite, with its index.
void demandFinite(std::span<const Vec3f> points, const char* name);

/// An array that owns the list: nothing is copied.
py::array_t<float> arrayOf(std::vector<Vec3f> points);
py::array_t<double> arrayOf(const std::vector<Vec3d>& points);
py::array_t<double> arrayOf(const std::vector<double>& values);

/// Into `out`, (particles, 3) float32, writable, its rows one after the other; None: into a new array.
/// Returns it.
py::object givePoints(std::vector<Vec3f> points, const py::object& out);
/// Checks `out` alone, so that nothing is lost to a wrong one.
void demandOut(const py::object& out, std::size_t count);

/// What cannot be written to, of memory that lives as long as `owner`.
py::array viewOf(std::span<const Vec3f> points, const py::object& owner);
py::array viewOf(std::span<const std::uint32_t> values, const py::object& owner);

/// Numbers of one dimension that are whole and fit; any integer type.
std::vector<std::uint32_t> wholeNumbersOf(const py::object& value, const char* name);
/// `width` numbers a row, of any shape whose last dimension that is; finite.
struct Rows {
  std::vector<double> values;
  std::vector<std::size_t> shape;  // but for the last dimension

  std::size_t count(std::size_t width) const { return values.size() / width; }
};
Rows rowsOf(const py::object& value, const char* name, std::size_t width, std::size_t otherWidth = 0);

/// One for each of `count` particles, of a number for all or an array.
std::vector<double> numbersOf(const py::object& value, const char* name, std::size_t count);

/// Of a number or a sequence of three, finite.
double numberOf(const py::handle& value, const std::string& name);
long long wholeNumberOf(const py::handle& value, const std::string& name);
Vec3d vectorOf(const py::handle& value, const std::string& name);

/// "a list", "an array of float64 with shape (4, 2)".
std::string describe(const py::handle& value);

}  // namespace ringlet::python
