// FrameTurn: how far a strand's frames turn from one look to the next. Carried along the smoothed strand they
// turn by the less the sooner one looks again; along the raw strand they jump where it folds, however soon
// (Iben et al. 2012, section 3.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"

namespace ringlet {

/// Show it every step, then ask. The frames are those a step holds the edges in, in double: seen from the
/// head, carried along the strand smoothed by the material's bend smoothing length, 0 being the raw strand.
class FrameTurn {
 public:
  /// rest: finite, strands of two particles and more; uses rest.metresPerUnit.
  FrameTurn(const Groom& rest, const Material& material);

  /// points: as many as in the groom, in its order; metresPerUnit: of these points. head: its rotation
  /// against the rest pose. Cost: one pass.
  void look(std::span<const Vec3f> points, double metresPerUnit, Quatd head = {});

  /// The largest angle by which any frame of any strand turned from one look to the next, in [0, 180]
  /// [degrees]; 0 before the second.
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
