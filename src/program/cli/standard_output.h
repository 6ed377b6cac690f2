// What the program prints on standard output.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "ringlet/base/shown_text.h"

namespace ringlet::program {

/// As fmt::print. What names of files and in files would command a terminal is shown instead (shown_text.h).
template <class... Arguments>
void print(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  fmt::print("{}", shownText(fmt::format(text, std::forward<Arguments>(arguments)...)));
}

/// An object as the last thing on standard output. Not UTF-8, say in a path, is replaced rather than fatal.
void printJson(const nlohmann::ordered_json& json);

}  // namespace ringlet::program
