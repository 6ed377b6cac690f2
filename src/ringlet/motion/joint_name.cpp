// Implements motion/joint_name.h.
#include "ringlet/motion/joint_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "ringlet/base/nearest_name.h"

namespace ringlet {
namespace {

constexpr std::size_t kNamesShown = 12;  // in a message

std::string lower(std::string_view text) {
  std::string result;
  for (char c : text) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

std::optional<std::size_t> findJoint(const std::vector<std::string>& names, std::string_view wanted) {
  if (wanted.empty()) return std::nullopt;
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (names[j] == wanted) return j;
  }
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::string own = lower(names[j]), other = lower(wanted);
    if (own == other || own.ends_with(":" + other)) return j;
  }
  return std::nullopt;
}

Error noSuchJoint(const std::string& file, std::string_view what, std::string_view wanted,
                  const std::vector<std::string>& names) {
  std::vector<std::string> named;
  for (const std::string& name : names) {
    if (!name.empty()) named.push_back(name);
  }
  if (named.empty()) return Error{fmt::format("{} has no {} {}; none has a name", file, what, wanted)};
  std::string shown;
  for (std::size_t k = 0; k < std::min(named.size(), kNamesShown); ++k)
    shown += fmt::format("{}{}", k > 0 ? ", " : "", named[k]);
  if (named.size() > kNamesShown) shown += fmt::format(" and {} more", named.size() - kNamesShown);
  const std::size_t near = nearestName(wanted, named);
  const std::string meant = near < named.size() ? fmt::format("did you mean {}? ", named[near]) : "";
  return Error{fmt::format("{} has no {} {}; {}it has {}", file, what, wanted, meant, shown)};
}

}  // namespace ringlet
