// StrandMeasure: a strand's shape compared with its rest shape, as a few numbers that hardly depend on the
// number of particles: the same helix gives the same values within 1 % with at least 4 particles a turn.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/measure/core.h"

namespace ringlet {

/// Lengths in metres. "At rest" means the rest strand as the head carries it: moved with the strand's root,
/// turned with the head. For a strand that is straight at rest (curl_shape.h) turns, winding, handedness and
/// tipRotation are 0 and handednessKept is 1.
struct StrandMeasure {
  double droop = 0;            // how far the tip is below its place at rest, along up [m]; negative: above
  double relativeDroop = 0;    // droop / rest arc length
  double chord = 0;            // root to tip [m]
  double chordElongation = 1;  // chord / rest chord; 1 if the rest chord is 0
  double coreLength = 0;       // length of the core (core.h) [m]
  double coreElongation = 1;   // core length / rest core length; 1 if that is 0
  double arcDrift = 0;         // sum of edge lengths / that at rest - 1
  double maxEdgeStretch = 1;   // largest edge length / rest edge length; edges shorter than a thousandth of
                               // the mean do not count, their length is rounding
  double turns = 0;    // about the core, counted positive in each part that winds as it does at rest: a curl
                       // that changes hand half way (a perversion) has all its turns
  double winding = 0;  // the same signed, right-handed positive: a perversion's halves cancel
  double meanRadius = 0;      // mean distance from the core, over arc length [m]
  int handedness = 0;         // of the winding: +1 right, -1 left, 0 straight or balanced
  double handednessKept = 1;  // share of the curled length whose handedness over a turn is that at rest
  double tipRotation = 0;     // of the last turn about the core against rest, in (-180, 180] [degrees]; mean
                           // over that turn, in which errors of the core cancel. Measured in a frame that the
                           // head carries at the root and that follows the core without twist; right-handed
                           // about the way from root to tip. unwrapDegrees() follows it beyond half a turn.
};

/// `angle` plus whole turns so that it is within half a turn of `before` [degrees].
double unwrapDegrees(double angle, double before);

/// The rest shape of a strand, with everything about it that can be computed once.
class StrandRuler {
 public:
  /// rest: root first, in metres. Errors: fewer than two particles, one that is not finite, no length.
  /// Cost: as measure().
  static Result<StrandRuler> make(std::span<const Vec3d> rest);

  /// points: as many as at rest, in metres. headRotation: of the head relative to the rest pose. up: unit
  /// vector. Errors: a particle that is not finite. Cost: n log n, some 0.3 us a particle.
  Result<StrandMeasure> measure(std::span<const Vec3d> points, Vec3d up, Quatd headRotation = {}) const;

  /// The rest shape itself, measured.
  const StrandMeasure& rest() const { return rest_; }
  /// As measureCurl.
  const CurlShape& shape() const { return shape_; }
  double arcLength() const { return at_.back(); }               // [m]
  std::span<const double> arcPositions() const { return at_; }  // of each particle [m]
  std::size_t particleCount() const { return points_.size(); }

 private:
  // Offsets from the core: normal + i binormal of the measuring frame [m].
  using Offsets = std::vector<std::complex<double>>;

  StrandRuler() = default;
  StrandMeasure measureFinite(std::span<const Vec3d> points, Vec3d up, Quatd headRotation,
                              const Offsets& offsets, double coreLength) const;
  Offsets offsetsFrom(std::span<const Vec3d> core, std::span<const Vec3d> points, Quatd headRotation) const;
  std::vector<double> windingOf(const Offsets& offsets) const;
  double windingOverATurn(std::span<const double> winding, double s) const;
  double meanRadius(const Offsets& offsets) const;

  std::vector<Vec3d> points_;
  std::vector<double> at_;       // arc position of each particle [m]
  std::vector<double> weights_;  // arc length that each particle represents [m]
  CurlShape shape_;
  double window_ = 0;                                                              // of the core [m]
  double restCoreLength_ = 0, restChord_ = 0, restLength_ = 0, shortestEdge_ = 0;  // [m]
  double smallestOffset_ = 0;  // closer to the core a particle has no direction from it [m]
  MeasuringFrame rootFrame_;
  Offsets restOffsets_;
  std::vector<double> restWindow_;  // winding at rest over the turn about each particle [turns]
  std::vector<int> edgeHand_;       // sign of the same for each edge
  StrandMeasure rest_;
};

}  // namespace ringlet
