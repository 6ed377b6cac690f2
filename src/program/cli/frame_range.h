// Which frames of an animation: "12:24", or "12" for one.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// From 1; `first` is not after `last`.
struct FrameRange {
  int first = 1, last = 1;
};

/// None where the text is no such range.
std::optional<FrameRange> parseFrameRange(const std::string& text);

/// Accepts such a text.
CLI::Validator isFrameRange();

}  // namespace ringlet::program
