// Implements rest/rest_state.h.
#include "ringlet/rest/rest_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/rest/strand_constants.h"

namespace ringlet {
namespace {

// An edge's constants and limit take it for no shorter than this share of the mean: a file's coincident
// points would otherwise be springs of infinite stiffness.
constexpr double kShortestEdge = 0.01;

// Below this share of the damping scale bending can feed on itself through the smoothed curve.
constexpr double kLeastCalmDamping = 0.1;

layout::vec4 packed(Vec3d v, double w) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

// Worst cases over all strands, for the warnings.
struct Extremes {
  std::size_t cappedStrands = 0;
  double smallestCoreShare = 1;
  std::size_t feedingStrands = 0;  // the step is too long for their bending
  double longestCalmStep = 1;      // [s]
  std::size_t overloadedStrands = 0;
  double largestLoad = 0;
  std::size_t largestLoadStrand = 0;
};

// The sizes the strand is cut into: chords, floored lengths, masses.
struct Cut {
  std::vector<Vec3d> points, edges;
  std::vector<double> arcs, edgeLengths, masses;
  StrandConstants constants;

  Cut(std::span<const Vec3f> strand, const Material& material, const Settings& settings) {
    for (Vec3f p : strand) points.push_back(static_cast<Vec3d>(p));
    arcs.resize(points.size() - 1);
    measureArcs(points, arcs);
    constants = strandConstants(points, arcs, material, settings);
    masses.resize(points.size(), settings.integrator == Integrator::paper ? 1.0 : 0.0);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      edges.push_back(points[i + 1] - points[i]);
      edgeLengths.push_back(std::max(length(edges[i]), kShortestEdge * constants.meanEdgeLength));
      if (settings.integrator == Integrator::paper) continue;
      double half = 0.5 * material.lineDensity * std::max(arcs[i], edgeLengths[i]);
      masses[i] += half;
      masses[i + 1] += half;
    }
  }
};

// 1 - mu^2 of the point Jacobi iteration, mu a bound on its spectral radius: by Gershgorin, block row by
// block row.
double jacobiGap(const Cut& cut, std::span<const double> edgeScale, double bendDamping,
                 const Settings& settings) {
  const StrandConstants& c = cut.constants;
  const double T = settings.stepSeconds();
  const double perScale =
      T * (std::max(bendDamping, c.stretchDamping) + T * (c.bendStiffness + c.stretchStiffness));
  double smallestShare = 1;  // of the mass in the block row: 1 - mu
  for (std::size_t i = static_cast<std::size_t>(settings.rootCount); i < cut.points.size(); ++i) {
    double coupling = 0;
    if (i < edgeScale.size()) coupling += edgeScale[i] * perScale;
    if (i > 0) coupling += edgeScale[i - 1] * perScale;
    smallestShare = std::min(smallestShare, cut.masses[i] / (cut.masses[i] + coupling));
  }
  return smallestShare * (2 - smallestShare);
}

// Appends one strand to the state, in device order.
void appendStrand(RestState& state, Extremes& extremes, std::span<const Vec3f> strand, std::size_t groomIndex,
                  const Material& material, const Settings& settings) {
  const Cut cut(strand, material, settings);
  const StrandConstants& c = cut.constants;
  const bool paper = settings.integrator == Integrator::paper;
  const std::size_t n = cut.points.size();
  const double massUnit = paper ? 1.0 : material.lineDensity * c.meanEdgeLength;

  std::vector<double> edgeScale(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) edgeScale[i] = paper ? 1.0 : 1 / cut.edgeLengths[i];

  // The device smooths with the float weights; the rest state must be at rest under exactly those.
  const float bendBeta = static_cast<float>(c.bendBeta), coreBeta = static_cast<float>(c.coreBeta);
  const auto frames = framesBeforeEdges(smoothEdges(cut.edges, bendBeta), cut.edges[0]);
  const auto coreEdges = smoothEdges(cut.edges, coreBeta);

  // Gravity balanced edge by edge, from the tip: edge i carries the weight of all
  // beyond it.
  double load = 0, restCoreLength = 0, massBeyond = 0;
  std::vector<layout::ParticleRest> particles(n);
  particles[n - 1].mass = static_cast<float>(cut.masses[n - 1] / massUnit);
  for (std::size_t i = n - 1; i-- > 0;) {
    massBeyond += cut.masses[i + 1];
    const double stretchStiffness = c.stretchStiffness * edgeScale[i],
                 bendStiffness = c.bendStiffness * edgeScale[i];
    const Vec3d carried = settings.gravity * (settings.gravityPreload * massBeyond);
    const Vec3d direction = normalizedOr(cut.edges[i], Vec3d{});
    const double along = dot(carried, direction);
    const Vec3d across = carried - direction * along;
    const Vec3d target = cut.edges[i] - across / bendStiffness;
    particles[i].target =
        packed(rotate(frames[i].conjugate(), target), length(cut.edges[i]) - along / stretchStiffness);
    particles[i].mass = static_cast<float>(cut.masses[i] / massUnit);
    particles[i].edgeLength = static_cast<float>(cut.edgeLengths[i]);
    particles[i].coreEdgeLength = static_cast<float>(length(coreEdges[i]));
    restCoreLength += length(coreEdges[i]);
    if (static_cast<int>(i) + 1 >= settings.rootCount) {
      load = std::max(load, length(across) / (bendStiffness * cut.edgeLengths[i]));
    }
  }

  // The implicit step damps by T K of itself: take that off, but leave half.
  const double T = settings.stepSeconds();
  const double bendDamping =
      paper ? c.bendDamping : std::max(c.bendDamping - T * c.bendStiffness, c.bendDamping / 2);

  layout::StrandRest rest;
  rest.firstParticle = static_cast<std::uint32_t>(state.points.size());
  rest.particleCount = static_cast<std::uint32_t>(n);
  rest.bendBeta = bendBeta;
  rest.coreBeta = coreBeta;
  rest.stretchStiffness = static_cast<float>(c.stretchStiffness / massUnit);
  rest.stretchDamping = static_cast<float>(c.stretchDamping / massUnit);
  rest.bendStiffness = static_cast<float>(c.bendStiffness / massUnit);
  rest.bendDamping = static_cast<float>(bendDamping / massUnit);
  rest.coreStiffness = static_cast<float>(c.coreStiffness / massUnit);
  rest.coreDamping = static_cast<float>(c.coreDamping / massUnit);
  rest.restCoreLength = static_cast<float>(std::max(restCoreLength, 1e-12));
  rest.jacobiGap = static_cast<float>(jacobiGap(cut, edgeScale, bendDamping, settings));
  rest.firstEdge = packed(cut.edges[0], massUnit);
  for (std::size_t k = 0; k < layout::kMaxRootCount; ++k)
    rest.pins[k] = packed(cut.points[std::min(k, n - 1)], 0);

  state.strands.push_back(rest);
  state.particles.insert(state.particles.end(), particles.begin(), particles.end());
  state.points.insert(state.points.end(), strand.begin(), strand.end());
  state.strandInGroom.push_back(static_cast<std::uint32_t>(groomIndex));

  if (c.coreStiffness < c.coreStiffnessAsked) {
    ++extremes.cappedStrands;
    extremes.smallestCoreShare = std::min(extremes.smallestCoreShare, c.coreStiffness / c.coreStiffnessAsked);
  }
  if (settings.stepSeconds() > c.longestBendStep) ++extremes.feedingStrands;
  extremes.longestCalmStep = std::min({extremes.longestCalmStep, c.longestCoreStep, c.longestBendStep});
  if (load > 0.5) ++extremes.overloadedStrands;
  if (load > extremes.largestLoad) extremes.largestLoad = load, extremes.largestLoadStrand = groomIndex;
}

void addWarnings(RestState& state, const Extremes& extremes, const Material& material,
                 const Settings& settings) {
  const int needed =
      static_cast<int>(std::ceil(1 / (settings.framesPerSecond * extremes.longestCalmStep) - 1e-6));
  if (extremes.cappedStrands > 0) {
    state.warnings.push_back(
        fmt::format("the core spring of {} of {} strands is weakened (to {:.0f} % at least) to stay stable "
                    "at {} steps per frame; "
                    "{} steps per frame give it in full",
                    extremes.cappedStrands, state.strands.size(), 100 * extremes.smallestCoreShare,
                    settings.stepsPerFrame, needed));
  }
  if (extremes.feedingStrands > 0) {
    state.warnings.push_back(fmt::format(
        "{} steps per frame are too few for the bending of {} of {} strands, which may not come to rest; "
        "{} steps per frame are enough, or a softer or more smoothed material",
        settings.stepsPerFrame, extremes.feedingStrands, state.strands.size(), needed));
  }
  if (settings.integrator != Integrator::paper && material.bendDampingRatio < kLeastCalmDamping) {
    state.warnings.push_back(fmt::format("a bend damping ratio of {} may not come to rest; {} and more does",
                                         material.bendDampingRatio, kLeastCalmDamping));
  }
  if (extremes.overloadedStrands > 0) {
    state.warnings.push_back(fmt::format(
        "gravity preload bends the stored shape of {} of {} strands by more than 27 degrees (strand {} most: "
        "load {:.2f}); use a stiffer material or less preload",
        extremes.overloadedStrands, state.strands.size(), extremes.largestLoadStrand, extremes.largestLoad));
  }
}

std::vector<std::uint32_t> deviceOrder(const Groom& groom) {
  std::vector<std::uint32_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return groom.strand(a).size() < groom.strand(b).size();
  });
  return order;
}

std::vector<Vec3f> inMetres(std::span<const Vec3f> strand, double metresPerUnit) {
  std::vector<Vec3f> points;
  for (Vec3f p : strand) points.push_back(static_cast<Vec3f>(static_cast<Vec3d>(p) * metresPerUnit));
  return points;
}

Status checkStrand(std::span<const Vec3f> strand, std::size_t index) {
  if (strand.size() < 2)
    return Error{fmt::format("strand {} has {} particle; a strand needs at least 2", index, strand.size())};
  double total = 0;
  for (std::size_t i = 0; i < strand.size(); ++i) {
    if (!std::isfinite(strand[i].x) || !std::isfinite(strand[i].y) || !std::isfinite(strand[i].z)) {
      return Error{fmt::format("strand {} particle {} is not finite: ({}, {}, {})", index, i, strand[i].x,
                               strand[i].y, strand[i].z)};
    }
    if (i > 0) total += length(static_cast<Vec3d>(strand[i] - strand[i - 1]));
  }
  if (!(total > 1e-6))
    return Error{
        fmt::format("strand {} is {} m long; a strand needs a length of at least 1e-6 m (is the unit right?)",
                    index, total)};
  return {};
}

}  // namespace

Result<RestState> buildRestState(const Groom& groom, const Material& material, const Settings& settings) {
  if (Status status = checkSettings(settings, material); !status) return status.error();
  if (groom.strandCount() == 0) return Error{"the groom has no strands; simulating needs at least one"};
  if (!(groom.metresPerUnit > 0) || !std::isfinite(groom.metresPerUnit)) {
    return Error{fmt::format("metresPerUnit is {}; it must be a positive number", groom.metresPerUnit)};
  }
  RestState state;
  Extremes extremes;
  for (std::uint32_t index : deviceOrder(groom)) {
    const auto strand = inMetres(groom.strand(index), groom.metresPerUnit);
    if (Status status = checkStrand(strand, index); !status) return status.error();
    appendStrand(state, extremes, strand, index, material, settings);
    state.firstInGroom.push_back(groom.firstPoint[index]);
  }
  state.longestCalmStep = extremes.longestCalmStep;
  addWarnings(state, extremes, material, settings);
  return state;
}

Result<int> chooseStepsPerFrame(const Groom& groom, const Material& material, Settings settings) {
  const double longestStep = settings.integrator == Integrator::paper ? 1.0 / 720 : 1.0 / 192;
  const auto stepsOf = [&](double step) {
    return static_cast<int>(std::ceil(1 / (std::max(settings.framesPerSecond, 1e-3) * step) - 1e-6));
  };
  const int fewest = std::clamp(stepsOf(longestStep), 1, static_cast<int>(layout::kMaxStepPoses - 1));
  settings.stepsPerFrame = fewest;
  const auto rest = buildRestState(groom, material, settings);
  if (!rest) return rest.error();
  const int most = std::min(4 * fewest, static_cast<int>(layout::kMaxStepPoses - 1));
  return std::clamp(stepsOf(rest->longestCalmStep), fewest, most);
}

Status checkSettings(const Settings& s, const Material& material) {
  struct Range {
    const char* name;
    double value, low, high;
  };
  const Range ranges[] = {
      {"framesPerSecond", s.framesPerSecond, 1e-3, 1e6},
      {"stepsPerFrame", double(s.stepsPerFrame), 1, double(layout::kMaxStepPoses - 1)},
      {"gravityPreload", s.gravityPreload, 0, 1},
      {"gravity.x", s.gravity.x, -1e4, 1e4},
      {"gravity.y", s.gravity.y, -1e4, 1e4},
      {"gravity.z", s.gravity.z, -1e4, 1e4},
      {"maxStretch", s.maxStretch, 1, 100},
      {"rootCount", double(s.rootCount), 1, double(layout::kMaxRootCount)},
      {"pointIterations", double(s.pointIterations), 1, 60000},
      {"forceLoops", double(s.forceLoops), 1, 1000},
      {"dampingLoops", double(s.dampingLoops), 1, 1000},
  };
  for (const Range& r : ranges) {
    if (!(r.value >= r.low && r.value <= r.high)) {
      return Error{fmt::format("{} is {}; it must be from {} to {}", r.name, r.value, r.low, r.high)};
    }
  }
  return checkMaterial(material);
}

}  // namespace ringlet
