// What `ringlet render` made, told as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "program/render/render_options.h"
#include "ringlet/run/run_report.h"

namespace ringlet::program {

struct RenderReport {
  const RenderOptions& typed;
  const RenderPlan& plan;
  const RenderOutcome& outcome;
  std::string device, driver;
};

/// The object of `ringlet render --json`.
nlohmann::ordered_json renderJson(const RenderReport& report);
/// Its keys, in its order.
std::vector<ReportKey> renderKeys();

}  // namespace ringlet::program
