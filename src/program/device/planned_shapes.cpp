// Implements planned_shapes.h.
#include "program/device/planned_shapes.h"

#include <algorithm>

namespace ringlet::program {

std::vector<StrandShape> plannedShapes(const DeviceLimits& limits, StrandWork work,
                                       std::span<const std::uint32_t> lengths, bool alsoFew) {
  constexpr std::size_t kParticles = 1'500'000, kFewStrands = 100;  // a whole head of hair; a swatch
  std::vector<StrandShape> shapes;
  const auto add = [&](std::size_t strandCount, std::uint32_t length) {
    const auto ranges = planRanges(std::vector<std::uint32_t>(strandCount, length), limits, {}, work);
    if (!ranges) return;  // no shape can hold it
    for (const StrandRange& range : *ranges) {
      if (std::ranges::find(shapes, range.shape) == shapes.end()) shapes.push_back(range.shape);
    }
  };
  for (const std::uint32_t length : lengths) {
    add(kParticles / length, length);
    if (alsoFew) add(kFewStrands, length);
  }
  std::ranges::stable_sort(shapes, {}, &StrandShape::capacity);
  return shapes;
}

}  // namespace ringlet::program
