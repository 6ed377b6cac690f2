// Implements rest_strand.h.
#include "reference/rest_strand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/equations/bend_spring.h"
#include "reference/equations/frame.h"
#include "reference/equations/smoothing.h"
#include "ringlet/groom/curl_shape.h"

namespace ringlet::reference {
namespace {

// The smoothing length alpha [m] of a curl: half a turn, more for a tightly wound one; a tenth of a straight
// strand.
// At most half the strand: the rule grows without bound as a curl becomes a flat ring, which has no core to
// follow.
double smoothingLengthByRule(const CurlShape& curl, double arcLength) {
  if (curl.turns == 0) return 0.1 * arcLength;
  const double longest = 0.5 * arcLength;
  if (curl.pitch <= 0) return longest;
  const double tilt = 2 * std::numbers::pi * curl.radius / curl.pitch;
  const double calm = std::sqrt(std::max(0.0, tilt / 0.3 - 1)) / (2 * std::numbers::pi);
  return std::min(longest, curl.turnLength * std::max(0.5, calm));
}

// alpha of a whole strand, whose curl may vary: the smallest that serves nine tenths of its curled length,
// turn by turn, perversions aside.
double smoothingLengthByRule(const CurlAlong& curl, double arcLength) {
  std::vector<CurlStretch> curled = curl.stretches;
  std::erase_if(curled, [](const CurlStretch& stretch) { return stretch.shape.perversions > 0; });
  double smallest = 0;
  for (const CurlStretch& candidate : curled) {
    const double alpha = smoothingLengthByRule(candidate.shape, arcLength);
    double served = 0, all = 0;
    for (const CurlStretch& stretch : curled) {
      all += stretch.length;
      if (smoothingLengthByRule(stretch.shape, arcLength) <= alpha) served += stretch.length;
    }
    if (served >= 0.9 * all && (smallest == 0 || alpha < smallest)) smallest = alpha;
  }
  return curled.empty() ? smoothingLengthByRule(curl.whole, arcLength) : smallest;
}

/// The strand's stiffnesses and dampings before they are divided by the edge's length: K [N], C [N s].
struct ContinuumConstants {
  double stretch = 0, stretchDamping = 0;
  double bend = 0, bendDamping = 0;
  double core = 0, coreDamping = 0;
  bool coreIsCapped = false;
};

// From material and strand: `weight` w = lambda g S [N], lengths as in RestStrand [m],
// `ruleLength` alpha by the rule, T [s].
ContinuumConstants continuumConstants(const Material& material, const RestStrand<double>& strand,
                                      double weight, double ruleLength, double stepSeconds) {
  const double lambda = material.lineDensity, l = strand.meanEdgeLength;
  ContinuumConstants constants;

  constants.stretch = material.stretchStiffness * weight;
  constants.stretchDamping = material.stretchDampingTime * constants.stretch;

  // tanh: the target follows smoothed edges, which lag behind the strand.
  const double bend = material.bendStiffness * weight, alphaB = strand.bendSmoothingLength;
  constants.bend =
      alphaB > 0 ? 2 * alphaB * bend * std::tanh(l / (2 * alphaB)) / l : 2 * ruleLength * bend / l;
  constants.bendDamping = material.bendDampingRatio * strand.arcLength * std::sqrt(bend * lambda);

  // The core is explicit: calm up to T = 4 alpha_c sqrt(lambda / K_c), 3 where the curl changes hand. Beyond
  // it, K_c is lowered, everywhere by as much.
  const double alphaC = strand.coreSmoothingLength > 0 ? strand.coreSmoothingLength : l;
  const double calmSteps = strand.changesHand ? 3 : 4;
  const double highestCore =
      lambda * std::pow(calmSteps * alphaC / stepSeconds, 2) / material.coreStiffnessProfile.most();
  constants.core = std::min(material.coreStiffness * weight, highestCore);
  constants.coreIsCapped = material.coreStiffness * weight > highestCore;
  constants.coreDamping = 4 * material.coreDampingRatio * alphaC * std::sqrt(constants.core * lambda);
  return constants;
}

// Fills the constants per edge: K / l_i of a material, or the paper's as printed. `middles`: share of the
// arc length at the middle of each edge, where the profiles are read; bending's and the core's damping go as
// the root of their stiffness, stretch's as its stiffness.
void setEdgeConstants(const Material& material, const PaperMaterial& paper, const Settings& settings,
                      double ruleLength, const Scalars<double>& middles, RestStrand<double>& strand) {
  const std::size_t edgeCount = strand.edgeCount();
  if (settings.integrator == Integrator::paper) {
    strand.stretchStiffness.assign(edgeCount, paper.stretchStiffness);
    strand.stretchDamping.assign(edgeCount, paper.stretchDamping);
    strand.bendStiffness.assign(edgeCount, paper.bendStiffness);
    strand.bendDamping.assign(edgeCount, paper.bendDamping);
    strand.coreStiffness.assign(edgeCount, paper.coreStiffness);
    strand.coreDamping.assign(edgeCount, paper.coreDamping);
    return;
  }
  const double weight = material.lineDensity * kStandardGravity * strand.arcLength;
  const double T = settings.stepSeconds();
  const ContinuumConstants constants = continuumConstants(material, strand, weight, ruleLength, T);
  strand.coreIsCapped = constants.coreIsCapped;
  for (std::size_t i = 0; i < edgeCount; ++i) {
    const double length = strand.edgeLengths[i], s = middles[i];
    const double factor = material.bendStiffnessProfile.at(s),
                 ofStretch = material.stretchStiffnessProfile.at(s),
                 ofCore = material.coreStiffnessProfile.at(s);
    const double bend = constants.bend * factor / length,
                 damping = constants.bendDamping * std::sqrt(factor) *
                           material.bendDampingRatioProfile.at(s) / length;
    strand.stretchStiffness.push_back(constants.stretch * ofStretch / length);
    strand.stretchDamping.push_back(constants.stretchDamping * ofStretch *
                                    material.stretchDampingTimeProfile.at(s) / length);
    strand.bendStiffness.push_back(bend);
    strand.bendDamping.push_back(compensatedBendDamping(damping, bend, T));
    strand.coreStiffness.push_back(constants.core * ofCore / length);
    strand.coreDamping.push_back(constants.coreDamping * std::sqrt(ofCore) *
                                 material.coreDampingRatioProfile.at(s) / length);
  }
}

// Rest lengths of the stretch springs and, returned, targets in the groom's axes, with the share
// `settings.gravityPreload` of gravity balanced edge by edge: edge i carries W_i, the weight of all particles
// beyond it; the part along the edge shortens the stretch spring's rest length, the part across it moves the
// target.
Field<double> setRestSprings(const Settings& settings, RestStrand<double>& strand) {
  const std::size_t edgeCount = strand.edgeCount();
  const Vector3<double> gravity = settings.gravityPreload * toEigen<double>(settings.gravity);
  strand.stretchRestLengths.resize(edgeCount);
  Field<double> targets(edgeCount);
  Vector3<double> weight = Vector3<double>::Zero();
  for (std::size_t i = edgeCount; i-- > 0;) {
    weight += strand.masses[i + 1] * gravity;
    const Vector3<double>& edge = strand.edges[i];
    const Vector3<double> direction = directionOr(edge, Vector3<double>::Zero());
    const double along = weight.dot(direction);
    const Vector3<double> across = weight - along * direction;
    const double stretch = strand.stretchStiffness[i], bend = strand.bendStiffness[i];
    // A spring without stiffness can carry nothing.
    strand.stretchRestLengths[i] = edge.norm() - (stretch > 0 ? along / stretch : 0);
    targets[i] = edge - (bend > 0 ? Vector3<double>(across / bend) : Vector3<double>::Zero());
  }
  return targets;
}

template <class T>
void keepOnly(const StrandPiece& piece, std::size_t count, std::vector<T>& values) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(std::min(piece.begin + count, values.size())),
               values.end());
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(piece.begin));
}

// What is left of the strand, with its springs. What falls feels gravity as it is, and no head.
void keepOnly(const StrandPiece& piece, RestStrand<double>& strand, Field<double>& targets) {
  const std::size_t count = std::min(piece.end, strand.particleCount()) - piece.begin;
  keepOnly(piece, count, strand.points);
  keepOnly(piece, count, strand.masses);
  for (Field<double>* field : {&strand.edges, &targets}) keepOnly(piece, count - 1, *field);
  for (Scalars<double>* values :
       {&strand.edgeLengths, &strand.stretchStiffness, &strand.stretchDamping, &strand.bendStiffness,
        &strand.bendDamping, &strand.coreStiffness, &strand.coreDamping, &strand.stretchRestLengths})
    keepOnly(piece, count - 1, *values);
  if (piece.begin == 0) return;
  strand.rootCount = 0;
  strand.material.gravityFactor = strand.material.inertiaFactor = 1;
}

// What the strand's frames and smoothed curves are at rest, which begin with its first edge.
void setRestFrames(const Field<double>& targets, RestStrand<double>& strand) {
  const std::size_t edgeCount = strand.edgeCount();
  const Vector3<double> start = edgeCount > 0 ? strand.edges[0] : Vector3<double>::Zero();
  Field<double> smoothedEdges, coreEdges;
  std::vector<Rotation<double>> frames;
  smooth(strand.edges, strand.bendSmoothingShare, start, smoothedEdges);
  smooth(strand.edges, strand.coreSmoothingShare, start, coreEdges);
  const Rotation<double> rootFrame = Rotation<double>::Identity();
  transportFrames(rootFrame, start, smoothedEdges, frames);

  strand.coreLength = 0;
  for (const Vector3<double>& b : coreEdges) {
    strand.coreRestLengths.push_back(b.norm());
    strand.coreLength += b.norm();
  }

  for (std::size_t i = 0; i < edgeCount; ++i)
    strand.restTargets.push_back(frameBefore(i, rootFrame, frames).conjugate() * targets[i]);
}

// The rest state in double. `points` in the groom's unit, root first.
RestStrand<double> deriveRestStrand(std::span<const Vec3f> points, double metresPerUnit,
                                    const Material& material, const PaperMaterial& paper,
                                    const Settings& settings, const StrandPiece& piece) {
  RestStrand<double> strand;
  strand.rootCount = static_cast<std::size_t>(settings.rootCount);
  strand.material = material;

  // Metres are rounded to float, as the solver stores them, so that both start from the same curve.
  std::vector<Vec3d> curve;
  for (const Vec3f& point : points) {
    curve.push_back(asStored(static_cast<Vec3d>(point) * metresPerUnit));
    strand.points.push_back(toEigen<double>(curve.back()));
  }
  if (curve.size() < 2) {
    strand.masses.assign(curve.size(), 1.0);
    return strand;
  }
  const std::size_t edgeCount = curve.size() - 1;
  std::vector<double> arcs(edgeCount);
  measureArcs(curve, arcs);
  for (std::size_t i = 0; i < edgeCount; ++i) {
    strand.edges.push_back(strand.points[i + 1] - strand.points[i]);
    strand.arcLength += arcs[i];
    strand.meanEdgeLength += strand.edges[i].norm() / static_cast<double>(edgeCount);
  }

  Scalars<double> middles;
  double arcBefore = 0;
  for (const double arc : arcs) {
    middles.push_back((arcBefore + arc / 2) / strand.arcLength);
    arcBefore += arc;
  }

  // Masses from the arcs of the curve, not the chords: half of each edge to either end.
  strand.masses.assign(edgeCount + 1, 0.0);
  for (std::size_t i = 0; i < edgeCount; ++i) {
    strand.edgeLengths.push_back(std::max(strand.edges[i].norm(), 0.01 * strand.meanEdgeLength));
    const double density = material.lineDensity * material.lineDensityProfile.at(middles[i]);
    const double half = density * std::max(arcs[i], strand.edgeLengths[i]) / 2;
    strand.masses[i] += half;
    strand.masses[i + 1] += half;
  }
  if (settings.integrator == Integrator::paper) strand.masses.assign(edgeCount + 1, 1.0);

  const CurlAlong curl = measureCurlAlong(curve);
  const double ruleLength = smoothingLengthByRule(curl, strand.arcLength);
  strand.changesHand = curl.whole.perversions > 0;
  strand.bendSmoothingLength = material.bendSmoothingLength.value_or(ruleLength);
  strand.coreSmoothingLength = material.coreSmoothingLength.value_or(ruleLength);
  strand.bendSmoothingShare = smoothingShare(strand.meanEdgeLength, strand.bendSmoothingLength);
  strand.coreSmoothingShare = smoothingShare(strand.meanEdgeLength, strand.coreSmoothingLength);

  setEdgeConstants(material, paper, settings, ruleLength, middles, strand);
  Field<double> targets = setRestSprings(settings, strand);
  if (piece.begin > 0 || piece.end < strand.particleCount()) keepOnly(piece, strand, targets);
  setRestFrames(targets, strand);
  return strand;
}

// The same strand with every number rounded to Real.
template <class Real>
RestStrand<Real> castRestStrand(const RestStrand<double>& from) {
  const auto field = [](const Field<double>& values) {
    Field<Real> rounded;
    for (const Vector3<double>& value : values) rounded.push_back(value.cast<Real>());
    return rounded;
  };
  const auto scalars = [](const Scalars<double>& values) {
    Scalars<Real> rounded;
    for (const double value : values) rounded.push_back(static_cast<Real>(value));
    return rounded;
  };
  return {.rootCount = from.rootCount,
          .points = field(from.points),
          .edges = field(from.edges),
          .masses = scalars(from.masses),
          .edgeLengths = scalars(from.edgeLengths),
          .stretchStiffness = scalars(from.stretchStiffness),
          .stretchDamping = scalars(from.stretchDamping),
          .bendStiffness = scalars(from.bendStiffness),
          .bendDamping = scalars(from.bendDamping),
          .coreStiffness = scalars(from.coreStiffness),
          .coreDamping = scalars(from.coreDamping),
          .bendSmoothingShare = static_cast<Real>(from.bendSmoothingShare),
          .coreSmoothingShare = static_cast<Real>(from.coreSmoothingShare),
          .stretchRestLengths = scalars(from.stretchRestLengths),
          .restTargets = field(from.restTargets),
          .coreRestLengths = scalars(from.coreRestLengths),
          .coreLength = static_cast<Real>(from.coreLength),
          .material = from.material,
          .arcLength = from.arcLength,
          .meanEdgeLength = from.meanEdgeLength,
          .bendSmoothingLength = from.bendSmoothingLength,
          .coreSmoothingLength = from.coreSmoothingLength,
          .changesHand = from.changesHand,
          .coreIsCapped = from.coreIsCapped};
}

}  // namespace

template <class Real>
RestStrand<Real> makeRestStrand(std::span<const Vec3f> points, double metresPerUnit, const Material& material,
                                const PaperMaterial& paper, const Settings& settings,
                                const StrandPiece& piece) {
  return castRestStrand<Real>(deriveRestStrand(points, metresPerUnit, material, paper, settings, piece));
}

#define RINGLET_INSTANTIATE(Real)                                                                \
  template RestStrand<Real> makeRestStrand(std::span<const Vec3f> points, double metresPerUnit,  \
                                           const Material& material, const PaperMaterial& paper, \
                                           const Settings& settings, const StrandPiece& piece)
RINGLET_INSTANTIATE(float);
RINGLET_INSTANTIATE(double);
#undef RINGLET_INSTANTIATE

}  // namespace ringlet::reference
