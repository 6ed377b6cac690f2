// shownText: a text as a terminal may get it.
#pragma once

#include <string>
#include <string_view>

namespace ringlet {

/// The text in UTF-8 without what commands a terminal: control characters (but for tabs and ends of lines),
/// DEL, those of C1 and bytes that are no UTF-8 become \xNN.
std::string shownText(std::string_view text);

/// A text of JSON in which no DEL and no character of C1 stands as it is, but as \u00NN; others JSON escapes
/// by itself.
std::string shownJson(std::string_view json);

}  // namespace ringlet
