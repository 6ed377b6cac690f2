// Implements groom/generate_check.h.
#include "ringlet/groom/generate_check.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace ringlet {
namespace {

constexpr std::int64_t kMostParticles = 100'000'000;  // 1.2 GB of points; more is a slip of the keyboard

// A parameter that must be in [low, high], or in (low, high] if it must exceed low.
struct ParameterRange {
  const char* name;
  double value, low, high;
  const char* unit = "";
  bool mustExceedLow = false;
};

Status checkRanges(std::span<const ParameterRange> ranges) {
  for (const ParameterRange& r : ranges) {
    const bool isInside =
        (r.mustExceedLow ? r.value > r.low : r.value >= r.low) && r.value <= r.high;  // false for NaN
    if (isInside) continue;
    return Error{r.mustExceedLow ? fmt::format("{} is {}{}; it must be more than {} and at most {}{}", r.name,
                                               r.value, r.unit, r.low, r.high, r.unit)
                                 : fmt::format("{} is {}{}; it must be between {} and {}{}", r.name, r.value,
                                               r.unit, r.low, r.high, r.unit)};
  }
  return {};
}

Status checkParticleCount(std::int64_t strandCount, int particleCount) {
  if (strandCount * particleCount <= kMostParticles) return {};
  return Error{fmt::format("{} strands of {} particles are {} particles; at most {} can be generated",
                           strandCount, particleCount, strandCount * particleCount, kMostParticles)};
}

Status checkVariation(const Variation& v) {
  const ParameterRange ranges[] = {{"the variation of the curl radius", v.radius, 0, 0.9},
                                   {"the variation of the length", v.length, 0, 0.9},
                                   {"the variation of the phase", v.phase, 0, 1},
                                   {"the share of left-handed strands", v.leftHandedShare, 0, 1}};
  return checkRanges(ranges);
}

Status checkName(const char* what, const std::string& name, const std::string& names) {
  if ((", " + names + ",").find(", " + name + ",") != std::string::npos) return {};
  return Error{fmt::format("the {} is '{}'; it must be one of {}", what, name, names)};
}

Status checkCut(const HairCut& cut) {
  if (Status status = checkName("hairline", cut.hairline, kHairlines); !status) return status;
  if (Status status = checkName("parting", cut.parting, kPartings); !status) return status;
  const ParameterRange ranges[] = {{"the length of the fringe", cut.fringe, 0, 10, " m"},
                                   {"the factor on the length on top", cut.top, 0.05, 10},
                                   {"the factor on the length at the sides", cut.sides, 0.05, 10},
                                   {"the factor on the length behind", cut.back, 0.05, 10},
                                   {"the share of the layers", cut.layers, 0, 0.95},
                                   {"the level of the ends", cut.level.value_or(0), -1, 10, " m"},
                                   {"the share of a straight root", cut.straightRoot, 0, 0.95},
                                   {"the share of clumping", cut.clump, 0, 1}};
  return checkRanges(ranges);
}

}  // namespace

Status checkParameters(const CurlParameters& p) {
  const ParameterRange ranges[] = {{"the curl radius", p.radius, 0, 1, " m", true},
                                   {"the number of turns", p.turns, 0, 1000},
                                   {"the strand length", p.length, 0, 10, " m", true},
                                   {"the number of particles per strand", double(p.particleCount), 2, 65536},
                                   {"the metres per unit", p.metresPerUnit, 1e-6, 1000, " m"}};
  if (Status status = checkRanges(ranges); !status) return status;
  if (p.handedness != 1 && p.handedness != -1) {
    return Error{fmt::format("the handedness is {}; it must be 1 (right) or -1 (left)", p.handedness)};
  }
  if (!std::isfinite(p.phase))
    return Error{fmt::format("the phase is {}; it must be a finite number", p.phase)};
  return {};
}

Status checkParameters(const SwatchParameters& p) {
  if (Status status = checkParameters(p.curl); !status) return status;
  if (Status status = checkVariation(p.variation); !status) return status;
  const ParameterRange ranges[] = {{"the number of columns", double(p.columnCount), 1, 10000},
                                   {"the number of rows", double(p.rowCount), 1, 10000},
                                   {"the spacing of the strands", p.spacing, 0, 10, " m", true}};
  if (Status status = checkRanges(ranges); !status) return status;
  return checkParticleCount(std::int64_t{p.columnCount} * p.rowCount, p.curl.particleCount);
}

Status checkParameters(const HeadParameters& p) {
  if (Status status = checkParameters(p.curl); !status) return status;
  if (Status status = checkVariation(p.variation); !status) return status;
  const ParameterRange ranges[] = {
      {"the number of strands", double(p.strandCount), 1, 1e6},
      {"the number of locks", double(p.lockCount), 0, 10000},
      {"the scalp radius", p.scalpRadius, 2 * p.curl.radius, 10, " m"},
      {"the elevation of the hairline at the brow", p.browElevation, -1.5, 1.5, " rad"},
      {"the elevation of the hairline at the nape", p.napeElevation, -1.5, 1.5, " rad"},
      {"the length over which strands bend over", p.bendLength, 0, 10, " m", true},
      {"the share of the length over which the curl grows", p.rampShare, 0, 1, "", true}};
  if (Status status = checkRanges(ranges); !status) return status;
  if (Status status = checkCut(p.cut); !status) return status;
  return checkParticleCount(p.strandCount, p.curl.particleCount);
}

}  // namespace ringlet
