// ContactSettings: whether and how hairs collide. Iben et al. 2012, section 4: particles carry spheres; the
// pairs of strands that may touch are chosen once, in the rest pose. Part of scene/settings.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ringlet {

/// Speculative contact distance, as a multiple of the pair's rest length. A pair closer than this becomes a
/// contact if it would touch within the step. The cost of the search grows with its cube.
inline constexpr double kContactSeenAhead = 2;

/// Margin of the lists of pairs, as a share of R: lists can be kept until two particles have approached by
/// more than this.
inline constexpr double kContactMargin = 0.15;

/// Warm start of contacts pair by pair: a step's solve starts from its contact-free velocities and this share
/// of the velocity change that contacts and the stretch limit caused in the last step. 0 is a cold start, 1
/// may oscillate. Hair as a volume: equations/volume.glsl.
inline constexpr double kContactWarmth = 0.8;

/// How a contact fades in and out.
enum class ContactTaper {
  distance,  // with the distance of the pair; no memory, lower cost
  time       // in time (Iben et al. 2012): stiffness grows, later fades, and then damping fades
};
inline constexpr const char* kContactTaperNames[] = {"distance", "time"};
constexpr const char* nameOf(ContactTaper taper) { return kContactTaperNames[static_cast<int>(taper)]; }

/// With the distance taper damping fades between the rest length of a contact and this multiple of it.
inline constexpr double kContactTaperEnd = 1.05;

/// How strands collide with each other.
enum class ContactMethod {
  automatic,      // strands that are dense at rest among themselves as a volume, all others pair by pair
  explicitPairs,  // pair by pair
  volume          // all strands as a volume
};
inline constexpr const char* kContactMethodNames[] = {"auto", "explicit", "volume"};
constexpr const char* nameOf(ContactMethod method) { return kContactMethodNames[static_cast<int>(method)]; }

/// Connected strands are dense where the median strand has as much hair around it at rest as this number of
/// strands like itself. Strands with less than half of that are left out (rest/dense_strands.h).
inline constexpr double kDenseStrands = 9;

/// Strands, groom order, that do not touch each other: those of a braid or a bun, whose shape a goal keeps.
/// They meet all other strands pair by pair.
using ContactBundle = std::vector<std::uint32_t>;

/// Cell size of the volume's grid, in default radii of contact particles.
inline constexpr double kVolumeCellRadii = 4;
/// Interval at which particles are sorted into the grid's cells [s]. Between, neighbours move together.
inline constexpr double kVolumeSortSeconds = 1.0 / 48;
/// The same interval in steps, at least 1.
inline std::uint32_t volumeSortSteps(double stepSeconds) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(kVolumeSortSeconds / stepSeconds)));
}
/// Largest distance along a strand between the volume's particles, in cells; each represents the particles of
/// the strand around it.
inline constexpr double kVolumeSpacing = 1.6;
/// Of hair as a volume (equations/volume.glsl): the resistance that the common motion of a neighbourhood
/// meets [1/s]; the largest warm start, with which hair still comes to rest at 4 steps a frame; the share of
/// the gradient of the hair's motion that a particle keeps, and the rim of a cell in which that fades
/// [cells].
inline constexpr double kVolumeResponse = 440, kVolumeMostWarmth = 0.9;
inline constexpr double kVolumeGradient = 0.85, kVolumeRim = 0.1;
/// Speed beside the head up to which the volume's sums have room for hair [m/s].
inline constexpr double kVolumeMostSpeed = 32;
/// And stretch of a strand, where Settings::maxStretch allows more.
inline constexpr double kVolumeMostStretch = 2;

/// Where one contact particle in q takes part, its radius is multiplied by q to this power.
inline constexpr double kThinnedRadiusPower = 0.2;

/// checkSettings (rest/rest_state.h) checks the ranges. `w` below is the weight of a contact particle: its
/// mass m_c (the strand's mass over its number of contact particles) times 9.81 m/s^2. R is the sum of two
/// radii [m].
struct ContactSettings {
  bool on = false;
  ContactMethod method = ContactMethod::automatic;

  // Spheres.
  /// Radius of every sphere [m], 1e-6 to 1; unset: half the mean distance of a root to the nearest root.
  std::optional<double> radius;
  /// Factors on it by strand in groom order, above 0; strands after its end have 1. null: all have 1.
  std::shared_ptr<const std::vector<float>> radiusFactors;
  bool fillGaps = false;  // strands whose particles are farther apart than R get a larger radius, so that
                          // nothing passes between; in a dense groom this multiplies the contacts
  double spacing = 0.75;  // distance of contact particles along a strand in R, 0.01 to 1: a smaller one is
                          // finer and slower
  /// Of dense strands (rest/dense_strands.h) one contact particle in round(1 / detail) takes part, 0.05 to 1,
  /// with a larger radius and mass. A smaller detail is faster, and some hair passes through.
  double detail = 1;

  // Which pairs of strands may touch: all, or those that are near at rest. Hair of a pruned pair passes
  // through; pruning saves little time (docs/accuracy.md).
  bool prunePairs = false;
  double enlargement = 1.5;  // factor on radii while overlaps at rest are counted, 1 to 100
  int minOverlaps = 8;       // pairs of strands with fewer overlapping spheres are dropped, 1 to 1e6
  int maxNeighbours = 0;     // neighbours of a strand, those with most overlaps, 0 to 1e6; 0: no limit
  double dropShare = 0;      // share of the remaining pairs that is dropped at random, 0 to 1 (the paper's
                             // stochastic pruning)
  std::uint32_t seed = 1;    // of dropShare and detail

  std::shared_ptr<const std::vector<ContactBundle>> bundles;  // no strand in two; null: none

  /// Beside what contacts do, ways are changed until no hair can go through hair (ringlet/crossings).
  bool noCrossings = false;

  // The spring between two spheres that touch. Spheres may overlap at rest; the spring has no force there.
  double stiffness = 1000;  // in w / R, 0 to 1e7; a tenth of the default is soft
  double dampingRatio = 1;  // along the contact's normal; 1 is critical, 0 to 100
  double friction = 0;      // tangential damping, as a share of the normal one, 0 to 1
  ContactTaper taper = ContactTaper::distance;
  // With the time taper:
  double rampSeconds = 0.02;  // from first touch to full stiffness [s], 0 to 10; damping is full at once
  double stiffnessReleaseSeconds = 0.02;  // from the last touch until stiffness has faded [s], 0 to 10
  double dampingReleaseSeconds = 0.02;    // after that, until damping has faded [s], 0 to 10
  double breakFactor = 1.2;               // a contact ends at this multiple of its rest length, 1 to 10

  /// What numbers alone do not say: the lists of strands.
  void takeLists(const ContactSettings& from) {
    radiusFactors = from.radiusFactors;
    bundles = from.bundles;
  }
  /// Lists are the same where they are one in memory.
  bool operator==(const ContactSettings&) const = default;

  /// Of a strand, by its place in the groom.
  double radiusFactor(std::size_t strand) const {
    return radiusFactors && strand < radiusFactors->size() ? double{(*radiusFactors)[strand]} : 1.0;
  }
  /// The multiple of its rest length at which a contact ends.
  double reach() const { return taper == ContactTaper::time ? breakFactor : kContactTaperEnd; }
  /// Lists hold all pairs that are nearer than this multiple of their rest length.
  double listedReach() const { return taper == ContactTaper::time ? 1 : kContactTaperEnd; }

  // Hair as a volume (rest/volume_strands.h says which strands; equations/volume.glsl how).
  std::optional<double> volumeCell;  // cell size [m], 1e-5 to 10; unset: kVolumeCellRadii radii, or more
                                     // where particles are farther apart
  double volumeDrag = 600;           // towards the velocity of the hair around [1/s], 0 to 1e5
  double volumeStiffness = 1e6;      // towards its displacement [1/s^2], 0 to 1e9
  double volumeMemorySeconds = 0.3;  // time in which a displacement is forgotten [s], 0.001 to 1000

  /// kappa [1] and beta [1] of shaders/equations/volume.glsl.
  double volumeGain(double stepSeconds) const {
    return stepSeconds * (volumeDrag + stepSeconds * volumeStiffness);
  }
  double volumeWarmth(double stepSeconds) const {
    const double kappa = volumeGain(stepSeconds);
    if (kappa <= 0) return 0;
    return std::clamp(1 - 1 / (kVolumeResponse * stepSeconds) + 1 / kappa,
                      -kVolumeMostWarmth * (2 + kappa) / kappa, kVolumeMostWarmth);
  }

  /// Largest component of a = kappa w + k T s (shaders/equations/volume.glsl) that the volume's sums have
  /// room for [m/s]: of w up to kVolumeMostSpeed together with s up to twice the length of the longest
  /// strand, stretched [m], which is the farthest that a tip gets from where it was. A power of two, at
  /// least 1. The sums resolve 2^-30 of it: by default below 1e-6 m/s of w and 1e-8 m of s.
  double volumeMostRate(double stepSeconds, double longestStrand) const {
    const double kT = volumeStiffness * stepSeconds, kappa = volumeGain(stepSeconds);
    return std::exp2(std::ceil(std::log2(std::max(1.0, kappa * kVolumeMostSpeed + kT * 2 * longestStrand))));
  }

  /// Whether strands may meet as a volume. The paper's contacts, with a taper in time, are pairs.
  bool mayBeVolume() const {
    return method != ContactMethod::explicitPairs && taper == ContactTaper::distance;
  }

  /// Solves of a step that couple strands, 1 to 1000. More of them lose less momentum and creep less. Unset:
  /// 2 where any two strands meet pair by pair, 1 where all meet as a volume.
  std::optional<int> iterations;
  int iterationCount(bool pairByPair) const { return iterations.value_or(pairByPair ? 2 : 1); }
};

/// The bundle of each strand, from 1; 0: none. Empty where no strand has one.
inline std::vector<std::uint32_t> bundlesOf(const ContactSettings& settings, std::size_t strandCount) {
  if (!settings.bundles) return {};
  std::vector<std::uint32_t> bundles(strandCount);
  for (std::size_t b = 0; b < settings.bundles->size(); ++b)
    for (const std::uint32_t strand : (*settings.bundles)[b])
      bundles[strand] = static_cast<std::uint32_t>(b + 1);
  return bundles;
}

}  // namespace ringlet
