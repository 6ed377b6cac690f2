// The strands of a USD layer: its BasisCurves, placed as its transforms say.
#pragma once

#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// All BasisCurves of the layer, in its order. Cubic ones become strands by cubic_curve.h. Of values that
/// move the first sample counts. Left out, with a warning: what is inactive, invisible, a class, only an
/// `over`, a proxy, or the prototype of an instancer, and curves of too few points. Warned of as well: Z that
/// was turned to Y or Y to Z, cubic curves, ends that a basis does not reach, other kinds of curves, and what
/// other files would bring in elsewhere. Errors: no strands; what composes the curves from elsewhere
/// (references, payloads, variants, sublayers and so on); periodic curves; a count that does not fit; numbers
/// that are not finite, and transforms that cannot be followed. `name` is the file's.
Result<LoadedGroom> groomOfUsd(const UsdLayer& layer, const GroomReading& reading, const std::string& name);

/// The time codes of the samples of curves that are drawn, and of what places them, in any order; the samples
/// or their places are those of the layer (UsdAttribute). None: nothing moves.
std::vector<double> usdGroomTimes(const UsdLayer& layer, const std::string& name);

}  // namespace ringlet
