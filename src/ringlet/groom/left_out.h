// LeftOutStrands: strands of a file that cannot be read, beside others that can.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace ringlet {

struct LeftOutStrands {
  std::size_t count = 0;
  std::string first;  // where it is and what was found there: "line 3: found ...; expected ..."

  void add(const std::string& found) {
    if (count++ == 0) first = found;
  }
  /// "left out 1 of 60 strands; line 3: found ..."; `name` is the file's, and `all` how many it has.
  std::string warning(const std::string& name, std::size_t all) const {
    return fmt::format("{}: left out {} of {} strands; {}{}", name, count, all,
                       count > 1 ? "the first, at " : "", first);
  }
};

}  // namespace ringlet
