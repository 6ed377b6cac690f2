// One line of `ringlet conform`.
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
    quirk,    // the driver is wrong where Ringlet does not rely on it
    skipped,  // the device lacks the checked feature, and Ringlet does not use it there
  };
  std::string name;
  Outcome outcome = Outcome::right;
  std::optional<double> figure{}, tolerance{};
  std::string detail{};       // of what is not right: where, expected, found; or a word on what was measured
  double compileSeconds = 0;  // the driver's part in it
};

/// What takes a check when it is done.
using Tell = std::function<void(const Check&)>;

/// The check that an error ended.
inline Check failed(const std::string& name, const Error& error) {
  return {.name = name, .outcome = Check::Outcome::wrong, .detail = error.message};
}

/// "right", "WRONG", "quirk" or "skipped".
const char* wordOf(Check::Outcome outcome);

}  // namespace ringlet::program
