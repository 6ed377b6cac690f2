// Implements motion/name_below.h.
#include "ringlet/motion/name_below.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>

#include "ringlet/base/is_below.h"

namespace ringlet {
namespace {

// "http:", "file:", "C:"
bool hasScheme(std::string_view name) {
  const std::size_t colon = name.find_first_of(":/");
  return colon != std::string_view::npos && name[colon] == ':' && colon > 0 &&
         std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::ranges::all_of(name.substr(0, colon), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
         });
}

}  // namespace

std::string whyNotBelow(const std::string& name, const std::filesystem::path& folder, const char* format) {
  if (name.empty()) return "has no name";
  if (name.find('\0') != name.npos) return "holds a NUL";
  if (name.find('\\') != name.npos) return fmt::format("has a backslash, where {} has /", format);
  if (hasScheme(name)) return "is an address, and only files are read";
  if (std::filesystem::path(name).is_absolute()) return "is absolute";
  const std::filesystem::path plain = std::filesystem::path(name).lexically_normal();
  if (*plain.begin() == "..") return fmt::format("leads out of the folder of the {} file", format);
  std::error_code code;
  // Where the folder is not there, neither is the file: its reader says so.
  if (!std::filesystem::exists(folder.empty() ? "." : folder, code)) return "";
  if (isBelow(folder / name, folder)) return "";
  return fmt::format("leads out of the folder of the {} file by a symbolic link", format);
}

}  // namespace ringlet
