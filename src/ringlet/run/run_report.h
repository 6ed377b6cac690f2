// What came of a run, as one JSON object: that of `ringlet simulate --json`.
#pragma once

#include <span>
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

struct ReportKey {
  const char* key;
  const char* unit;    // "" for none
  const char* effect;  // what it says, a sentence
};

/// Every key of the object, in its order.
std::span<const ReportKey> runReportKeys();

}  // namespace ringlet
