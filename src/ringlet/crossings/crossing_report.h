// CrossingReport: what it took to keep hair from going through hair (crossing_step.h).
#pragma once

#include <cstdint>

namespace ringlet {

/// What happened in a step, or in many.
struct CrossingReport {
  std::uint64_t particles = 0;  // whose ways may be changed, over all steps
  std::uint64_t changed = 0;    // of these, ways that were changed by more than 1e-7 m
  double changes = 0;           // sum of their lengths [m]
  double mostChange = 0;        // [m]
  std::uint64_t tied = 0;       // particles that were tied
  std::uint64_t stretched = 0;  // edges that the changes made longer than the stretch limit allows
  double mostStretch = 0;       // the largest length of one, as a share of that in the groom's [1]
  std::uint64_t heldSteps = 0;  // in which all free hair moved as the head does
  std::uint64_t unsafe = 0;     // pairs of edges that may have crossed in spite of all

  /// Of all ways, such as `changed` or `tied`.
  double shareOf(std::uint64_t some) const {
    return particles > 0 ? static_cast<double>(some) / static_cast<double>(particles) : 0;
  }
  /// Of ways that were changed [m].
  double meanChange() const { return changed > 0 ? changes / static_cast<double>(changed) : 0; }

  void add(const CrossingReport& other);
};

}  // namespace ringlet
