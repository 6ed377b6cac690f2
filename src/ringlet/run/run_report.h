// The outcome of a run as one JSON object, as `ringlet simulate --json` prints it.
#pragma once

#include <string>
#include <vector>

#include "ringlet/run/run_outcome.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// The user's choices, by their names in scene files and options.
struct RunNames {
  std::string integrator = "jacobi", backend = "gpu", material = "default";
};

/// One line, without a line end. Numbers that are not finite become null.
std::string runReport(const RunNames& names, const Settings& settings, const RunOutcome& outcome);

struct ReportKey {
  const char* key;
  const char* unit;                             // "" for none
  const char* effect;                           // what it says, a sentence
  std::vector<ReportKey> (*parts)() = nullptr;  // the keys of an object that it holds; none: it holds none,
                                                // or any names
};

/// Every key of the object, in its order.
std::vector<ReportKey> runReportKeys();

}  // namespace ringlet
