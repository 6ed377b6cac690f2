// What came of a run, as one JSON object: that of `ringlet simulate --json`.
#pragma once

#include <string>

#include "ringlet/run/run_outcome.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// What the user chose, by the names of scene files and options.
struct RunNames {
  std::string integrator = "jacobi", backend = "gpu", material = "default";
};

/// In one line, without its end. What is not finite is null.
std::string runReport(const RunNames& names, const Settings& settings, const RunOutcome& outcome);

}  // namespace ringlet
