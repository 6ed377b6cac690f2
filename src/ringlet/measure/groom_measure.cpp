// Implements measure/groom_measure.h.
#include "ringlet/measure/groom_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ringlet/base/assert.h"
#include "ringlet/measure/head_fit.h"

namespace ringlet {

Spread spreadOf(std::span<const double> values) {
  if (values.empty()) return {};
  double sum = 0;
  for (double value : values) sum += value;
  const auto [min, max] = std::ranges::minmax(values);
  return {sum / static_cast<double>(values.size()), min, max};
}

double worstOf(const Spread& spread) {
  return std::abs(spread.min) > std::abs(spread.max) ? spread.min : spread.max;
}

Result<GroomRuler> GroomRuler::make(const Groom& rest) {
  if (rest.strandCount() == 0) return Error{"the groom has no strands to measure"};
  GroomRuler ruler;
  ruler.firstPoint_ = rest.firstPoint;
  ruler.strands_.reserve(rest.strandCount());
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const std::vector<Vec3d> strand = ruler.strandIn(rest.points, rest.metresPerUnit, s);
    auto made = StrandRuler::make(strand);
    if (!made) return Error{fmt::format("strand {}: {}", s, made.error().message)};
    ruler.strands_.push_back(std::move(*made));
    ruler.restRoots_.push_back(strand.front());
  }
  return ruler;
}

Result<std::vector<StrandMeasure>> GroomRuler::measure(std::span<const Vec3f> points, double metresPerUnit,
                                                       Vec3d up, Quatd headRotation) const {
  RINGLET_ASSERT(points.size() == particleCount(), "one point per particle of the groom");
  std::vector<StrandMeasure> measures;
  measures.reserve(strands_.size());
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    auto measured = strands_[s].measure(strandIn(points, metresPerUnit, s), up, headRotation);
    if (!measured) return Error{fmt::format("strand {}: {}", s, measured.error().message)};
    measures.push_back(*measured);
  }
  return measures;
}

std::vector<StrandMeasure> GroomRuler::rest() const {
  std::vector<StrandMeasure> measures;
  for (const StrandRuler& strand : strands_) measures.push_back(strand.rest());
  return measures;
}

Quatd GroomRuler::headRotationOf(std::span<const Vec3f> points, double metresPerUnit) const {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < strands_.size(); ++s)
    roots.push_back(Vec3d(points[firstPoint_[s]]) * metresPerUnit);
  return fitHeadRotation(restRoots_, roots);
}

GroomMeasure GroomRuler::summarize(std::span<const StrandMeasure> measures) const {
  RINGLET_ASSERT(measures.size() == strands_.size(), "one measure per strand");
  GroomMeasure groom;
  groom.strandCount = strandCount();
  groom.particleCount = particleCount();
  for (std::size_t s = 0; s < measures.size(); ++s) {
    groom.curledCount += strands_[s].shape().turns > 0;
    groom.rightHandedCount += measures[s].handedness > 0;
    groom.leftHandedCount += measures[s].handedness < 0;
  }

  auto spread = [&](double StrandMeasure::*member) {
    std::vector<double> values;
    for (const StrandMeasure& measured : measures) values.push_back(measured.*member);
    return spreadOf(values);
  };
  groom.droop = spread(&StrandMeasure::droop);
  groom.relativeDroop = spread(&StrandMeasure::relativeDroop);
  groom.chord = spread(&StrandMeasure::chord);
  groom.chordElongation = spread(&StrandMeasure::chordElongation);
  groom.coreLength = spread(&StrandMeasure::coreLength);
  groom.coreElongation = spread(&StrandMeasure::coreElongation);
  groom.arcDrift = spread(&StrandMeasure::arcDrift);
  groom.maxEdgeStretch = spread(&StrandMeasure::maxEdgeStretch);
  groom.turns = spread(&StrandMeasure::turns);
  groom.winding = spread(&StrandMeasure::winding);
  groom.meanRadius = spread(&StrandMeasure::meanRadius);
  groom.handednessKept = spread(&StrandMeasure::handednessKept);
  groom.tipRotation = spread(&StrandMeasure::tipRotation);

  std::vector<double> turns, radii;
  for (const StrandRuler& strand : strands_) {
    turns.push_back(strand.rest().turns);
    radii.push_back(strand.rest().meanRadius);
  }
  groom.turnsAtRest = spreadOf(turns);
  groom.meanRadiusAtRest = spreadOf(radii);
  return groom;
}

double GroomRuler::meanArcLength() const {
  double sum = 0;
  for (const StrandRuler& strand : strands_) sum += strand.arcLength();
  return sum / static_cast<double>(strands_.size());
}

std::vector<Vec3d> GroomRuler::strandIn(std::span<const Vec3f> points, double metresPerUnit,
                                        std::size_t s) const {
  std::vector<Vec3d> strand;
  strand.reserve(firstPoint_[s + 1] - firstPoint_[s]);
  for (Vec3f p : points.subspan(firstPoint_[s], firstPoint_[s + 1] - firstPoint_[s]))
    strand.push_back(Vec3d(p) * metresPerUnit);
  return strand;
}

}  // namespace ringlet
