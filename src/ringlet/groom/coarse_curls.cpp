// Implements groom/coarse_curls.h.
#include "ringlet/groom/coarse_curls.h"

#include <cmath>
#include <vector>

#include "ringlet/base/median.h"
#include "ringlet/groom/curl_shape.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastOfZigzag = 8;  // particles

bool isZigzag(std::span<const Vec3d> strand) {
  if (strand.size() < kLeastOfZigzag) return false;
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < strand.size(); ++i) {
    const Vec3d before = strand[i] - strand[i - 1], after = strand[i + 1] - strand[i];
    bends.push_back(std::atan2(length(cross(before, after)), dot(before, after)));
  }
  return medianOf(std::move(bends)) > kZigzagBend;
}

}  // namespace

bool isCoarseCurl(std::span<const Vec3d> strand) {
  const CurlShape shape = measureCurl(strand);
  if (!(shape.turns > 0)) return isZigzag(strand);
  std::vector<double> arcs(strand.size() - 1);
  measureArcs(strand, arcs);
  double along = 0;
  for (const double arc : arcs) along += arc;
  return shape.turnLength * static_cast<double>(arcs.size()) < kLeastPerTurn * along;
}

}  // namespace ringlet
