// Implements groom/turned_strands.h: pairs of strands as a graph, joined like a spanning tree (Kruskal 1956)
// in sets that know of each member whether it runs as the set's first does.
#include "ringlet/groom/turned_strands.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "ringlet/base/assert.h"
#include "ringlet/base/nearest_points.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/root_surface.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastJoined = 8;  // strands
constexpr double kMostJoined = 0.8;      // share of strands in one set, which then know better than a head
constexpr double kMostOtherwise = 0.1;   // of them that a head may tell otherwise, for it to be believed
constexpr double kFlatter = 0.5;         // a plane's rms over a head's: roots are on the plane

struct StrandPair {
  double share = 0;  // of how far ends are apart in the nearer way, over the other: the less, the clearer
  std::uint32_t a = 0, b = 0;
  bool isOpposite = false;
};

// Sets of strands, each with its way relative to the set's first.
class WaySets {
 public:
  explicit WaySets(std::size_t count) : parent_(count), isOpposite_(count, false) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  struct Way {
    std::uint32_t set = 0;
    bool isOpposite = false;
  };
  // Halves the way to the set's first, for those that ask later.
  Way find(std::uint32_t strand) {
    bool isOpposite = false;
    while (parent_[strand] != strand) {
      const std::uint32_t above = parent_[strand];
      if (parent_[above] != above) {
        isOpposite_[strand] = isOpposite_[strand] != isOpposite_[above];
        parent_[strand] = parent_[above];
      }
      isOpposite = isOpposite != isOpposite_[strand];
      strand = parent_[strand];
    }
    return {strand, isOpposite};
  }

  void join(const StrandPair& pair) {
    const Way a = find(pair.a), b = find(pair.b);
    if (a.set == b.set) return;
    parent_[b.set] = a.set;
    isOpposite_[b.set] = (a.isOpposite != b.isOpposite) != pair.isOpposite;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<bool> isOpposite_;  // to the parent
};

// Ends of the strands that tell: 2 k is strand k's first, 2 k + 1 its last.
std::vector<StrandPair> tellingPairs(std::span<const Vec3d> ends) {
  const NearestPoints tree(ends);
  std::vector<NearestPoints::Near> found;
  std::vector<StrandPair> pairs;
  const auto apart = [&](std::size_t one, std::size_t other) { return length(ends[one] - ends[other]); };
  for (std::size_t end = 0; end < ends.size(); ++end) {
    tree.find(ends[end], kEndsAround + 2, found);
    for (const NearestPoints::Near& near : found) {
      const std::uint32_t a = static_cast<std::uint32_t>(end / 2), b = near.point / 2;
      if (a == b) continue;
      const double same = apart(2 * a, 2 * b) + apart(2 * a + 1, 2 * b + 1),
                   opposite = apart(2 * a, 2 * b + 1) + apart(2 * a + 1, 2 * b);
      const double share = std::min(same, opposite) / std::max(same, opposite);
      if (share < kTellingPair) pairs.push_back({share, a, b, opposite < same});
    }
  }
  std::ranges::stable_sort(pairs, {}, &StrandPair::share);
  return pairs;
}

// What strands beside each other say.
struct Neighbours {
  std::vector<bool> isTurned{};  // of those that tell
  double joined = 0;             // share of these in the largest set
};

Neighbours askNeighbours(std::span<const Vec3d> ends) {
  const std::size_t count = ends.size() / 2;
  WaySets sets(count);
  for (const StrandPair& pair : tellingPairs(ends)) sets.join(pair);
  std::vector<std::size_t> all(count, 0), opposite(count, 0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const WaySets::Way way = sets.find(k);
    ++all[way.set];
    if (way.isOpposite) ++opposite[way.set];
  }
  Neighbours told;
  for (std::uint32_t k = 0; k < count; ++k) {
    const WaySets::Way way = sets.find(k);
    const std::size_t others = all[way.set] - opposite[way.set];
    const bool isFewer = way.isOpposite == (opposite[way.set] < others);
    const double fewer = static_cast<double>(std::min(opposite[way.set], others));
    told.isTurned.push_back(all[way.set] >= kLeastJoined && isFewer &&
                            fewer <= kMostTurned * static_cast<double>(all[way.set]));
  }
  if (count > 0)
    told.joined = static_cast<double>(*std::ranges::max_element(all)) / static_cast<double>(count);
  return told;
}

// Whether the head's word holds against that of the neighbours.
bool isBelieved(const Ball& head, const std::vector<bool>& byHead, const Neighbours& told,
                std::span<const Vec3d> firsts) {
  const auto plane = surfaceThroughMost(firsts, true);
  if (plane && plane->rms < kFlatter * head.rms) return false;
  std::size_t otherwise = 0;
  for (std::size_t k = 0; k < byHead.size(); ++k) otherwise += byHead[k] != told.isTurned[k] ? 1 : 0;
  const std::size_t fewer = std::min(otherwise, byHead.size() - otherwise);
  return told.joined < kMostJoined ||
         static_cast<double>(fewer) <= kMostOtherwise * static_cast<double>(byHead.size());
}

}  // namespace

std::vector<bool> turnedStrands(const Groom& groom, const std::vector<bool>& isLeftOut) {
  RINGLET_ASSERT(isLeftOut.size() == groom.strandCount(), "a word for every strand");
  Groom telling;
  telling.metresPerUnit = groom.metresPerUnit;
  std::vector<Vec3d> ends, firsts;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (isLeftOut[s]) continue;
    telling.addStrand(groom.strand(s));
    firsts.emplace_back(groom.strand(s).front());
    ends.push_back(firsts.back());
    ends.emplace_back(groom.strand(s).back());
  }
  std::vector<bool> isTurned(groom.strandCount(), false);
  if (firsts.empty()) return isTurned;
  const Neighbours told = askNeighbours(ends);
  const RootEnds found = findRootEnds(telling);
  const bool isByHead = found.head && isBelieved(*found.head, found.isReversed, told, firsts);
  std::size_t k = 0;
  for (std::size_t s = 0; s < isTurned.size(); ++s) {
    if (isLeftOut[s]) continue;
    isTurned[s] = isByHead ? found.isReversed[k] : told.isTurned[k];
    ++k;
  }
  return isTurned;
}

}  // namespace ringlet
