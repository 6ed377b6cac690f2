// The names of all hair styles, for tests that loop over them.
#pragma once

#include <string>
#include <vector>

#include "ringlet/groom/hair_styles.h"

namespace ringlet::test {

inline std::vector<std::string> styleNames() {
  std::vector<std::string> names;
  const std::string list = std::string(kHairStyles) + ", ";
  for (std::size_t begin = 0, end; (end = list.find(", ", begin)) != std::string::npos; begin = end + 2)
    names.push_back(list.substr(begin, end - begin));
  return names;
}

}  // namespace ringlet::test
