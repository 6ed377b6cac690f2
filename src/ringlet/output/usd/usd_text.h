// Parts of a UsdStage as USD text.
#pragma once

#include <string>

#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/usd/usd_stage.h"

namespace ringlet {

/// A line, or several, of an attribute that has a value: "    float[] widths = [1, 2] (...)". Numbers are the
/// shortest that read back as the same, whatever the locale. `indent`: blanks before it.
std::string usdTextOf(const UsdStageAttribute& attribute, std::size_t indent);

/// "    prepend apiSchemas = ["GroomAPI"]", a line; nothing for none.
std::string usdTextOf(const std::vector<std::string>& apiSchemas, std::size_t indent);

/// A whole file of what rests.
std::string usdTextOf(const UsdStage& stage);

/// "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )".
std::string usdTextOf(const UsdTransform& transform);

}  // namespace ringlet
