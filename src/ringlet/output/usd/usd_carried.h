// What a groom's USD file says of its curves beside their points, as attributes of one prim of all strands.
#pragma once

#include <string_view>
#include <vector>

#include "ringlet/groom/loaded_groom.h"
#include "ringlet/output/usd/usd_stage.h"

namespace ringlet {

/// As an attribute; lengths (widths) times `unit`.
UsdStageAttribute carriedOf(const GroomValue& value, double unit);

/// What holds where an attribute of curves states no interpolation, "": "vertex", "uniform" or "constant".
std::string_view interpolationOf(std::string_view name, std::string_view stated);

/// Whether it can be written: a type we know, and numbers or texts of that type.
bool isWritten(const GroomValue& value);

/// Values that all prims have, of one type, one after the other: what is of all curves of a prim becomes a
/// value of each; what differs in kind, or has indices, is left aside where there are several prims. Lengths
/// are in the groom's unit.
std::vector<UsdStageAttribute> carriedValues(const std::vector<GroomPrim>& prims);

}  // namespace ringlet
