// quoted: a piece of a file as it may stand in a message.
#pragma once

#include <string>
#include <string_view>

namespace ringlet {

/// The text in quotes: bytes that are no printable ASCII as \xNN, and no more than 32 bytes, then "...".
std::string quoted(std::string_view text);

}  // namespace ringlet
