// Output on standard output.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "ringlet/base/shown_text.h"

namespace ringlet::program {

/// As fmt::print. Control characters in file names and file contents are made visible (shown_text.h).
template <class... Arguments>
void print(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  fmt::print("{}", shownText(fmt::format(text, std::forward<Arguments>(arguments)...)));
}

/// Prints an object as the last output. Text that is not UTF-8, for example in a path, is replaced; it is no
/// error.
void printJson(const nlohmann::ordered_json& json);

}  // namespace ringlet::program
