// Contacts on the device against brute force and against the double reference: contact lists of points, and
// strands that are shaken into each other.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::reference {
template <class Real>
class Simulation;
}

namespace ringlet::parity {

// Of shortSteps() [m].
inline constexpr double kListedR = 0.01, kListedSkin = kContactMargin * kListedR;

/// Strands of two particles, far from each other at rest.
Groom farApart(std::size_t strandCount);

/// Contacts, with a step so short that particles are near each other by place alone.
Settings shortSteps();

/// Strands far from each other at rest, then put at `points`, at rest, two by two; after one step.
Result<Simulation> stepAt(const ComputeDevice& device, const std::vector<Vec3f>& points,
                          const Settings& settings = shortSteps());

/// What the lists hold, against brute force over all pairs.
struct ListComparison {
  std::size_t near = 0;      // pairs that must be listed
  std::size_t onEdge = 0;    // pairs at the bound, to rounding: they may be listed or not
  std::size_t missed = 0;    // near, but not listed
  std::size_t extra = 0;     // listed, but neither near nor on the edge
  std::size_t repeated = 0;  // listed more than once on each side
};

/// Strands at `points` as stepAt has them. A pair must be listed if its particles belong to different
/// strands, are not both roots (roots follow the head), and are nearer than what acts on each other and the
/// skin.
Result<ListComparison> compareLists(const ComputeDevice& device, const std::vector<Vec3f>& points,
                                    const Settings& settings = shortSteps());

/// Curls that stand half a radius into each other.
Groom denseSwatch(int particles);
/// A dense bunch of 60 curls, and four that hang beside it; they meet when shaken along x.
Groom bunchAndStrands();
/// Contacts for either, pair by pair.
Settings meetingSettings();

/// A groom with the head shaken, device against the double reference: the largest distance of a particle in
/// any frame [m]; with kernel.features.goals, pulled to the groom; with kernel.features.fields, in fields.
/// `afterFrame` sees both after each frame, and may cut them.
Result<double> shakenError(
    const ComputeDevice& device, const Groom& groom, const Settings& settings, const KernelChoice& kernel,
    int frameCount, const std::function<void(Simulation&, reference::Simulation<double>&)>& afterFrame);

}  // namespace ringlet::parity
