// What the program says on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace ringlet::program {

/// As fmt::print, but it never fails: where standard error is closed or full nobody hears, and the work goes
/// on.
template <class... Arguments>
void say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  const std::string line = fmt::format(text, std::forward<Arguments>(arguments)...);
  (void)std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace ringlet::program
