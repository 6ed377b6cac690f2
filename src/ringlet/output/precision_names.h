// A cache's precision, as the user writes it.
#pragma once

#include <string>
#include <vector>

#include "ringlet/output/cache_format.h"

namespace ringlet {

inline std::vector<std::string> precisionNames() { return {"float32", "16bit"}; }
inline CachePrecision precisionByName(const std::string& name) {
  return name == "16bit" ? CachePrecision::bits16 : CachePrecision::float32;
}
inline std::string nameOf(CachePrecision precision) {
  return precision == CachePrecision::bits16 ? "16bit" : "float32";
}

}  // namespace ringlet
