// One check, a line of `ringlet conform`.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "ringlet/base/result.h"

namespace ringlet::program {

struct Check {
  enum class Outcome {
    right,
    wrong,    // the device does not conform
    quirk,    // the driver is wrong, but Ringlet does not rely on this
    skipped,  // the device lacks the checked feature, and Ringlet does not use it there
  };
  std::string name;
  Outcome outcome = Outcome::right;
  std::optional<double> figure{}, tolerance{};
  std::string detail{};       // if not right: where, expected, found; else a note on what was measured
  double compileSeconds = 0;  // time that the driver took
};

/// Receives a check when it is done.
using Tell = std::function<void(const Check&)>;

/// A check that ended with an error.
inline Check failed(const std::string& name, const Error& error) {
  return {.name = name, .outcome = Check::Outcome::wrong, .detail = error.message};
}

/// "right", "WRONG", "quirk" or "skipped".
const char* wordOf(Check::Outcome outcome);

}  // namespace ringlet::program
