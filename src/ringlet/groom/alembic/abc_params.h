// Geometry parameters of Alembic's curves (width, uv, N, .velocities and what stands in .arbGeomParams) as
// the values that grooms carry. A parameter is an array, or a compound of .vals and .indices into them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ringlet/base/result.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// How much is still read of a file, whose objects may share what it stores once: numbers, samples and
/// properties together, AbcArchive::mostNumbers() in all. What cannot be left out ends here.
class AbcBudget {
 public:
  explicit AbcBudget(const AbcArchive& archive);

  /// False: so much is not left, and state() says so from now on.
  bool take(std::size_t count);
  void fail(const Error& error) { state_ = error; }
  const Status& state() const { return state_; }

 private:
  const AbcArchive& archive_;
  std::size_t left_ = 0;
  Status state_{};
};

struct AbcParam {
  GroomValue value{};     // its interpolation is empty where the file states no scope
  std::size_t width = 1;  // numbers of an element
  std::size_t size() const { return value.texts.empty() ? value.numbers.size() / width : value.texts.size(); }
};

/// Nothing: it changes over time, has no samples, elements of more than 4 numbers, integers that are not
/// exact as doubles, or indices of no value; a sample is broken; or the budget's state is an error now. The
/// value's name is the property's with `primvars:` before it and `_` for what USD has not in names ("widths"
/// of `width`, st of `uv`); its type USD's of as many bits or, of integers, int or int64. Cost: linear in its
/// numbers.
std::optional<AbcParam> readAbcParam(const AbcArchive& archive, const AbcProperty& property,
                                     AbcBudget& budget);

}  // namespace ringlet
