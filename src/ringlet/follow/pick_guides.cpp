// Implements follow/pick_guides.h.
#include "ringlet/follow/pick_guides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "ringlet/base/in_parallel.h"

namespace ringlet {
namespace {

constexpr int kRounds = 8;
constexpr std::size_t kPickPart = 256;  // strands that a thread takes at once

// At a share of the way along a strand.
Vec3d coreAt(const RestShape& strand, double share) {
  const double arc = share * strand.arcs.back();
  const auto after = std::ranges::upper_bound(strand.arcs, arc);
  const std::size_t k = std::min<std::size_t>(after - strand.arcs.begin(), strand.arcs.size() - 1) - 1;
  const double edge = strand.arcs[k + 1] - strand.arcs[k];  // 0 where points at the tip are in one place
  const double between = edge > 0 ? std::min((arc - strand.arcs[k]) / edge, 1.0) : 0;
  return strand.core[k] + (strand.core[k + 1] - strand.core[k]) * between;
}

double curlSize(const RestShape& strand) {
  double squares = 0;
  for (const Vec3d& curl : strand.curl) squares += dot(curl, curl);
  return std::sqrt(squares / static_cast<double>(strand.curl.size()));
}

// The guide that each strand is most like, and how far from it.
struct Following {
  std::vector<std::uint32_t> guide;  // number among the guides
  std::vector<double> apart;         // [m^2]

  double sum() const { return std::accumulate(apart.begin(), apart.end(), 0.0); }
};

Following followingOf(const StrandTraits& strands, std::span<const std::uint32_t> guides) {
  Following following{std::vector<std::uint32_t>(strands.count()), std::vector<double>(strands.count())};
  eachInParallel(coreCount(), strands.count(), kPickPart, [&](std::size_t s) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t g = 0; g < guides.size(); ++g) {
      const double apart = strands.apart(s, guides[g]);
      if (apart >= least) continue;
      least = apart;
      following.guide[s] = g;
    }
    following.apart[s] = least;
  });
  return following;
}

std::vector<std::uint32_t> allOf(const StrandTraits& strands) {
  std::vector<std::uint32_t> all(strands.count());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::vector<std::uint32_t> mostUnlike(const StrandTraits& strands, std::size_t count) {
  std::vector<double> apart(strands.count(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> picked{strands.middleOf(allOf(strands))};
  while (picked.size() < count) {
    eachInParallel(coreCount(), strands.count(), kPickPart,
                   [&](std::size_t s) { apart[s] = std::min(apart[s], strands.apart(s, picked.back())); });
    for (const std::uint32_t each : picked) apart[each] = -1;
    picked.push_back(static_cast<std::uint32_t>(std::ranges::max_element(apart) - apart.begin()));
  }
  return picked;
}

}  // namespace

StrandTraits::StrandTraits(std::span<const RestShape> strands) {
  all_.reserve(strands.size() * kSize);
  for (const RestShape& strand : strands) {
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const Vec3d p = coreAt(strand, static_cast<double>(k) / (kPlaces - 1));
      for (const double x : {p.x, p.y, p.z}) all_.push_back(static_cast<float>(x));
    }
    all_.push_back(static_cast<float>(curlSize(strand) * std::sqrt(double(kPlaces))));
  }
}

double StrandTraits::apart(std::span<const float> a, std::span<const float> b) {
  float sum = 0;
  for (std::size_t k = 0; k < kSize; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return static_cast<double>(sum) / kPlaces;
}

std::vector<std::uint32_t> StrandTraits::nearest(std::size_t strand, std::span<const std::uint32_t> among,
                                                 std::size_t most) const {
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t k = 0; k < among.size(); ++k) all.emplace_back(apart(strand, among[k]), k);
  const std::size_t count = std::min(most, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
  std::vector<std::uint32_t> found;
  for (std::size_t k = 0; k < count; ++k) found.push_back(all[k].second);
  return found;
}

std::uint32_t StrandTraits::middleOf(std::span<const std::uint32_t> members) const {
  std::vector<double> sums(kSize);
  for (const std::uint32_t s : members)
    for (std::size_t k = 0; k < kSize; ++k) sums[k] += static_cast<double>(of(s)[k]);
  std::vector<float> mean;
  for (const double sum : sums) mean.push_back(static_cast<float>(sum / static_cast<double>(members.size())));
  return *std::ranges::min_element(members, {}, [&](std::uint32_t s) { return apart(of(s), mean); });
}

std::vector<std::uint32_t> pickGuides(const StrandTraits& strands, std::size_t count) {
  if (count >= strands.count()) return allOf(strands);
  std::vector<std::uint32_t> guides = mostUnlike(strands, count);
  Following following = followingOf(strands, guides);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::vector<std::uint32_t>> members(count);
    for (std::uint32_t s = 0; s < strands.count(); ++s) members[following.guide[s]].push_back(s);
    std::vector<std::uint32_t> middles;
    for (std::size_t g = 0; g < count; ++g)
      middles.push_back(members[g].empty() ? guides[g] : strands.middleOf(members[g]));
    Following next = followingOf(strands, middles);
    if (!(next.sum() < following.sum())) break;
    guides = std::move(middles);
    following = std::move(next);
  }
  std::ranges::sort(guides);
  return guides;
}

}  // namespace ringlet
