// Measures of hair in contact: how deep hairs are in each other, in a pose and over a run.
#pragma once

#include <cstdint>

namespace ringlet {

/// Over all pairs of contact particles of different strands that are closer than R, the sum of their radii. A
/// contact's rest length r0 is R, or the pair's distance at rest if that is less, since what overlaps at rest
/// may overlap. The overlap beyond rest is max(0, r0 - distance) / R.
struct ContactQuality {
  std::uint64_t overlapping = 0;    // number of pairs closer than R
  double rawRecall = 1;             // share of them whose strands may touch; 1 if there are none
  double overlapBeyondRestSum = 0;  // over all of them, whether they may touch or not
  double deepestOverlap = 0;        // the largest of them; 1: both centres coincide
};

/// Over all steps and frames.
struct ContactNumbers {
  std::uint64_t crossings = 0;  // over all steps (measure/crossings.h)
  ContactQuality worst;         // of the frame with the largest overlapBeyondRestSum; of equal ones the last
  double deepestOverlap = 0;    // over all frames, beyond rest, as a share of R
};

}  // namespace ringlet
