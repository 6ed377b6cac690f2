// GroomRuler and GroomMeasure: measures of each strand of a groom, and their summary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/strand_measure.h"

namespace ringlet {

/// Mean and extremes over strands.
struct Spread {
  double mean = 0, min = 0, max = 0;
};

/// The spread of some values; all 0 without values.
Spread spreadOf(std::span<const double> values);

/// The values of StrandMeasure over all strands, in its units.
struct GroomMeasure {
  std::size_t strandCount = 0, particleCount = 0;
  std::size_t curledCount = 0;                            // strands that are not straight at rest
  std::size_t rightHandedCount = 0, leftHandedCount = 0;  // by their present winding; perversions count as
                                                          // either
  Spread droop, relativeDroop, chord, chordElongation, coreLength, coreElongation;
  Spread arcDrift, maxEdgeStretch, turns, turnsAtRest, winding, meanRadius, meanRadiusAtRest;
  Spread handednessKept, tipRotation;
};

/// Of a spread's two extremes the one farther from 0, with its sign.
double worstOf(const Spread& spread);

/// The rest shapes with which the strands of a groom are compared.
class GroomRuler {
 public:
  /// Uses rest.metresPerUnit. Errors: no strands, and those of StrandRuler::make with the strand's number.
  /// Cost: as measure().
  static Result<GroomRuler> make(const Groom& rest);

  /// One measure per strand. points: as many as in the groom, in its order; metresPerUnit: of these points.
  /// Errors: a particle that is not finite, with its strand. Cost: some 0.3 us a particle.
  Result<std::vector<StrandMeasure>> measure(std::span<const Vec3f> points, double metresPerUnit, Vec3d up,
                                             Quatd headRotation = {}) const;

  /// The measures of the rest groom itself.
  std::vector<StrandMeasure> rest() const;

  /// The head's rotation, estimated from the roots (head_fit.h).
  Quatd headRotationOf(std::span<const Vec3f> points, double metresPerUnit) const;

  GroomMeasure summarize(std::span<const StrandMeasure> measures) const;

  std::size_t strandCount() const { return strands_.size(); }
  std::size_t particleCount() const { return firstPoint_.back(); }
  const StrandRuler& strand(std::size_t s) const { return strands_[s]; }
  double meanArcLength() const;  // of the strands [m]

  /// A strand's points in metres.
  std::vector<Vec3d> strandIn(std::span<const Vec3f> points, double metresPerUnit, std::size_t s) const;

 private:
  GroomRuler() = default;

  std::vector<StrandRuler> strands_;
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  std::vector<Vec3d> restRoots_;           // [m]
};

}  // namespace ringlet
