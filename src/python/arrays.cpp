// Implements python/arrays.h.
#include "python/arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

namespace ringlet::python {
namespace {

static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Vec3d) == 3 * sizeof(double));

std::string shapeText(const py::array& array) {
  std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

std::string expectedPoints(const char* name, const char* type, std::optional<std::size_t> count) {
  return fmt::format("{} must be an array of {} with shape ({}, 3)", name, type,
                     count ? std::to_string(*count) : "particles");
}
constexpr const char* kTaken = "real numbers, best float32";
constexpr const char* kFilled = "float32";

// What NumPy casts to a float without losing what is meant: neither complex nor text nor truth.
bool hasRealType(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u';
}

bool isMasked(const py::handle& value) {
  if (PyFloat_CheckExact(value.ptr()) || PyLong_CheckExact(value.ptr())) return false;
  const py::module_ ma = py::module_::import("numpy").attr("ma");
  return py::isinstance(value, ma.attr("MaskedArray")) && ma.attr("is_masked")(value).cast<bool>();
}

// The data under a mask is what one has said not to use.
void demandUnmasked(const py::handle& value, const std::string& name) {
  if (isMasked(value))
    throw py::value_error(fmt::format("{} has masked elements; fill them first, as filled() does", name));
}

// As an array, whatever is in it; throws TypeError with this sentence where it is none.
template <class Refused>
py::array arrayIn(const py::object& value, const char* name, const Refused& refused) {
  demandUnmasked(value, name);
  const auto array = py::array::ensure(value);
  if (array) return array;
  PyErr_Clear();
  throw py::type_error(refused());
}

// Of a wider type only: a finite number that float32 does not hold would become infinite.
void demandFits(const py::array& array, const char* name) {
  if (array.dtype().kind() != 'f' || array.dtype().itemsize() <= 4) return;
  const auto wide = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  for (py::ssize_t i = 0; i < wide.size(); ++i) {
    const double number = wide.data()[i];
    if (std::isfinite(number) && !std::isfinite(static_cast<float>(number)))
      throw py::value_error(fmt::format(
          "{}: particle {} has {}, which is finite and which float32 does not hold", name, i / 3, number));
  }
}

// A number that is no more than that.
bool isReal(const py::handle& value) {
  if (PyFloat_Check(value.ptr()) || PyLong_CheckExact(value.ptr())) return true;
  if (PyBool_Check(value.ptr()) || PyComplex_Check(value.ptr()) || py::isinstance<py::str>(value))
    return false;
  if (py::hasattr(value, "dtype")) {
    const auto array = py::array::ensure(value);
    return array && hasRealType(array) && !isMasked(value);
  }
  return PyNumber_Check(value.ptr()) == 1;
}

bool hasPointsShape(const py::array& array, std::optional<std::size_t> count) {
  return array.ndim() == 2 && array.shape(1) == 3 &&
         (!count || array.shape(0) == static_cast<py::ssize_t>(*count));
}

void clearWriteable(const py::array& array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

// An array over memory of a list that it owns.
template <class T, class Element>
py::array_t<T> owning(std::vector<Element> list, std::vector<py::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<Element>>(std::move(list));
  const T* data = reinterpret_cast<const T*>(owned->data());
  const py::capsule owner(owned.get(), [](void* p) { delete static_cast<std::vector<Element>*>(p); });
  static_cast<void>(owned.release());  // the capsule deletes it
  return py::array_t<T>(std::move(shape), data, owner);
}

}  // namespace

std::string describe(const py::handle& value) {
  if (value.is_none()) return "None";
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    return fmt::format("an array of {} with shape {}", std::string(py::str(array.dtype())), shapeText(array));
  }
  return fmt::format("{} of type {}", std::string(py::repr(value)).substr(0, 60),
                     std::string(py::str(py::type::handle_of(value).attr("__name__"))));
}

PointsIn::PointsIn(const py::object& value, const char* name, std::optional<std::size_t> count) {
  const auto refused = [&] { return expectedPoints(name, kTaken, count) + ", got " + describe(value); };
  if (!py::isinstance<py::array>(value)) throw py::type_error(refused());
  const auto array = py::reinterpret_borrow<py::array>(value);
  if (!hasRealType(array)) throw py::type_error(refused());
  if (!hasPointsShape(array, count)) throw py::value_error(refused());
  demandUnmasked(value, name);
  demandFits(array, name);
  array_ = py::array_t<float, py::array::c_style | py::array::forcecast>(array);
  // Three floats in a row are a Vec3f, byte by byte.
  points_ = {reinterpret_cast<const Vec3f*>(array_.data()), static_cast<std::size_t>(array.shape(0))};
}

void demandFinite(std::span<const Vec3f> points, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3f p = points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw py::value_error(
        fmt::format("{} must be finite; particle {} is ({}, {}, {})", name, i, p.x, p.y, p.z));
  }
}

py::array_t<float> arrayOf(std::vector<Vec3f> points) {
  const auto count = static_cast<py::ssize_t>(points.size());
  return owning<float>(std::move(points), {count, 3});
}
py::array_t<double> arrayOf(const std::vector<Vec3d>& points) {
  return owning<double>(points, {static_cast<py::ssize_t>(points.size()), 3});
}
py::array_t<double> arrayOf(const std::vector<double>& values) {
  return owning<double>(values, {static_cast<py::ssize_t>(values.size())});
}

void demandOut(const py::object& out, std::size_t count) {
  if (out.is_none()) return;
  const std::string expected = expectedPoints("out", kFilled, count);
  if (!py::isinstance<py::array>(out)) throw py::type_error(expected + ", got " + describe(out));
  const auto array = py::reinterpret_borrow<py::array>(out);
  if (!array.dtype().equal(py::dtype::of<float>())) throw py::type_error(expected + ", got " + describe(out));
  if (!hasPointsShape(array, count)) throw py::value_error(expected + ", got " + describe(out));
  demandUnmasked(out, "out");
  if (!array.writeable() || !(array.flags() & py::array::c_style))
    throw py::value_error("out must be writable, its rows one after the other in memory (C order)");
}

py::object givePoints(std::vector<Vec3f> points, const py::object& out) {
  if (out.is_none()) return arrayOf(std::move(points));
  demandOut(out, points.size());
  auto array = py::reinterpret_borrow<py::array>(out);
  if (!points.empty()) std::memcpy(array.mutable_data(), points.data(), points.size() * sizeof(Vec3f));
  return out;
}

py::array viewOf(std::span<const Vec3f> points, const py::object& owner) {
  const auto count = static_cast<py::ssize_t>(points.size());
  py::array array(py::dtype::of<float>(), std::vector<py::ssize_t>{count, 3}, points.data(), owner);
  clearWriteable(array);
  return array;
}
py::array viewOf(std::span<const std::uint32_t> values, const py::object& owner) {
  const auto count = static_cast<py::ssize_t>(values.size());
  py::array array(py::dtype::of<std::uint32_t>(), std::vector<py::ssize_t>{count}, values.data(), owner);
  clearWriteable(array);
  return array;
}

std::vector<std::uint32_t> wholeNumbersOf(const py::object& value, const char* name) {
  const auto refused = [&] {
    return fmt::format("{} must be whole numbers from 0 to 4294967295 in one dimension, got {}", name,
                       describe(value));
  };
  const py::array array = arrayIn(value, name, refused);
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && array.size() > 0) throw py::type_error(refused());
  if (array.ndim() != 1) throw py::value_error(refused());
  const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(array);
  std::vector<std::uint32_t> values;
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const std::int64_t number = numbers.data()[i];
    if (number < 0 || number > std::numeric_limits<std::uint32_t>::max())
      throw py::value_error(fmt::format("{}: number {} is {}", refused(), i, number));
    values.push_back(static_cast<std::uint32_t>(number));
  }
  return values;
}

Rows rowsOf(const py::object& value, const char* name, std::size_t width, std::size_t otherWidth) {
  const auto refused = [&] {
    return fmt::format("{} must be numbers, {}{} a row, got {}", name, width,
                       otherWidth > 0 ? fmt::format(" or {}", otherWidth) : "", describe(value));
  };
  const py::array array = arrayIn(value, name, refused);
  if (!hasRealType(array)) throw py::type_error(refused());
  const auto last = array.ndim() > 0 ? static_cast<std::size_t>(array.shape(array.ndim() - 1)) : 0;
  if (last == 0 || (last != width && last != otherWidth)) throw py::value_error(refused());
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  Rows rows;
  rows.values.assign(numbers.data(), numbers.data() + numbers.size());
  for (py::ssize_t d = 0; d + 1 < array.ndim(); ++d)
    rows.shape.push_back(static_cast<std::size_t>(array.shape(d)));
  for (const double number : rows.values)
    if (!std::isfinite(number)) throw py::value_error(fmt::format("{} must be finite, got {}", name, number));
  return rows;
}

std::vector<double> numbersOf(const py::object& value, const char* name, std::size_t count) {
  const auto refused = [&] {
    return fmt::format("{} must be a number, or one for each of {} particles, got {}", name, count,
                       describe(value));
  };
  const py::array array = arrayIn(value, name, refused);
  if (!hasRealType(array)) throw py::type_error(refused());
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  if (array.ndim() == 0) return std::vector<double>(count, *numbers.data());
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != count)
    throw py::value_error(refused());
  return {numbers.data(), numbers.data() + numbers.size()};
}

double numberOf(const py::handle& value, const std::string& name) {
  if (isReal(value)) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (!(number == -1 && PyErr_Occurred())) return number;
    PyErr_Clear();
  }
  throw py::type_error(fmt::format("{} takes a number, got {}", name, describe(value)));
}

long long wholeNumberOf(const py::handle& value, const std::string& name) {
  const auto refused = [&] { return fmt::format("{} takes a whole number, got {}", name, describe(value)); };
  if (PyBool_Check(value.ptr()) || !PyIndex_Check(value.ptr())) throw py::type_error(refused());
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number) {
    PyErr_Clear();
    throw py::type_error(refused());
  }
  const long long whole = PyLong_AsLongLong(number.ptr());
  if (whole == -1 && PyErr_Occurred()) {
    PyErr_Clear();
    throw py::value_error(refused());
  }
  return whole;
}

Vec3d vectorOf(const py::handle& value, const std::string& name) {
  const auto refused = [&] { return fmt::format("{} takes three numbers, got {}", name, describe(value)); };
  if (!PySequence_Check(value.ptr()) || py::isinstance<py::str>(value)) throw py::type_error(refused());
  const auto sequence = py::reinterpret_borrow<py::sequence>(value);
  if (py::len_hint(value) != 3) throw py::value_error(refused());
  double numbers[3];
  for (std::size_t i = 0; i < 3; ++i) {
    numbers[i] = numberOf(py::object(sequence[i]), name);
    if (!std::isfinite(numbers[i]))
      throw py::value_error(fmt::format("{} takes three finite numbers, got {}", name, describe(value)));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace ringlet::python
