// A range of an animation's frames: "12:24", or "12" for a single one.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"

namespace ringlet::program {

/// Frames count from 1; first <= last.
struct FrameRange {
  int first = 1, last = 1;
};

/// None if the text is not such a range.
std::optional<FrameRange> parseFrameRange(const std::string& text);

/// Accepts such a text.
CLI::Validator isFrameRange();

}  // namespace ringlet::program
