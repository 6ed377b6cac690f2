// Implements rest/strand_overlaps.h: a sweep over cells finds overlapping spheres (rest/sphere_cells.h), each
// thread counts what it finds, and the counts are added strand by strand. They are integers, so the result
// does not depend on which thread finds what, or when.
#include "ringlet/rest/strand_overlaps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numeric>
#include <span>
#include <utility>

#include "ringlet/base/bounds.h"
#include "ringlet/rest/sphere_cells.h"
#include "ringlet/rest/strands_per_part.h"

namespace ringlet {
namespace {

constexpr std::size_t kCellsPerPart = 4096;

// Cells are larger than the largest sphere in them by this factor: more than rounding moves a centre.
constexpr double kCellMargin = 1 + 1e-6;

// Most cells along an axis: their indices fit into 32 bits, and rounding stays below the margin.
constexpr double kMostCells = 0x1p30;

using Lists = std::vector<std::vector<StrandOverlap>>;

// Counts of pairs as they are found. Most of a pair's overlaps come one after another; when another pair
// takes its slot, the count so far is noted, and counting may start again later.
class PairCounts {
 public:
  void add(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    StrandOverlap& slot = slots_[(a * 73856093u ^ b * 19349663u) >> 16 & (kSlots - 1)];
    if (slot.a != a || slot.b != b) {
      note(slot);
      slot = {a, b, 0};
    }
    ++slot.count;
  }
  void moveTo(Lists& lists) {
    for (StrandOverlap& slot : slots_) note(std::exchange(slot, {}));
    std::ranges::move(noted_, std::back_inserter(lists));
  }

 private:
  static constexpr std::size_t kSlots = 1 << 15;       // 384 KB: stays in a core's own cache
  static constexpr std::size_t kListLength = 1 << 16;  // lists of a fixed length are never copied

  void note(const StrandOverlap& slot) {
    if (slot.count == 0) return;
    if (noted_.empty() || noted_.back().size() == kListLength) noted_.emplace_back().reserve(kListLength);
    noted_.back().push_back(slot);
  }

  std::vector<StrandOverlap> slots_{kSlots};
  Lists noted_;
};

// Spheres of one cell size, each size half the one before, so that a few large spheres do not make all cells
// large; and all smaller spheres in cells of the same size, which are paired with them.
struct SizeOfCells {
  SphereCells own, smaller;
};

std::vector<SizeOfCells> sortBySize(std::vector<Sphere> spheres, double enlargement) {
  Bounds box = Bounds::none();
  float largest = 0;
  for (const Sphere& sphere : spheres) {
    box.add(static_cast<Vec3d>(sphere.centre));
    largest = std::max(largest, sphere.radius);
  }
  const Vec3d extent = box.high - box.low;
  const double smallestCell = std::max({extent.x, extent.y, extent.z}) / kMostCells;
  const auto cellFor = [&](float radius) {
    return std::max(2 * enlargement * radius * kCellMargin, smallestCell);
  };
  std::vector<SizeOfCells> sizes;
  for (double cell = cellFor(largest); !spheres.empty(); cell /= 2) {
    const auto own = std::partition(spheres.begin(), spheres.end(),
                                    [&](const Sphere& sphere) { return cellFor(sphere.radius) <= cell / 2; });
    if (own != spheres.end())
      sizes.push_back({{{own, spheres.end()}, box.low, cell}, {{spheres.begin(), own}, box.low, cell}});
    spheres.erase(own, spheres.end());
  }
  return sizes;
}

// The lists of all threads; a pair may be in several lists, and several times.
Lists meet(const std::vector<SizeOfCells>& sizes, double enlargement, unsigned threadCount) {
  Lists lists;
  std::mutex mutex;
  for (const SizeOfCells& size : sizes) {
    SharedParts parts(size.own.cellCount(), kCellsPerPart);
    inParallel(threadCount, [&] {
      PairCounts counts;
      const auto compare = [&](const Sphere& a, const Sphere& b) {
        const double reach = enlargement * (double{a.radius} + double{b.radius});
        const Vec3d gap = static_cast<Vec3d>(a.centre) - static_cast<Vec3d>(b.centre);
        if (a.strand != b.strand && length(gap) < reach) counts.add(a.strand, b.strand);
      };
      parts.take([&](std::size_t begin, std::size_t end) {
        size.own.eachNear(size.own, begin, end, compare);
        size.own.eachNear(size.smaller, begin, end, compare);
      });
      const std::lock_guard lock(mutex);
      counts.moveTo(lists);
    });
  }
  return lists;
}

// For each strand the counts that were noted with strands of a higher index.
struct Noted {
  struct Count {
    std::uint32_t other, count;
  };
  std::vector<std::uint64_t> first;  // index of each strand's first count, and the end
  std::vector<Count> counts;

  Noted(Lists lists, std::size_t strandCount) : first(strandCount + 1) {
    for (const auto& list : lists)
      for (const StrandOverlap& o : list) ++first[o.a + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    counts.resize(first.back());
    std::vector<std::uint64_t> next(first.begin(), first.end() - 1);
    for (auto& list : lists) {
      for (const StrandOverlap& o : list) counts[next[o.a]++] = {o.b, o.count};
      list = {};
    }
  }
  std::span<Count> of(std::size_t strand) {
    return std::span(counts).subspan(first[strand], first[strand + 1] - first[strand]);
  }
};

// Adds up one strand's counts: a counter for each other strand, of which only those used are cleared.
class OverlapRow {
 public:
  explicit OverlapRow(std::size_t strandCount) : counts_(strandCount, 0) {}

  // Merges the counts in place: each other strand once, ascending, at the front. Returns their number.
  std::size_t add(std::span<Noted::Count> noted) {
    for (const Noted::Count& one : noted) {
      if (counts_[one.other] == 0) touched_.push_back(one.other);
      counts_[one.other] += one.count;
    }
    std::ranges::sort(touched_);
    std::size_t added = 0;
    for (const std::uint32_t other : touched_) noted[added++] = {other, std::exchange(counts_[other], 0)};
    touched_.clear();
    return added;
  }

 private:
  std::vector<std::uint32_t> counts_, touched_;
};

}  // namespace

std::vector<StrandOverlap> countOverlaps(const RestState& rest, const ContactParticles& particles,
                                         double enlargement, unsigned threadCount) {
  const std::size_t strandCount = particles.strandCount();
  std::vector<Sphere> spheres;
  spheres.reserve(particles.particles.size());
  for (std::size_t i = 0; i < particles.particles.size(); ++i) {
    const std::uint32_t strand = particles.strands[i];
    spheres.push_back({rest.points[particles.particles[i]], particles.radii[strand], strand});
  }
  Noted noted(meet(sortBySize(std::move(spheres), enlargement), enlargement, threadCount), strandCount);

  std::vector<std::size_t> others(strandCount);  // number of partners of each strand
  SharedParts parts(strandCount, kStrandsPerPart);
  inParallel(threadCount, [&] {
    OverlapRow row(strandCount);
    parts.take([&](std::size_t begin, std::size_t end) {
      for (std::size_t a = begin; a < end; ++a) others[a] = row.add(noted.of(a));
    });
  });
  std::vector<StrandOverlap> overlaps;
  overlaps.reserve(std::accumulate(others.begin(), others.end(), std::size_t{0}));
  for (std::uint32_t a = 0; a < strandCount; ++a)
    for (const Noted::Count& one : noted.of(a).first(others[a]))
      overlaps.push_back({a, one.other, one.count});
  return overlaps;
}

}  // namespace ringlet
