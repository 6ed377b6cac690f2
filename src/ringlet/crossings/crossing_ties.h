// Particles that move as one, because edges between them would cross otherwise: of each tied pair all four
// ends, and what hangs together through such pairs (a rigid impact zone, Bridson et al. 2002).
//
//     x -> x + u + w x (x - c)       c the centre of mass, u and w by the momentum and angular momentum of
//     its own
//
// For t in [0, 1] the map x -> x + t (u + w x (x - c)) is affine and invertible, det = 1 + t^2 |w|^2, so no
// edge goes through another. With a pinned particle among them, whose way is given: c is there, and u its
// way; with several of them as the head moves.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/crossings/crossing_pairs.h"

namespace ringlet {

/// Those that share a label.
struct TiedGroup {
  std::uint32_t count = 0;
  double mass = 0;  // [kg]
  std::uint32_t pinnedCount = 0;
  bool isTorn = false;  // pinned ones have ways that differ
  Vec3d centre{}, way{}, turn{};

  bool goesAsHead() const { return pinnedCount > 1; }
};

class CrossingTies {
 public:
  /// turn: the head's, in the step.
  CrossingTies(const CrossingHair& hair, const Quatd& turn, const std::vector<Vec3d>& from)
      : hair_(hair), turn_(turn), from_(from) {}

  bool isEmpty() const { return groups_.empty(); }
  void clear() { tied_.clear(), labels_.clear(), groups_.clear(); }
  /// Ties all four ends of these, beside what is tied already. `to`: the ways of pinned particles.
  void add(const std::vector<EdgePair>& pairs, const std::vector<Vec3d>& to);
  /// Lets every group go as one, with the momenta that its particles have on their ways to `to`.
  void apply(std::vector<Vec3d>& to) const;

  /// Whether its way may be changed.
  bool isFree(std::size_t i) const { return hair_.masses[i] > 0 && !(isTied(i) && groupOf(i).goesAsHead()); }
  bool isTied(std::size_t i) const { return !isEmpty() && groupOf(i).count > 1; }
  /// Whether one invertible map moves both edges.
  bool movesAsOne(const EdgePair& pair) const;
  /// Each value the mean of its group by mass; 0 in one that goes as the head does.
  void share(std::vector<double>& values) const;
  /// Particles in groups.
  std::uint64_t tiedCount() const;

 private:
  const TiedGroup& groupOf(std::size_t i) const { return groups_[labels_[i]]; }
  bool isFitted(std::size_t i) const { return isTied(i) && !groupOf(i).goesAsHead(); }
  void label(const std::vector<EdgePair>& pairs);
  std::vector<TiedGroup> fitted(const std::vector<Vec3d>& to) const;
  Vec3d carried(std::size_t i) const { return rotate(turn_, from_[i]); }

  const CrossingHair& hair_;
  Quatd turn_;
  const std::vector<Vec3d>& from_;
  std::vector<EdgePair> tied_;
  std::vector<std::uint32_t> labels_;  // of each particle: the first of its group
  std::vector<TiedGroup> groups_;      // by label; empty: nothing is tied
};

}  // namespace ringlet
