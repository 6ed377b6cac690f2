// Implements groom/thrown_points.h.
#include "ringlet/groom/thrown_points.h"

#include <cstdint>
#include <span>

#include "ringlet/base/assert.h"
#include "ringlet/groom/stray_points.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastParticles = 5;  // of fewer edges a median says little

double apart(Vec3f a, Vec3f b) { return length(Vec3d(b) - Vec3d(a)); }

bool isThrown(std::span<const Vec3f> strand, std::size_t i, double median) {
  const std::size_t last = strand.size() - 1;
  if (i == 0 || i == last) {
    const std::size_t next = i == 0 ? 1 : last - 1, after = i == 0 ? 2 : last - 2;
    return apart(strand[i], strand[next]) > kThrownEnd * median &&
           apart(strand[next], strand[after]) < kThrownGap * median;
  }
  return apart(strand[i - 1], strand[i]) > kThrownEdge * median &&
         apart(strand[i], strand[i + 1]) > kThrownEdge * median &&
         apart(strand[i - 1], strand[i + 1]) < kThrownGap * median;
}

}  // namespace

std::vector<bool> thrownPoints(const Groom& groom) {
  const std::vector<bool> isStray = strayPoints(groom);
  std::vector<bool> isOne(groom.points.size(), false);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::span<const Vec3f> strand = groom.strand(s);
    const double median = medianEdge(strand);
    if (strand.size() < kLeastParticles || !(median > 0)) continue;
    // No two beside each other: the one between a thrown particle and the rest is in its place.
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const std::size_t particle = groom.firstPoint[s] + i;
      isOne[particle] = !isStray[particle] && !(i > 0 && isOne[particle - 1]) && isThrown(strand, i, median);
    }
  }
  return isOne;
}

Groom withoutPoints(const Groom& groom, const std::vector<bool>& which) {
  RINGLET_ASSERT(which.size() == groom.points.size(), "a word for every particle");
  Groom left;
  left.metresPerUnit = groom.metresPerUnit;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
      if (!which[i]) left.points.push_back(groom.points[i]);
    }
    left.firstPoint.push_back(static_cast<std::uint32_t>(left.points.size()));
  }
  return left;
}

}  // namespace ringlet
