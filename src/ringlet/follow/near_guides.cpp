// Implements follow/near_guides.h.
#include "ringlet/follow/near_guides.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ringlet {

NearGuides::NearGuides(std::span<const GuideRest> guides) : order_(guides.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t g) { return guides[g].root.y; });
  for (const std::uint32_t g : order_) roots_.push_back(guides[g].root);
}

// Looked through to both sides of the place's height, until what is left is further off along that axis.
std::vector<NearGuides::Near> NearGuides::at(Vec3d place, std::size_t count) const {
  std::vector<Near> found;
  const auto look = [&](std::size_t k) {
    if (found.size() == count && std::abs(roots_[k].y - place.y) > found.back().distance) return false;
    const Near near{length(roots_[k] - place), order_[k]};
    const auto isBefore = [](const Near& a, const Near& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.guide < b.guide;
    };
    found.insert(std::ranges::upper_bound(found, near, isBefore), near);
    if (found.size() > count) found.pop_back();
    return true;
  };
  const auto middle = std::ranges::lower_bound(roots_, place.y, {}, &Vec3d::y) - roots_.begin();
  for (auto k = static_cast<std::size_t>(middle); k-- > 0 && look(k);) continue;
  for (auto k = static_cast<std::size_t>(middle); k < roots_.size() && look(k); ++k) continue;
  return found;
}

std::array<NearGuides::Share, 3> NearGuides::sharesAt(Vec3d place) const {
  const std::vector<Near> near = at(place, 4);
  std::array<Share, 3> shares{};
  // Of fewer than four guides none is ever left.
  const double beyond = near.size() == 4 ? near[3].distance : INFINITY;
  double sum = 0;
  for (std::size_t k = 0; k < std::min<std::size_t>(near.size(), 3); ++k) {
    const double distance = std::max(near[k].distance, 1e-9);
    const double root = std::isinf(beyond) ? 1 / distance : std::max(0.0, 1 / distance - 1 / beyond);
    shares[k] = {near[k].guide, root * root};
    sum += root * root;
  }
  if (!(sum > 0)) shares[0].share = sum = 1;  // four at one distance
  for (Share& each : shares) each.share /= sum;
  return shares;
}

}  // namespace ringlet
