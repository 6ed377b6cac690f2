// Implements solver/plan/subgroup_choice.h.
#include "ringlet/solver/plan/subgroup_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string>

namespace ringlet {

std::vector<std::uint32_t> subgroupSizes(const DeviceLimits& limits) {
  std::vector<std::uint32_t> widths{limits.subgroupSize};
  for (std::uint32_t width = std::bit_ceil(std::max(limits.minSubgroupSize, 1u));
       width <= limits.maxSubgroupSize; width *= 2) {
    if (width != limits.subgroupSize) widths.push_back(width);
  }
  return widths;
}

Result<DeviceLimits> withSubgroupSize(const DeviceLimits& limits, int width) {
  if (width == 0) return limits;
  std::vector<std::uint32_t> widths = subgroupSizes(limits);
  if (width > 0 && std::ranges::find(widths, static_cast<std::uint32_t>(width)) != widths.end()) {
    DeviceLimits chosen = limits;
    chosen.subgroupSize = static_cast<std::uint32_t>(width);
    return chosen;
  }
  std::ranges::sort(widths);
  std::string possible;
  for (const std::uint32_t one : widths)
    possible += fmt::format("{}{}", possible.empty() ? "" : one == widths.back() ? " or " : ", ", one);
  return Error{
      fmt::format("a subgroup of {} was asked for; this device can have {}, 0 chooses", width, possible)};
}

std::uint32_t fastestSubgroupSize(std::span<const WidthTime> times) {
  std::vector<std::uint32_t> widths;
  std::map<std::uint32_t, std::map<std::uint32_t, double>> best;  // by width and length
  for (const WidthTime& one : times) {
    auto& ofWidth = best[one.subgroupSize];
    if (ofWidth.empty()) widths.push_back(one.subgroupSize);
    const auto [place, isNew] = ofWidth.try_emplace(one.particleCount, one.nanoseconds);
    if (!isNew) place->second = std::min(place->second, one.nanoseconds);
  }
  std::uint32_t fastest = 0;
  std::size_t mostLengths = 0;
  double least = 0;
  for (const std::uint32_t width : widths) {
    double sum = 0;
    for (const auto& [length, nanoseconds] : best[width]) sum += nanoseconds;
    const std::size_t lengths = best[width].size();
    if (lengths > mostLengths || (lengths == mostLengths && sum < least))
      mostLengths = lengths, least = sum, fastest = width;
  }
  return fastest;
}

}  // namespace ringlet
