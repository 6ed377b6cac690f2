// A file's ending, whatever its case.
#pragma once

#include <cctype>
#include <filesystem>
#include <string>

namespace ringlet {

/// With its dot, in small letters: ".obj" of "Head.OBJ"; "" of none.
inline std::string endingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace ringlet
