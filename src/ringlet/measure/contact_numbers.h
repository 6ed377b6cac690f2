// What hair in contact is measured by: how deep hairs are in each other in a pose, and over a run.
#pragma once

#include <cstdint>

namespace ringlet {

/// Over all pairs of contact particles of different strands that are nearer than R, the sum of their radii. A
/// contact's rest length r0 is R, or their distance at rest where that is less: what overlaps at rest may.
/// The overlap beyond rest is max(0, r0 - distance) / R.
struct ContactQuality {
  std::uint64_t overlapping = 0;    // how many are nearer than R
  double rawRecall = 1;             // share of them whose strands may touch; 1 where there are none
  double overlapBeyondRestSum = 0;  // of all of them, allowed or not
  double deepestOverlap = 0;        // largest of all; 1: two centres in one place
};

/// Over all steps and frames seen.
struct ContactNumbers {
  std::uint64_t crossings = 0;  // over all steps (measure/crossings.h)
  ContactQuality worst;         // of the frame with the largest overlapBeyondRestSum; of equals the last
  double deepestOverlap = 0;    // of all frames, beyond rest, as a share of R
};

}  // namespace ringlet
