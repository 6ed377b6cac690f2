// AbcTransforms: what places an object of an Alembic file over time, which is the Xform objects above it
// (AbcGeom_Xform_v3): a list of operations, `.ops`, with their numbers, `.vals`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/usd/usd_matrix.h"

namespace ringlet {

class AbcTransforms {
 public:
  /// Of all objects above this one. Errors, with the object's path: operations that change, that the format
  /// does not have or that numbers are missing for; numbers that are not finite; a matrix that is not affine;
  /// more than the file has room for.
  static Result<AbcTransforms> of(const AbcArchive& archive, std::uint32_t object);

  /// The times at which one of them has a sample [s], rising; empty: none has.
  std::vector<double> seconds() const;
  /// At a time, from the object's space to the world. Numbers of operations go straight between two samples.
  UsdTransform at(double seconds) const;

 private:
  enum class Op : std::uint8_t { scale, translate, turn, matrix, turnX, turnY, turnZ };

  /// Numbers over time, `width` a sample.
  struct Track {
    std::size_t width = 0;
    std::vector<double> seconds{}, numbers{};

    std::vector<double> at(double t) const;
  };
  struct Xform {
    std::vector<Op> ops{};
    Track values{}, inherits{};
  };
  class Reader;

  static std::size_t widthOf(Op op);
  static UsdTransform transformOf(Op op, const double* numbers);

  std::vector<Xform> xforms_{};  // the nearest first
};

}  // namespace ringlet
