// Implements output/usd/usd_stage.h.
#include "ringlet/output/usd/usd_stage.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ringlet {
namespace {

// The names of types, of which several mean the same numbers.
constexpr std::pair<std::string_view, std::uint32_t> kTypeNames[] = {
    {"bool", 1},        {"int", 3},        {"int64", 5},     {"half", 7},        {"float", 8},
    {"double", 9},      {"string", 10},    {"token", 11},    {"matrix4d", 15},   {"double2", 19},
    {"float2", 20},     {"half2", 21},     {"double3", 23},  {"float3", 24},     {"half3", 25},
    {"double4", 27},    {"float4", 28},    {"half4", 29},    {"texCoord2d", 19}, {"texCoord2f", 20},
    {"texCoord2h", 21}, {"color3d", 23},   {"color3f", 24},  {"color3h", 25},    {"color4d", 27},
    {"color4f", 28},    {"color4h", 29},   {"normal3d", 23}, {"normal3f", 24},   {"normal3h", 25},
    {"point3d", 23},    {"point3f", 24},   {"point3h", 25},  {"vector3d", 23},   {"vector3f", 24},
    {"vector3h", 25},   {"texCoord3f", 24}};

}  // namespace

std::optional<UsdStageType> usdTypeOf(std::string_view name) {
  const bool isArray = name.ends_with("[]");
  if (isArray) name.remove_suffix(2);
  const auto* known = std::ranges::find(kTypeNames, name, &std::pair<std::string_view, std::uint32_t>::first);
  if (known == std::end(kTypeNames)) return std::nullopt;
  return UsdStageType{known->second, isArray};
}

}  // namespace ringlet
