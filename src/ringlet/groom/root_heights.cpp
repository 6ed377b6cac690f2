// Implements groom/root_heights.h.
#include "ringlet/groom/root_heights.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ringlet/base/assert.h"
#include "ringlet/base/mean.h"
#include "ringlet/base/median.h"
#include "ringlet/base/nearest_points.h"
#include "ringlet/groom/root_surface.h"
#include "ringlet/groom/strand_length.h"

namespace ringlet {
namespace {

constexpr std::size_t kLeastOfScalp = 20;  // roots

class RootsOff {
 public:
  RootsOff(const Groom& groom, const std::vector<bool>& isLeftOut, const ScalpSurface* scalp)
      : groom_(groom), scalp_(scalp) {
    for (std::size_t s = 0; s < groom.strandCount(); ++s) {
      if (isLeftOut[s]) continue;
      strands_.push_back(s);
      roots_.emplace_back(groom.strand(s).front());
    }
  }

  RootHeights find() {
    RootHeights heights;
    heights.above.assign(groom_.strandCount(), 0);
    heights.outward.assign(groom_.strandCount(), Vec3d{0, 1, 0});
    heights.isFloating.assign(groom_.strandCount(), false);
    heights.isSunk.assign(groom_.strandCount(), false);
    if (strands_.empty() || !(scalp_ ? measureFromScalp(heights) : measureFromRoots(heights))) return heights;
    heights.limit = limitOf(heights);
    for (const std::size_t s : strands_) {
      heights.isFloating[s] = heights.above[s] > heights.limit;
      heights.isSunk[s] = heights.above[s] < -heights.limit;
    }
    return heights;
  }

 private:
  bool measureFromScalp(RootHeights& heights) const {
    for (const std::size_t s : strands_) {
      const ScalpHeight found = scalp_->heightOf(Vec3d(groom_.strand(s).front()) * groom_.metresPerUnit);
      heights.above[s] = found.height / groom_.metresPerUnit;
      heights.outward[s] = found.outward;
    }
    return true;
  }

  bool measureFromRoots(RootHeights& heights) const {
    if (strands_.size() < kLeastOfScalp) return false;
    std::optional<RootSurface> surface = surfaceThroughMost(roots_);
    if (!surface) return false;
    double sum = 0;
    for (const std::size_t s : strands_) sum += surface->heightOf(meanOf(groom_.strand(s)));
    if (sum < 0) surface->side = -surface->side;
    std::vector<double> raw;
    for (const Vec3d& root : roots_) raw.push_back(surface->heightOf(root));
    const std::vector<std::size_t> telling = tellingRoots(raw);
    std::vector<Vec3d> places;
    for (const std::size_t k : telling) places.push_back(roots_[k]);
    const NearestPoints tree(places);
    std::vector<NearestPoints::Near> found;
    for (std::size_t k = 0; k < strands_.size(); ++k) {
      tree.find(roots_[k], kRootsAround + 1, found);
      std::vector<double> around;
      for (const NearestPoints::Near& near : found) {
        if (telling[near.point] != k) around.push_back(raw[telling[near.point]]);
      }
      heights.above[strands_[k]] = raw[k] - medianOf(std::move(around));
      heights.outward[strands_[k]] = surface->outwardAt(roots_[k]);
    }
    return true;
  }

  // Those that are not far off the surface itself: many roots off it beside each other say nothing of it.
  std::vector<std::size_t> tellingRoots(const std::vector<double>& raw) const {
    const double middle = medianOf(raw);
    const double most = std::max(kHeightSpreads * spreadAbout(middle, raw), leastLimit());
    std::vector<std::size_t> telling;
    for (std::size_t k = 0; k < raw.size(); ++k) {
      if (std::abs(raw[k] - middle) <= most) telling.push_back(k);
    }
    return telling;
  }

  double limitOf(const RootHeights& heights) const {
    // A mesh is where it is, however roots scatter.
    if (scalp_) return leastLimit();
    std::vector<double> above;
    for (const std::size_t s : strands_) above.push_back(heights.above[s]);
    const double middle = medianOf(above);
    return std::max(kHeightSpreads * spreadAbout(middle, std::move(above)), leastLimit());
  }

  // Below which nothing is off.
  double leastLimit() const {
    std::vector<double> lengths, spacings;
    const NearestPoints tree(roots_);
    std::vector<NearestPoints::Near> found;
    for (std::size_t k = 0; k < strands_.size(); ++k) {
      lengths.push_back(lengthAlong(groom_.strand(strands_[k])));
      tree.find(roots_[k], 2, found);
      spacings.push_back(found.back().distance);
    }
    return std::max(kHeightOfSpacing * medianOf(std::move(spacings)),
                    kHeightOfLength * medianOf(std::move(lengths)));
  }

  const Groom& groom_;
  const ScalpSurface* scalp_;
  std::vector<std::size_t> strands_;  // that are not left out
  std::vector<Vec3d> roots_;          // of these [unit]
};

}  // namespace

RootHeights rootHeights(const Groom& groom, const std::vector<bool>& isLeftOut, const ScalpSurface* scalp) {
  RINGLET_ASSERT(isLeftOut.size() == groom.strandCount(), "a word for every strand");
  return RootsOff(groom, isLeftOut, scalp).find();
}

}  // namespace ringlet
