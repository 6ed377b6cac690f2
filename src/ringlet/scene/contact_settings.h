// ContactSettings: whether and how hairs meet. Iben et al. 2012, section 4: particles carry spheres; which of
// them may touch is decided once, in the rest pose. Part of scene/settings.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace ringlet {

/// A contact is seen ahead, by how fast two particles near each other, once they are nearer than this times
/// its rest length: further off, what will meet is anybody's guess, and looking costs its cube.
inline constexpr double kContactSeenAhead = 2;

/// Lists of pairs reach this share of R further than they must, so that they can be kept for some steps.
inline constexpr double kContactMargin = 0.15;

/// A step's solve starts from the velocities it would have without contacts and this share of what the last
/// step's contacts (and its stretch limit) changed: 0 starts cold, 1 may swing.
inline constexpr double kContactWarmth = 0.8;

/// How a contact comes and goes.
enum class ContactTaper {
  distance,  // with where the two are: it has no memory, and costs less
  time       // it has a life (Iben et al. 2012): stiffness grows, then falls, and then damping
};
inline constexpr const char* kContactTaperNames[] = {"distance", "time"};
constexpr const char* nameOf(ContactTaper taper) { return kContactTaperNames[static_cast<int>(taper)]; }

/// With the distance taper damping fades from the rest length of a contact to this times it.
inline constexpr double kContactTaperEnd = 1.05;

/// By what means hair meets hair.
enum class ContactMethod {
  automatic,      // strands that are dense at rest among themselves as a volume, all others pair by pair
  explicitPairs,  // pair by pair
  volume          // all strands as a volume
};
inline constexpr const char* kContactMethodNames[] = {"auto", "explicit", "volume"};
constexpr const char* nameOf(ContactMethod method) { return kContactMethodNames[static_cast<int>(method)]; }

/// Strands that hang together are dense where the median of them has hair about it, at rest, as dense as so
/// many of itself; those with less than half of it do not belong to them (rest/dense_strands.h).
inline constexpr double kDenseStrands = 9;

/// A cell of the volume's grid, in radii of contact particles as they are chosen without a setting.
inline constexpr double kVolumeCellRadii = 4;
/// Particles are put into the grid's cells so often [s]: between, what is near moves with them.
inline constexpr double kVolumeSortSeconds = 1.0 / 48;
/// The same in steps, at least 1.
inline std::uint32_t volumeSortSteps(double stepSeconds) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(kVolumeSortSeconds / stepSeconds)));
}
/// Particles of a strand that take part are at most so many cells apart along it, each for those between.
inline constexpr double kVolumeSpacing = 1.6;

/// Where one contact particle in q takes part, radii grow by q to this.
inline constexpr double kThinnedRadiusPower = 0.2;

/// checkSettings (rest/rest_state.h) holds the ranges. `w` below is what a contact particle weighs: its mass
/// m_c, the strand's over its number of contact particles, times 9.81 m/s^2. R is the sum of two radii [m].
struct ContactSettings {
  bool on = false;
  ContactMethod method = ContactMethod::automatic;

  // Spheres.
  /// Of every particle [m], 1e-6 to 1; unset: half the mean distance from a root to its nearest other root.
  std::optional<double> radius;
  bool fillGaps = false;  // strands cut coarser than R get a larger radius, so that nothing slips between
                          // their particles; in a dense groom that multiplies the contacts
  double spacing = 0.75;  // contact particles stand this times R apart along a strand, 0.01 to 1: less
                          // keeps more of them, finer and slower
  /// Of dense strands (rest/dense_strands.h) only one contact particle in round(1 / detail) takes part, 0.05
  /// to 1, larger and heavier for it: faster, and hair slips through a little.
  double detail = 1;

  // Which pairs of strands may touch: all, or those that are near at rest. Pruned hair passes through hair it
  // was not beside at rest; what that saves in time is little (docs/accuracy.md).
  bool prunePairs = false;
  double enlargement = 1.5;  // factor on radii while overlaps at rest are counted, 1 to 100: more, and
                             // strands further apart count
  int minOverlaps = 8;       // pairs of strands with fewer overlapping spheres are dropped, 1 to 1e6
  int maxNeighbours = 0;     // of a strand; those with most overlaps stay, 0 to 1e6; 0: no bound
  double dropShare = 0;  // of the pairs then left, dropped at random, 0 to 1 (the paper's stochastic pruning)
  std::uint32_t seed = 1;  // of dropShare and detail

  // The spring between two spheres that touch. It has no force at rest: spheres that overlap there may.
  double stiffness = 1000;  // in w / R, 0 to 1e7: a tenth of the default is felt as soft
  double dampingRatio = 1;  // along the contact's normal; 1 is critical, 0 to 100
  double friction = 0;      // tangential damping, as a share of the normal one, 0 to 1
  ContactTaper taper = ContactTaper::distance;
  // With the time taper:
  double rampSeconds = 0.02;  // from first touch to full stiffness [s], 0 to 10; damping is full at once
  double stiffnessReleaseSeconds = 0.02;  // from parting until stiffness has faded [s], 0 to 10
  double dampingReleaseSeconds = 0.02;    // and then damping [s], 0 to 10
  double breakFactor = 1.2;  // parted further than this times its rest length, a contact is over, 1 to 10

  /// Parted further than this times its rest length, a contact is over.
  double reach() const { return taper == ContactTaper::time ? breakFactor : kContactTaperEnd; }
  /// Lists hold all that is nearer than this times its rest length.
  double listedReach() const { return taper == ContactTaper::time ? 1 : kContactTaperEnd; }

  // Hair as a volume (rest/volume_strands.h says which strands; equations/volume.glsl how).
  std::optional<double> volumeCell;  // of the grid [m], 1e-5 to 10; unset: kVolumeCellRadii radii, or more
                                     // where particles stand further apart
  double volumeDrag = 600;           // towards the velocity of what is near [1/s], 0 to 1e5
  double volumeStiffness = 1e5;      // towards its displacement [1/s^2], 0 to 1e9
  double volumeMemorySeconds = 0.3;  // in which a displacement is forgotten [s], 0.001 to 1000

  /// Whether any strand may go by volume. The paper's contacts, with a taper in time, are pairs.
  bool mayBeVolume() const {
    return method != ContactMethod::explicitPairs && taper == ContactTaper::distance;
  }

  // How strands hear of each other within a step.
  /// Of the solve, 1 to 1000: more lose less momentum and creep less, at a solve each. Unset: 2 where any two
  /// strands meet pair by pair, 1 where all meet as a volume.
  std::optional<int> iterations;
  int iterationCount(bool pairByPair) const { return iterations.value_or(pairByPair ? 2 : 1); }
};

}  // namespace ringlet
