// Implements crossings/crossing_ties.h.
#include "ringlet/crossings/crossing_ties.h"

#include <algorithm>
#include <numeric>

namespace ringlet {
namespace {

constexpr double kTorn = 1e-7;  // [m]: pinned ways that differ by less are one
// Of a group in a line: the resistance to a turn about it, as a share of that to others.
constexpr double kLeastInertia = 1e-6;

// sum m (|r|^2 - r r^T) of a group, and what its turn must be for a spin.
struct Inertia {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  void add(double m, Vec3d r) {
    xx += m * (r.y * r.y + r.z * r.z), yy += m * (r.z * r.z + r.x * r.x), zz += m * (r.x * r.x + r.y * r.y);
    xy -= m * r.x * r.y, yz -= m * r.y * r.z, zx -= m * r.z * r.x;
  }
  Vec3d turnFor(Vec3d spin) const {
    const double least = kLeastInertia * (xx + yy + zz);
    const Vec3d a{xx + least, xy, zx}, b{xy, yy + least, yz}, c{zx, yz, zz + least};
    const double determinant = dot(a, cross(b, c));
    if (!(determinant > 0)) return {};
    return (dot(spin, cross(b, c)) * Vec3d{1, 0, 0} + dot(a, cross(spin, c)) * Vec3d{0, 1, 0} +
            dot(a, cross(b, spin)) * Vec3d{0, 0, 1}) /
           determinant;
  }
};

}  // namespace

// The least label wins, over and over.
void CrossingTies::label(const std::vector<EdgePair>& pairs) {
  tied_.insert(tied_.end(), pairs.begin(), pairs.end());
  if (labels_.empty()) {
    labels_.resize(from_.size());
    std::iota(labels_.begin(), labels_.end(), 0u);
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (const EdgePair& pair : tied_) {
      std::uint32_t least = labels_[pair.p];
      for (const std::uint32_t i : pair.ends()) least = std::min(least, labels_[i]);
      for (const std::uint32_t i : pair.ends()) {
        changes = changes || labels_[i] != least;
        labels_[i] = least;
      }
    }
  }
}

void CrossingTies::add(const std::vector<EdgePair>& pairs, const std::vector<Vec3d>& to) {
  label(pairs);
  groups_.assign(labels_.size(), {});
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    TiedGroup& group = groups_[labels_[i]];
    ++group.count;
    group.mass += hair_.masses[i];
    group.pinnedCount += hair_.masses[i] == 0;
  }
  std::vector<bool> isKnown(groups_.size());  // the way that is given
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    TiedGroup& group = groups_[labels_[i]];
    const double m = hair_.masses[i];
    if (group.pinnedCount == 0) group.centre += m / group.mass * from_[i];
    if (m > 0) continue;
    const Vec3d way = to[i] - (group.goesAsHead() ? carried(i) : from_[i]);
    if (!isKnown[labels_[i]]) group.way = way;
    isKnown[labels_[i]] = true;
    group.isTorn = group.isTorn || length(group.way - way) > kTorn;
    group.centre = from_[i];
  }
}

bool CrossingTies::movesAsOne(const EdgePair& pair) const {
  if (isEmpty() || groupOf(pair.p).isTorn) return false;
  return std::ranges::all_of(pair.ends(), [&](std::uint32_t i) { return labels_[i] == labels_[pair.p]; });
}

void CrossingTies::share(std::vector<double>& values) const {
  if (isEmpty()) return;
  std::vector<double> sums(groups_.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[labels_[i]] += hair_.masses[i] * values[i];
  for (std::size_t i = 0; i < values.size(); ++i)
    if (isTied(i)) values[i] = groupOf(i).goesAsHead() ? 0 : sums[labels_[i]] / groupOf(i).mass;
}

std::uint64_t CrossingTies::tiedCount() const {
  std::uint64_t count = 0;
  for (const TiedGroup& group : groups_) count += group.count > 1 ? group.count : 0;
  return count;
}

// The groups, with their ways and turns.
std::vector<TiedGroup> CrossingTies::fitted(const std::vector<Vec3d>& to) const {
  std::vector<TiedGroup> groups = groups_;
  std::vector<Vec3d> spins(groups.size());
  std::vector<Inertia> inertias(groups.size());
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!isFitted(i) || groupOf(i).pinnedCount > 0) continue;
    groups[labels_[i]].way += hair_.masses[i] / groupOf(i).mass * (to[i] - from_[i]);
  }
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!isFitted(i)) continue;
    const std::uint32_t g = labels_[i];
    const Vec3d arm = from_[i] - groups[g].centre;
    spins[g] += hair_.masses[i] * cross(arm, to[i] - from_[i] - groups[g].way);
    inertias[g].add(hair_.masses[i], arm);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].count > 1 && !groups[g].goesAsHead()) groups[g].turn = inertias[g].turnFor(spins[g]);
  return groups;
}

void CrossingTies::apply(std::vector<Vec3d>& to) const {
  if (isEmpty()) return;
  const std::vector<TiedGroup> groups = fitted(to);
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!isTied(i) || hair_.masses[i] == 0) continue;
    const TiedGroup& group = groups[labels_[i]];
    to[i] = group.goesAsHead() ? carried(i) + group.way
                               : from_[i] + group.way + cross(group.turn, from_[i] - group.centre);
  }
}

}  // namespace ringlet
