// Implements rest/strand_order.h.
#include "ringlet/rest/strand_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace ringlet {
namespace {

// Cells of the Hilbert curve along an axis, 2^16: far finer than strands are apart; three numbers fit into 64
// bits.
constexpr int kCurveBits = 16;

/// Place along the Hilbert curve of a cell: Skilling, "Programming the Hilbert curve", AIP Conference
/// Proceedings 707, 2004.
std::uint64_t placeOnCurve(std::array<std::uint32_t, 3> x) {
  // Undo the turns of the cubes within cubes, from the largest.
  for (std::uint32_t q = 1u << (kCurveBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& axis : x) {
      if (axis & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t exchanged = (x[0] ^ axis) & below;
        x[0] ^= exchanged;
        axis ^= exchanged;
      }
    }
  }
  // Gray code.
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flips = 0;
  for (std::uint32_t q = 1u << (kCurveBits - 1); q > 1; q >>= 1) {
    if (x[2] & q) flips ^= q - 1;
  }
  for (std::uint32_t& axis : x) axis ^= flips;
  // Interleave.
  std::uint64_t place = 0;
  for (int bit = kCurveBits - 1; bit >= 0; --bit) {
    for (std::uint32_t axis : x) place = place << 1 | (axis >> bit & 1);
  }
  return place;
}

Vec3d meanOf(std::span<const Vec3f> points) {
  Vec3d sum;
  for (Vec3f p : points) sum += static_cast<Vec3d>(p);
  return sum / std::max(1.0, static_cast<double>(points.size()));
}

std::vector<std::uint64_t> placesOnCurve(const Groom& groom) {
  std::vector<Vec3d> means;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) means.push_back(meanOf(groom.strand(s)));
  Vec3d low = means.empty() ? Vec3d{} : means[0], high = low;
  for (Vec3d m : means) {
    low = {std::min(low.x, m.x), std::min(low.y, m.y), std::min(low.z, m.z)};
    high = {std::max(high.x, m.x), std::max(high.y, m.y), std::max(high.z, m.z)};
  }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double most = (1 << kCurveBits) - 1;
  const auto cell = [&](double above) {
    const double share = above / extent;  // points that are not finite are refused later: any cell will do
    return share >= 0 && share <= 1 ? static_cast<std::uint32_t>(most * share) : 0u;
  };
  std::vector<std::uint64_t> places;
  for (Vec3d m : means)
    places.push_back(placeOnCurve({cell(m.x - low.x), cell(m.y - low.y), cell(m.z - low.z)}));
  return places;
}

// Strands in memory as a row of places, and what their overlaps cost there.
class Row {
 public:
  Row(std::size_t strandCount, std::span<const StrandOverlap> overlaps)
      : places_(strandCount),
        strands_(strandCount),
        firstNeighbour_(strandCount + 1),
        neighbours_(2 * overlaps.size()) {
    std::iota(places_.begin(), places_.end(), 0u);
    std::iota(strands_.begin(), strands_.end(), 0u);
    for (const StrandOverlap& o : overlaps) ++firstNeighbour_[o.a + 1], ++firstNeighbour_[o.b + 1];
    std::partial_sum(firstNeighbour_.begin(), firstNeighbour_.end(), firstNeighbour_.begin());
    std::vector<std::uint32_t> next(firstNeighbour_.begin(), firstNeighbour_.end() - 1);
    for (const StrandOverlap& o : overlaps) neighbours_[next[o.a]++] = o.b, neighbours_[next[o.b]++] = o.a;
  }

  std::span<const std::uint32_t> neighbours(std::uint32_t strand) const {
    return std::span(neighbours_)
        .subspan(firstNeighbour_[strand], firstNeighbour_[strand + 1] - firstNeighbour_[strand]);
  }
  std::uint32_t placeOf(std::uint32_t strand) const { return places_[strand]; }
  std::uint32_t strandAt(std::uint32_t place) const { return strands_[place]; }

  // What the strand's overlaps would gain at another place; that with `other`, with which it changes places,
  // none.
  std::int64_t gain(std::uint32_t strand, std::uint32_t place, std::uint32_t other) const {
    std::int64_t sum = 0;
    for (std::uint32_t n : neighbours(strand)) {
      if (n != other) sum += distance(placeOf(n), placeOf(strand)) - distance(placeOf(n), place);
    }
    return sum;
  }
  void swap(std::uint32_t a, std::uint32_t b) {
    std::swap(places_[a], places_[b]);
    strands_[places_[a]] = a;
    strands_[places_[b]] = b;
  }
  const std::vector<std::uint32_t>& strands() const { return strands_; }

 private:
  static std::int64_t distance(std::uint32_t a, std::uint32_t b) {
    return std::abs(static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b));
  }

  std::vector<std::uint32_t> places_, strands_;  // of each strand; at each place
  std::vector<std::uint32_t> firstNeighbour_, neighbours_;
};

// Where the strand's overlaps are shortest: the median of its neighbours' places.
std::uint32_t bestPlace(const Row& row, std::uint32_t strand, std::vector<std::uint32_t>& scratch) {
  scratch.clear();
  for (std::uint32_t n : row.neighbours(strand)) scratch.push_back(row.placeOf(n));
  if (scratch.empty()) return row.placeOf(strand);
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return *middle;
}

// Places from and to which strands of one particle count lie, whichever changed theirs.
std::pair<std::int64_t, std::int64_t> placesOfLength(const RestState& rest, std::uint32_t particleCount) {
  const auto range =
      std::ranges::equal_range(rest.strands, particleCount, {}, &layout::StrandRest::particleCount);
  return {range.begin() - rest.strands.begin(), range.end() - rest.strands.begin()};
}

}  // namespace

std::vector<std::uint32_t> orderAlongCurve(const Groom& groom) {
  const std::vector<std::uint64_t> places = placesOnCurve(groom);
  std::vector<std::uint32_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t sizeA = groom.strand(a).size(), sizeB = groom.strand(b).size();
    return sizeA != sizeB ? sizeA < sizeB : places[a] < places[b];
  });
  return order;
}

std::vector<std::uint32_t> improveOrder(const RestState& rest, std::span<const StrandOverlap> overlaps,
                                        int passes) {
  const auto strandCount = static_cast<std::uint32_t>(rest.strands.size());
  Row row(strandCount, overlaps);
  std::int64_t total = 0;
  for (const StrandOverlap& o : overlaps) total += o.b - o.a;
  std::vector<std::uint32_t> scratch;
  for (int pass = 0; pass < passes; ++pass) {
    std::int64_t gained = 0;
    for (std::uint32_t strand = 0; strand < strandCount; ++strand) {
      const auto [begin, end] = placesOfLength(rest, rest.strands[strand].particleCount);
      const std::int64_t best = std::clamp<std::int64_t>(bestPlace(row, strand, scratch), begin, end - 1);
      for (std::int64_t place : {best, best - 1, best + 1, best - 2, best + 2}) {
        if (place < begin || place >= end || place == row.placeOf(strand)) continue;
        const std::uint32_t other = row.strandAt(static_cast<std::uint32_t>(place));
        const std::int64_t gain =
            row.gain(strand, row.placeOf(other), other) + row.gain(other, row.placeOf(strand), strand);
        if (gain <= 0) continue;
        row.swap(strand, other);
        gained += gain;
        break;
      }
    }
    total -= gained;
    if (gained * 1000 < total) break;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t strand : row.strands()) order.push_back(rest.strandInGroom[strand]);
  return order;
}

}  // namespace ringlet
