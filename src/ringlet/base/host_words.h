// Sentences of the library tell what to type: options of the command and keys of scene files. A host of the
// library has no options, and without a scene file no keys: it says the same in words of its own.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ringlet/base/result.h"

namespace ringlet {

/// What a host has in place of an option of the command, as `--up Z`.
struct HostWord {
  std::string_view option;      // "up"
  std::string_view name;        // "up"
  std::string_view assignment;  // "up=\"{}\"", with a value in place of {}
  std::string_view value = {};  // only with this one; empty: with any, and with none
};

/// The sentence in these words. What stands beside an option for scene files, as in `up = "Z" of [groom]
/// (--up Z)`, goes with it. Options that have no word stay, as those of other programs do.
std::string inHostWords(std::string_view sentence, std::span<const HostWord> words);

/// The sentence in the words of scene files, for whoever reads those.
std::string inSceneWords(std::string_view sentence);
inline Error inSceneWords(const Error& error) { return {inSceneWords(error.message), error.fault}; }

}  // namespace ringlet
