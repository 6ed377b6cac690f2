// Implements groom/mend_groom.h.
#include "ringlet/groom/mend_groom.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "ringlet/groom/stray_points.h"

namespace ringlet {
namespace {

// Each particle away from the one kept before it; the tip stays, in place of one too near to it.
std::vector<Vec3f> withoutRepeats(std::span<const Vec3f> strand) {
  const double nothing = noEdgeLength(strand);
  std::vector<Vec3f> kept{strand.front()};
  for (const Vec3f p : strand.subspan(1)) {
    if (length(Vec3d(p) - Vec3d(kept.back())) > nothing) kept.push_back(p);
  }
  if (kept.size() > 1) kept.back() = strand.back();
  return kept;
}

std::vector<Vec3f> resampled(std::span<const Vec3f> strand, std::size_t count) {
  std::vector<double> at{0};
  for (std::size_t i = 1; i < strand.size(); ++i)
    at.push_back(at.back() + length(Vec3d(strand[i]) - Vec3d(strand[i - 1])));
  std::vector<Vec3f> particles{strand.front()};
  std::size_t edge = 0;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double s = at.back() * static_cast<double>(k) / static_cast<double>(count - 1);
    while (edge + 2 < strand.size() && at[edge + 1] < s) ++edge;
    const double share = (s - at[edge]) / (at[edge + 1] - at[edge]);
    particles.push_back(Vec3f(Vec3d(strand[edge]) * (1 - share) + Vec3d(strand[edge + 1]) * share));
  }
  particles.push_back(strand.back());
  return particles;
}

// One pass over all strands. What it takes out may make others strays, repeats or duplicates: says whether it
// took out anything.
bool mendOnce(MendedGroom& mended) {
  const Groom groom = std::move(mended.groom);
  mended.groom = {};
  mended.groom.metresPerUnit = groom.metresPerUnit;
  const std::vector<bool> isDuplicate = duplicatesIn(groom);
  const std::vector<bool> isStray = strayPoints(groom);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (isDuplicate[s]) {
      ++mended.duplicateCount;
      continue;
    }
    std::vector<Vec3f> strand;
    for (std::uint32_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
      if (!isStray[i]) strand.push_back(groom.points[i]);
    }
    mended.strayCount += groom.strand(s).size() - strand.size();
    const std::vector<Vec3f> kept = strand.empty() ? std::vector<Vec3f>{} : withoutRepeats(strand);
    if (kept.size() < 2) {
      ++mended.pointStrandCount;
      continue;
    }
    mended.repeatedCount += strand.size() - kept.size();
    mended.groom.addStrand(kept);
  }
  return mended.groom.points.size() != groom.points.size();
}

}  // namespace

double noEdgeLength(std::span<const Vec3f> strand) {
  return kNoEdgeShare * static_cast<double>(strand.size()) * upperEdge(strand);
}

std::vector<bool> duplicatesIn(const Groom& groom) {
  const auto compare = [&](std::size_t a, std::size_t b) {
    const auto one = groom.strand(a), other = groom.strand(b);
    if (one.size() != other.size()) return one.size() < other.size() ? -1 : 1;
    return std::memcmp(one.data(), other.data(), one.size_bytes());
  };
  std::vector<std::size_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const int sign = compare(a, b);
    return sign != 0 ? sign < 0 : a < b;
  });
  std::vector<bool> isDuplicate(order.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) isDuplicate[order[i]] = compare(order[i - 1], order[i]) == 0;
  return isDuplicate;
}

MendedGroom mendGroom(const Groom& groom, std::size_t particleCount) {
  MendedGroom mended;
  mended.groom = groom;
  while (mendOnce(mended)) {
  }
  if (particleCount < 2) return mended;
  const Groom whole = std::move(mended.groom);
  mended.groom = {};
  mended.groom.metresPerUnit = groom.metresPerUnit;
  for (std::size_t s = 0; s < whole.strandCount(); ++s)
    mended.groom.addStrand(resampled(whole.strand(s), particleCount));
  return mended;
}

}  // namespace ringlet
