// The measuring of `ringlet measure`: reads a groom and what became of it. The measures are
// src/ringlet/measure, the telling measure_report.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "program/cli/key_options.h"
#include "program/measure/measure_report.h"
#include "ringlet/base/result.h"

namespace ringlet::program {

struct MeasurePlan {
  std::filesystem::path rest, other, against, without, plot;
  std::vector<std::filesystem::path> over;
  std::optional<double> metresPerUnit;
  std::optional<std::string> up;
  TypedKeys reading;
};

/// What became of plan.rest in plan.other; the plot too, if there is to be one. Warnings go to standard
/// error.
Result<Measured> runMeasure(const MeasurePlan& plan);

}  // namespace ringlet::program
