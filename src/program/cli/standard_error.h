// Output on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/shown_text.h"

namespace ringlet::program {

/// Writes text unchanged: only for control sequences of the program itself, never for text from files.
inline void sayAsItIs(std::string_view line) { (void)std::fwrite(line.data(), 1, line.size(), stderr); }

/// As fmt::print, but never fails: if standard error is closed or full, the text is lost and the work goes
/// on. Control characters in file names and file contents are made visible (shown_text.h).
template <class... Arguments>
void say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  sayAsItIs(shownText(fmt::format(text, std::forward<Arguments>(arguments)...)));
}

}  // namespace ringlet::program
