// Decides which strands are not simulated but carried rigidly by their roots, in their rest shape: those that
// float32 cannot hold, and a few short ones that would make the whole groom need far more steps.
//
//   short      less than a tenth as long as the groom's median strand
//   too fine   rounding of positions is more than 1/1000 of an edge at the stretch limit, and the strand is
//              short or rounding is more than a tenth of its mean edge; or it is at most 1e-6 m long
//   too quick  short, at most one strand in a hundred, needs more than twice the steps a frame that the other
//              99 need, and more than the run takes
//
// A strand that is not short is never carried rigidly because of the steps it needs, and because of its edges
// only if rounding destroys its shape. The strands of a groom far from its origin are simulated, with a
// warning.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// A strand at rest, relative to the head's origin [m]. Root poses (as of a scalp) that move a strand farther
/// away cost more digits; this is not considered.
struct StrandSize {
  double length = 0;
  double meanEdge = 0, shortestEdge = 0;  // the shortest is bounded below as in the stretch limit
                                          // (kShortestEdge)
  double distance = 0;                    // largest distance of a particle from the origin
  std::size_t repeatedCount = 0;          // particles at the same place as the one before (kNoEdgeShare)
};
StrandSize sizeOfStrand(std::span<const Vec3f> points);

/// The most by which rounding changes an edge at a distance [m] from the origin, in one step. A step rounds
/// each end twice (p + T v, and the limit's shift), each time by at most half the spacing of float32 numbers:
/// two spacings together, and a spacing is at most 2^-23 of the number.
inline double edgeRounding(double distance) { return distance * 0x1p-22; }

/// A strand must be longer than this [m] to be simulated.
inline constexpr double kLeastStrandLength = 1e-6;

/// The median over all strands [m]; `sizes` is not empty.
double medianLength(std::span<const StrandSize> sizes);

/// The strands of `sizes` that are too fine, ascending.
std::vector<std::uint32_t> tooFineStrands(std::span<const StrandSize> sizes, double maxStretch);

/// The strands that are too quick for steps of stepSeconds, ascending. longestSteps: for each strand the
/// longest stable step, at most the step that resolves the motion [s]; 0: the strand is carried rigidly
/// already.
std::vector<std::uint32_t> tooQuickStrands(std::span<const StrandSize> sizes,
                                           std::span<const double> longestSteps, double stepSeconds);

/// Warnings, a sentence each, with strands and numbers.
std::vector<std::string> tooFineWarnings(std::span<const StrandSize> sizes,
                                         std::span<const std::uint32_t> tooFine);
std::vector<std::string> tooQuickWarnings(std::span<const StrandSize> sizes,
                                          std::span<const std::uint32_t> tooQuick,
                                          std::span<const double> longestSteps, const Settings& settings);
/// The warning about particles at the same place as the one before, whose edges have no direction of their
/// own.
std::vector<std::string> repeatWarnings(std::span<const StrandSize> sizes);
/// The warning about a groom that is far from its origin relative to its edges; or else about strands that
/// are simulated although rounding is more than a hundredth of one of their edges.
std::vector<std::string> roundingWarnings(std::span<const StrandSize> sizes,
                                          std::span<const std::uint32_t> tooFine);

}  // namespace ringlet
