// Whether the parameters of generated grooms are within their ranges (generate.h).
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/groom/generate.h"

namespace ringlet {

/// Errors name the parameter, its value and what is allowed.
Status checkParameters(const CurlParameters& parameters);
Status checkParameters(const SwatchParameters& parameters);
Status checkParameters(const HeadParameters& parameters);

}  // namespace ringlet
