// ContactSettings: whether and how hairs meet. Iben et al. 2012, section 4: particles carry spheres; which of
// them may touch is decided once, in the rest pose. Part of scene/settings.h.
#pragma once

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

/// checkSettings (rest/rest_state.h) holds the ranges. `w` below is what a contact particle weighs: its mass
/// m_c, the strand's over its number of contact particles, times 9.81 m/s^2. R is the sum of two radii [m].
struct ContactSettings {
  bool on = false;

  // Spheres.
  /// Of every particle [m], 1e-6 to 1; unset: half the mean distance from a root to its nearest other root.
  std::optional<double> radius;
  bool fillGaps = false;  // strands cut coarser than R get a larger radius, so that nothing slips between
                          // their particles; in a dense groom that multiplies the contacts
  double spacing = 0.75;  // contact particles stand this times R apart along a strand, 0.01 to 1: less
                          // keeps more of them, finer and slower

  // Which pairs of strands may touch. Pruning saves time; hair that meets hair it was not beside at rest
  // passes through it.
  bool prunePairs = true;    // false: all may
  double enlargement = 1.5;  // factor on radii while overlaps at rest are counted, 1 to 100: more, and
                             // strands further apart count
  int minOverlaps = 8;       // pairs of strands with fewer overlapping spheres are dropped, 1 to 1e6
  int maxNeighbours = 0;     // of a strand; those with most overlaps stay, 0 to 1e6; 0: no bound
  double dropShare = 0;  // of the pairs then left, dropped at random, 0 to 1 (the paper's stochastic pruning)
  std::uint32_t seed = 1;  // of dropShare

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

  // How strands hear of each other within a step.
  int iterations = 2;  // of the solve, 1 to 1000: more lose less momentum and creep less, at a solve each
};

}  // namespace ringlet
