// Implements rest/strand_constants.h.
#include "ringlet/rest/strand_constants.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace ringlet {
namespace {

double smoothingWeight(double l, double alpha) { return alpha > 0 ? -std::expm1(-l / alpha) : 1; }

void setPaperConstants(StrandConstants& c) {
  const PaperMaterial paper;
  c.stretchStiffness = paper.stretchStiffness;
  c.stretchDamping = paper.stretchDamping;
  c.bendStiffness = paper.bendStiffness;
  c.bendDamping = paper.bendDamping;
  c.coreStiffness = c.coreStiffnessAsked = paper.coreStiffness;
  c.coreDamping = paper.coreDamping;
  c.longestCoreStep = c.longestBendStep = std::numeric_limits<double>::infinity();
}

}  // namespace

double smoothingLengthOf(const CurlShape& shape, double arcLength) {
  constexpr double kTiltLeft = 0.3;  // tilt of the smoothed curve at which every trial was calm
  if (shape.turns == 0) return 0.1 * arcLength;
  const double longest =
      0.5 * arcLength;  // a flat ring has no core to follow; the rule would ask for infinity
  if (shape.pitch <= 0) return longest;
  double tilt = 2 * std::numbers::pi * shape.radius / shape.pitch;
  double needed = std::sqrt(std::max(0.0, tilt / kTiltLeft - 1)) / (2 * std::numbers::pi);
  return std::min(longest, shape.turnLength * std::max(0.5, needed));
}

double smoothingLengthOf(const CurlAlong& curl, double arcLength) {
  constexpr double kShareOfCurl = 0.9;
  struct Wanted {
    double smoothingLength = 0, length = 0;
  };
  std::vector<Wanted> wanted;
  double curledLength = 0;
  for (const CurlStretch& stretch : curl.stretches) {
    if (stretch.shape.perversions > 0) continue;
    wanted.push_back({smoothingLengthOf(stretch.shape, arcLength), stretch.length});
    curledLength += stretch.length;
  }
  if (wanted.empty()) return smoothingLengthOf(curl.whole, arcLength);

  std::ranges::sort(wanted, {}, &Wanted::smoothingLength);
  double covered = 0;
  for (const Wanted& stretch : wanted) {
    covered += stretch.length;
    if (covered >= kShareOfCurl * curledLength) return stretch.smoothingLength;
  }
  return wanted.back().smoothingLength;
}

StrandGeometry strandGeometry(std::span<const Vec3d> points, std::span<const double> arcs) {
  StrandGeometry g;
  g.arcLength = std::accumulate(arcs.begin(), arcs.end(), 0.0);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) g.meanEdgeLength += length(points[i + 1] - points[i]);
  g.meanEdgeLength /= static_cast<double>(std::max<std::size_t>(1, arcs.size()));
  const CurlAlong curl = measureCurlAlong(points);
  g.smoothingLength = smoothingLengthOf(curl, g.arcLength);
  g.hasPerversions = curl.whole.perversions > 0;
  return g;
}

StrandConstants strandConstants(const StrandGeometry& geometry, const Material& material,
                                const Settings& settings) {
  StrandConstants c;
  c.arcLength = geometry.arcLength;
  c.meanEdgeLength = geometry.meanEdgeLength;
  const double S = c.arcLength, l = c.meanEdgeLength, T = settings.stepSeconds();

  const double fromShape = geometry.smoothingLength;
  c.bendSmoothingLength = material.bendSmoothingLength.value_or(fromShape);
  c.coreSmoothingLength = material.coreSmoothingLength.value_or(fromShape);
  c.bendBeta = smoothingWeight(l, c.bendSmoothingLength);
  c.coreBeta = smoothingWeight(l, c.coreSmoothingLength);
  if (settings.integrator == Integrator::paper) {
    setPaperConstants(c);
    return c;
  }

  const double lambda = material.lineDensity;
  const double weight = lambda * kStandardGravity * S;
  c.stretchStiffness = material.stretchStiffness * weight;
  c.stretchDamping = material.stretchDampingTime * c.stretchStiffness;

  // B tanh(l / 2 alpha) / l^2 with B = 2 alpha K_b: the angle between an edge and its target grows as coth,
  // because the target lags through the smoothing; without the tanh, finer edges would make a curl stiffer.
  const double bend = material.bendStiffness * weight, alpha = c.bendSmoothingLength;
  c.bendStiffness = alpha > 0 ? 2 * alpha * bend * std::tanh(l / (2 * alpha)) / l : 2 * fromShape * bend / l;
  c.bendDamping = material.bendDampingRatio * S * std::sqrt(bend * lambda);

  // The core is explicit: calm up to T = 4 alpha sqrt(lambda / K_c) (tests/scenes/calm_sweep_test.cpp; at 4.4
  // a soft curl feeds on itself), 3 where the curl changes hand (at 3.5 a soft tight one does). Stiffness is
  // capped accordingly.
  const double coreLength = c.coreSmoothingLength > 0 ? c.coreSmoothingLength : l;
  const double calm = (geometry.hasPerversions ? 3 : 4) * coreLength;
  c.coreStiffnessAsked = material.coreStiffness * weight;
  const double most = material.coreStiffnessProfile.most();
  c.coreStiffness = std::min(c.coreStiffnessAsked, lambda * (calm / T) * (calm / T) / most);
  c.longestCoreStep = calm * std::sqrt(lambda / std::max(c.coreStiffnessAsked * most, 1e-300));
  c.longestBendStep = 3 * (alpha > 0 ? alpha : l) * std::sqrt(lambda / bend);
  c.coreDamping = 4 * material.coreDampingRatio * coreLength * std::sqrt(c.coreStiffness * lambda);
  return c;
}

void setSprings(layout::StrandRest& rest, const StrandConstants& constants, double massUnit) {
  const auto perMass = [&](double x) { return static_cast<float>(x / massUnit); };
  rest.stretchStiffness = perMass(constants.stretchStiffness);
  rest.stretchDamping = perMass(constants.stretchDamping);
  rest.bendStiffness = perMass(constants.bendStiffness);
  rest.bendDamping = perMass(constants.bendDamping);
  rest.coreStiffness = perMass(constants.coreStiffness);
  rest.coreDamping = perMass(constants.coreDamping);
}

}  // namespace ringlet
