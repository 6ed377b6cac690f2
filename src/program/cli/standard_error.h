// What the program says on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "ringlet/base/shown_text.h"

namespace ringlet::program {

/// To a terminal or a file as it is: what the program itself commands a terminal with, and nothing of a file.
inline void sayAsItIs(std::string_view line) { (void)std::fwrite(line.data(), 1, line.size(), stderr); }

/// As fmt::print, but it never fails: where standard error is closed or full nobody hears, and the work goes
/// on. What names of files and in files would command a terminal is shown instead (shown_text.h).
template <class... Arguments>
void say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  sayAsItIs(shownText(fmt::format(text, std::forward<Arguments>(arguments)...)));
}

}  // namespace ringlet::program
