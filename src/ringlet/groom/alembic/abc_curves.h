// AbcCurves: what an Alembic object with curves (AbcGeom_Curve_v2) says of them at its first sample, or at a
// time.
//   P                   f32 x 3, a point each
//   nVertices           points of each curve
//   curveBasisAndType   u8 x 4: 0 cubic, 1 linear, 2 of other orders; 1 closed; 0 none, 1 Bezier, 2 B-spline,
//                       3 Catmull-Rom, 4 Hermite, 5 power
//   .orders, .knots, w  of NURBS: an order (degree and 1) each curve; as many knots as points and order;
//   weights
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/alembic/abc_params.h"
#include "ringlet/groom/curve_strands.h"

namespace ringlet {

struct AbcCurves {
  ObjectCurves curves{};  // a view of `numbers`
  CurveForm form{};
  std::vector<double> numbers{};  // 3 a point; of curves with knots, the points of the Bezier curves they are
  std::optional<double> seconds{};       // where its points move: when they are so
  std::optional<double> emptySeconds{};  // and when they are not there yet
  bool hasOtherKnots = false;            // that do not fit: even ones were taken
};

/// What of an object is read.
struct AbcReading {
  std::uint32_t pointsPerStrand = 0;  // as of GroomReading
  std::optional<double> seconds{};    // none: its first sample with points
};

/// Of an object with these properties, those in its `.geom`. Between two samples of as many points these go
/// straight, and all else is as at the one before. Error: a sentence that says what is missing, of another
/// type or not read, or the budget's state. Cost: linear in the samples.
Result<AbcCurves> readAbcCurves(const AbcArchive& archive, std::uint32_t object,
                                const std::vector<AbcProperty>& properties, const AbcReading& reading,
                                AbcBudget& budget);

}  // namespace ringlet
