// FrameTurn: how far a strand's frames turn between two looks. Frames transported along the smoothed strand
// turn less the shorter the interval is; along the raw strand they jump where it folds, however short it is
// (Iben et al. 2012, section 3.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"

namespace ringlet {

/// Call look for every step, then largest. Frames are those that a step computes for the edges, in double:
/// relative to the head, transported along the strand smoothed by the material's bend smoothing length; 0 is
/// the raw strand.
class FrameTurn {
 public:
  /// rest: finite, strands of at least two particles; uses rest.metresPerUnit.
  FrameTurn(const Groom& rest, const Material& material);

  /// points: as many as in the groom, in its order; metresPerUnit: of these points. head: its rotation
  /// relative to the rest pose. Cost: one pass.
  void look(std::span<const Vec3f> points, double metresPerUnit, Quatd head = {});

  /// The largest angle by which any frame of any strand turned between two looks, in [0, 180] [degrees]; 0
  /// before the second look.
  double largest() const { return largest_; }

 private:
  struct Strand {
    Vec3d firstEdge;            // at rest [m]
    double beta = 1;            // weight of the smoothing
    std::vector<Quatd> frames;  // at the last look
  };

  std::vector<Strand> strands_;
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  double largest_ = 0;                     // [degrees]
};

}  // namespace ringlet
