// Implements rest/rest_state.h.
#include "ringlet/rest/rest_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "ringlet/base/packed.h"
#include "ringlet/rest/material_extremes.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/rest/rigid_strands.h"
#include "ringlet/rest/strand_constants.h"
#include "ringlet/rest/strands_per_part.h"
#include "ringlet/scene/settings_fields.h"

namespace ringlet {
namespace {

// Points farther away [m] are refused: squares of such numbers, and of speeds between them, must be finite
// floats.
constexpr double kFarthest = 1e9;

std::vector<Vec3f> inMetres(std::span<const Vec3f> strand, double metresPerUnit) {
  std::vector<Vec3f> points;
  points.reserve(strand.size());
  for (Vec3f p : strand) points.push_back(static_cast<Vec3f>(static_cast<Vec3d>(p) * metresPerUnit));
  return points;
}

// A strand's points in double, and its edges' arc lengths [m].
struct RestCurve {
  std::vector<Vec3d> points;
  std::vector<double> arcs;

  explicit RestCurve(std::span<const Vec3f> strand) : arcs(strand.size() - 1) {
    for (Vec3f p : strand) points.push_back(static_cast<Vec3d>(p));
    measureArcs(points, arcs);
  }
};

// Shares of the strand's arc length, at the middle of each edge.
std::vector<double> middlesOf(std::span<const double> arcs, double arcLength) {
  std::vector<double> middles;
  double arcBefore = 0;
  for (const double arc : arcs) {
    middles.push_back((arcBefore + arc / 2) / arcLength);
    arcBefore += arc;
  }
  return middles;
}

// The factors of the bend stiffness profile.
std::vector<double> bendFactorsOf(std::span<const double> middles, const Material& material,
                                  const Settings& settings) {
  std::vector<double> factors(middles.size(), 1.0);
  if (settings.integrator == Integrator::paper) return factors;
  for (std::size_t i = 0; i < middles.size(); ++i) factors[i] = material.bendStiffnessProfile.at(middles[i]);
  return factors;
}

// Damping of bend and core scales with the square root of the stiffness, damping of stretch with the
// stiffness.
std::vector<EdgeFactors> edgeFactorsOf(std::span<const double> middles, const Material& material,
                                       const Settings& settings) {
  const EdgeFactors none{{1, 1, 1}, 1, 1, 1, {}};
  std::vector<EdgeFactors> factors(middles.size(), none);
  if (settings.integrator == Integrator::paper) return factors;
  const auto f = [](double x) { return static_cast<float>(x); };
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const double s = middles[i], stretch = material.stretchStiffnessProfile.at(s),
                 bend = material.bendStiffnessProfile.at(s), core = material.coreStiffnessProfile.at(s);
    factors[i].stiffness = {f(stretch), f(bend), f(core)};
    factors[i].stretchDamping = f(stretch * material.stretchDampingTimeProfile.at(s));
    factors[i].bendDamping = f(std::sqrt(bend) * material.bendDampingRatioProfile.at(s));
    factors[i].coreDamping = f(std::sqrt(core) * material.coreDampingRatioProfile.at(s));
  }
  return factors;
}

// The largest factor of the bend stiffness profile on a strand of the groom.
double stiffestOf(const Groom& groom, std::size_t strand, const StrandGeometry& geometry,
                  const Material& material, const Settings& settings) {
  if (material.bendStiffnessProfile.points.empty()) return 1;
  const RestCurve curve(inMetres(groom.strand(strand), groom.metresPerUnit));
  return std::ranges::max(bendFactorsOf(middlesOf(curve.arcs, geometry.arcLength), material, settings));
}

// The discretisation of a strand: chords, edge lengths with a lower bound, masses, factors of the profiles.
struct Cut : RestCurve {
  std::vector<Vec3d> edges;
  std::vector<double> edgeLengths, masses;
  std::vector<double>
      edgeScale;  // the edge's constants are the strand's times this: 1 / length, or 1 for `paper`
  std::vector<double> bendFactors;   // of the bend stiffness profile, at the middle of each edge
  std::vector<EdgeFactors> factors;  // of all profiles, at the same places
  StrandConstants constants;
  double massUnit = 1;  // [kg]

  Cut(std::span<const Vec3f> strand, const StrandGeometry& geometry, const Material& material,
      const Settings& settings)
      : RestCurve(strand), constants(strandConstants(geometry, material, settings)) {
    const bool paper = settings.integrator == Integrator::paper;
    massUnit = paper ? 1.0 : material.lineDensity * constants.meanEdgeLength;
    masses.resize(points.size(), paper ? 1.0 : 0.0);
    const std::vector<double> middles = middlesOf(arcs, constants.arcLength);
    bendFactors = bendFactorsOf(middles, material, settings);
    factors = edgeFactorsOf(middles, material, settings);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      edges.push_back(points[i + 1] - points[i]);
      edgeLengths.push_back(std::max(length(edges[i]), kShortestEdge * constants.meanEdgeLength));
      edgeScale.push_back(paper ? 1.0 : 1 / edgeLengths[i]);
      if (paper) continue;
      const double half = 0.5 * material.lineDensity * material.lineDensityProfile.at(middles[i]) *
                          std::max(arcs[i], edgeLengths[i]);
      masses[i] += half;
      masses[i + 1] += half;
    }
  }

  double bendStiffness(std::size_t edge) const {
    return constants.bendStiffness * bendFactors[edge] * edgeScale[edge];
  }
  double bendDamping(std::size_t edge) const {
    return constants.bendDamping * factors[edge].bendDamping * edgeScale[edge];
  }
  double stretchStiffness(std::size_t edge) const {
    return constants.stretchStiffness * factors[edge].stiffness.x * edgeScale[edge];
  }
  double stretchDamping(std::size_t edge) const {
    return constants.stretchDamping * factors[edge].stretchDamping * edgeScale[edge];
  }
};

// 1 - mu^2 for the point Jacobi iteration, mu being a bound on its spectral radius by Gershgorin's theorem,
// block row by block row.
double jacobiGap(const Cut& cut, const Settings& settings) {
  const double T = settings.stepSeconds();
  std::vector<double> coupling(cut.points.size(), 0.0);
  for (std::size_t i = 0; i < cut.edges.size(); ++i) {
    const double bendStiffness = cut.bendStiffness(i);
    const double damping = cut.bendDamping(i);
    const double bendDamping = std::max(damping - T * bendStiffness, damping / 2);
    const double edge =
        T * (std::max(bendDamping, cut.stretchDamping(i)) + T * (bendStiffness + cut.stretchStiffness(i)));
    coupling[i] += edge;
    coupling[i + 1] += edge;
  }
  double smallestShare = 1;  // share of the mass in a block row: 1 - mu
  for (std::size_t i = static_cast<std::size_t>(settings.rootCount); i < cut.points.size(); ++i) {
    smallestShare = std::min(smallestShare, cut.masses[i] / (cut.masses[i] + coupling[i]));
  }
  return smallestShare * (2 - smallestShare);
}

// Appends the strand's particles, with gravity balanced edge by edge from the tip: edge i carries the weight
// of everything beyond it. `coreEdges`: the smoothed edges of the core spring. Returns the preload's largest
// load.
double appendParticles(RestState& state, const Cut& cut, std::span<const Quatd> frames,
                       std::span<const Vec3d> coreEdges, const Settings& settings) {
  const std::size_t n = cut.points.size();
  std::vector<layout::ParticleRest> particles(n);
  particles[n - 1].mass = static_cast<float>(cut.masses[n - 1] / cut.massUnit);
  double load = 0, massBeyond = 0;
  for (std::size_t i = n - 1; i-- > 0;) {
    massBeyond += cut.masses[i + 1];
    const double stretchStiffness = cut.stretchStiffness(i);
    const double bendStiffness = cut.bendStiffness(i);
    const Vec3d carried = settings.gravity * (settings.gravityPreload * massBeyond);
    const Vec3d direction = normalizedOr(cut.edges[i], Vec3d{});
    const double along = dot(carried, direction);
    const Vec3d across = carried - direction * along;
    const Vec3d target = cut.edges[i] - across / bendStiffness;
    particles[i].target = packed3(rotate(frames[i].conjugate(), target));
    particles[i].stretchRestLength = static_cast<float>(length(cut.edges[i]) - along / stretchStiffness);
    particles[i].mass = static_cast<float>(cut.masses[i] / cut.massUnit);
    particles[i].edgeLength = static_cast<float>(cut.edgeLengths[i]);
    particles[i].coreEdgeLength = static_cast<float>(length(coreEdges[i]));
    particles[i].bendFactor = static_cast<float>(cut.bendFactors[i]);
    if (static_cast<int>(i) + 1 >= settings.rootCount) {
      load = std::max(load, length(across) / (bendStiffness * cut.edgeLengths[i]));
    }
  }
  state.particles.insert(state.particles.end(), particles.begin(), particles.end());
  return load;
}

layout::StrandRest strandRest(const Cut& cut, std::span<const Vec3d> coreEdges, std::size_t firstParticle,
                              const Settings& settings) {
  const StrandConstants& c = cut.constants;
  double restCoreLength = 0;
  for (Vec3d b : coreEdges) restCoreLength += length(b);
  layout::StrandRest rest;
  rest.firstParticle = static_cast<std::uint32_t>(firstParticle);
  rest.particleCount = static_cast<std::uint32_t>(cut.points.size());
  rest.bendBeta = static_cast<float>(c.bendBeta);
  rest.coreBeta = static_cast<float>(c.coreBeta);
  setSprings(rest, c, cut.massUnit);
  rest.restCoreLength = static_cast<float>(std::max(restCoreLength, 1e-12));
  rest.jacobiGap = static_cast<float>(jacobiGap(cut, settings));
  rest.firstEdge = packed3(cut.edges[0]);
  rest.massUnit = static_cast<float>(cut.massUnit);
  for (std::size_t k = 0; k < layout::kMaxRootCount; ++k)
    rest.roots[k] = {packed3(cut.points[std::min(k, cut.points.size() - 1)]), 0};
  return rest;
}

// One of the groom.
struct GroomStrand {
  std::size_t index;
  std::span<const Vec3f> points;  // [m]
  const StrandGeometry& geometry;
};

// Appends one strand to the state, in device order.
void appendStrand(RestState& state, MaterialExtremes& extremes, const GroomStrand& strand,
                  const Material& material, const Settings& settings) {
  const Cut cut(strand.points, strand.geometry, material, settings);
  const StrandConstants& c = cut.constants;
  // The device smooths with float weights, so the rest state must be at rest with exactly these.
  const auto frames = framesBeforeEdges(smoothEdges(cut.edges, static_cast<float>(c.bendBeta)), cut.edges[0]);
  const auto coreEdges = smoothEdges(cut.edges, static_cast<float>(c.coreBeta));
  state.strands.push_back(strandRest(cut, coreEdges, state.points.size(), settings));
  const double load = appendParticles(state, cut, frames, coreEdges, settings);
  state.points.insert(state.points.end(), strand.points.begin(), strand.points.end());
  state.strandInGroom.push_back(static_cast<std::uint32_t>(strand.index));

  if (material.hasEdgeProfiles() && settings.integrator != Integrator::paper) {
    state.edgeFactors.insert(state.edgeFactors.end(), cut.factors.begin(), cut.factors.end());
    state.edgeFactors.push_back(cut.factors.back());  // the last particle has no edge
  }
  const double stiffest = *std::max_element(cut.bendFactors.begin(), cut.bendFactors.end());
  extremes.add(c, stiffest, load, strand.index, settings);
}

// The longest step that resolves the motion [s].
double longestMotionStep(const Settings& settings) {
  return settings.integrator == Integrator::paper ? 1.0 / 720 : 1.0 / 192;
}

std::vector<std::uint32_t> deviceOrder(const Groom& groom) {
  std::vector<std::uint32_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return groom.strand(a).size() < groom.strand(b).size();
  });
  return order;
}

bool isDeviceOrder(std::span<const std::uint32_t> order, const Groom& groom) {
  std::vector<bool> named(groom.strandCount(), false);
  std::size_t longest = 0;
  for (std::uint32_t index : order) {
    if (index >= named.size() || named[index] || groom.strand(index).size() < longest) return false;
    named[index] = true;
    longest = groom.strand(index).size();
  }
  return order.size() == named.size();
}

Status checkGroom(const Groom& groom) {
  if (groom.strandCount() == 0) return Error{"the groom has no strands; simulating needs at least one"};
  if (groom.points.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{fmt::format("the groom has {} particles; {} are the most", groom.points.size(),
                             std::numeric_limits<std::uint32_t>::max())};
  }
  if (!(groom.metresPerUnit > 0) || !std::isfinite(groom.metresPerUnit)) {
    return Error{fmt::format("the groom's unit is {} m; it must be a positive number", groom.metresPerUnit)};
  }
  return {};
}

Status checkStrand(std::span<const Vec3f> strand, std::size_t index, double metresPerUnit) {
  if (strand.size() < 2)
    return Error{fmt::format("strand {} has {} particle; a strand needs at least 2", index, strand.size())};
  for (std::size_t i = 0; i < strand.size(); ++i) {
    const Vec3f p = strand[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{fmt::format("strand {} particle {} is not finite: ({}, {}, {})", index, i, p.x, p.y, p.z)};
    }
    const double away = length(static_cast<Vec3d>(p)) * metresPerUnit;
    if (away > kFarthest) {
      return Error{fmt::format(
          "strand {} particle {} is at ({}, {}, {}), {:.3g} m from the origin; {:.0e} m is the farthest (is "
          "the unit right, or the file broken?)",
          index, i, p.x, p.y, p.z, away, kFarthest)};
    }
  }
  return {};
}

// Checks the strands and returns their sizes, in groom order.
Result<std::vector<StrandSize>> sizesOf(const Groom& groom) {
  std::vector<StrandSize> sizes;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (Status status = checkStrand(groom.strand(s), s, groom.metresPerUnit); !status) return status.error();
    sizes.push_back(sizeOfStrand(inMetres(groom.strand(s), groom.metresPerUnit)));
  }
  if (medianLength(sizes) > kLeastStrandLength) return sizes;
  const auto tooShort =
      std::ranges::find_if(sizes, [](const StrandSize& size) { return !(size.length > kLeastStrandLength); });
  return Error{fmt::format(
      "strand {} is {} m long, and so short are half the strands or more; a strand needs a length of more "
      "than {} m (is the unit right?)",
      tooShort - sizes.begin(), tooShort->length, kLeastStrandLength)};
}

std::vector<StrandGeometry> geometryOf(const Groom& groom, unsigned threadCount) {
  std::vector<StrandGeometry> geometry(groom.strandCount());
  eachInParallel(threadCount, groom.strandCount(), kStrandsPerPart, [&](std::size_t s) {
    const RestCurve curve(inMetres(groom.strand(s), groom.metresPerUnit));
    geometry[s] = strandGeometry(curve.points, curve.arcs);
  });
  return geometry;
}

// Measurements of a groom before its rest state is made; all in groom order.
struct Survey {
  std::vector<StrandSize> sizes;
  std::vector<StrandGeometry> measured;  // measured here, if not known before
  std::span<const StrandGeometry> geometry;
  std::vector<double> longestSteps;  // longest calm step that also resolves the motion; 0: too fine [s]
  std::vector<std::uint32_t> tooFine{}, tooQuick{};
  std::vector<bool> isRigid;   // either of these
  double longestCalmStep = 1;  // over all simulated strands [s]
};

Result<Survey> surveyOf(const Groom& groom, const Material& material, const Settings& settings,
                        std::span<const StrandGeometry> known) {
  if (Status status = checkSettings(settings, material); !status) return status.error();
  if (Status status = checkGroom(groom); !status) return status.error();
  auto sizes = sizesOf(groom);
  if (!sizes) return sizes.error();

  const std::size_t count = groom.strandCount();
  RINGLET_ASSERT(known.empty() || known.size() == count, "the geometry is of this groom");
  Survey survey{.sizes = std::move(*sizes),
                .measured = known.empty() ? geometryOf(groom, coreCount()) : std::vector<StrandGeometry>(),
                .geometry = known,
                .longestSteps = std::vector<double>(count),
                .isRigid = std::vector<bool>(count)};
  if (known.empty()) survey.geometry = survey.measured;
  survey.tooFine = tooFineStrands(survey.sizes, settings.maxStretch);
  for (const std::uint32_t s : survey.tooFine) survey.isRigid[s] = true;
  std::vector<double> calmSteps(count);
  for (std::size_t s = 0; s < count; ++s) {
    if (survey.isRigid[s]) continue;
    const StrandGeometry& geometry = survey.geometry[s];
    const Material own = materialOfStrand(material, s);
    calmSteps[s] = longestCalmStepOf(strandConstants(geometry, own, settings),
                                     stiffestOf(groom, s, geometry, own, settings));
    survey.longestSteps[s] = std::min(calmSteps[s], longestMotionStep(settings));
  }
  survey.tooQuick = tooQuickStrands(survey.sizes, survey.longestSteps, settings.stepSeconds());
  for (const std::uint32_t s : survey.tooQuick) survey.isRigid[s] = true;
  for (std::size_t s = 0; s < count; ++s) {
    if (!survey.isRigid[s]) survey.longestCalmStep = std::min(survey.longestCalmStep, calmSteps[s]);
  }
  return survey;
}

// The rest state of all strands except rigid ones.
RestState assemble(const Groom& groom, const Material& material, const Settings& settings,
                   std::span<const std::uint32_t> order, const Survey& survey, MaterialExtremes& extremes) {
  RestState state;
  // Growing by doubling would need up to half as much memory again.
  state.strands.reserve(groom.strandCount());
  state.particles.reserve(groom.points.size());
  state.points.reserve(groom.points.size());
  for (std::uint32_t index : order) {
    if (survey.isRigid[index]) continue;
    const auto points = inMetres(groom.strand(index), groom.metresPerUnit);
    appendStrand(state, extremes, {index, points, survey.geometry[index]}, materialOfStrand(material, index),
                 settings);
    state.firstInGroom.push_back(groom.firstPoint[index]);
  }
  for (std::uint32_t s = 0; s < groom.strandCount(); ++s) {
    if (survey.isRigid[s])
      state.rigid.push_back({s, groom.firstPoint[s], inMetres(groom.strand(s), groom.metresPerUnit)});
  }
  state.groomStrandCount = groom.strandCount();
  state.groomParticleCount = groom.points.size();
  state.longestCalmStep = survey.longestCalmStep;
  for (const layout::StrandRest& strand : state.strands) state.wholeCounts.push_back(strand.particleCount);
  state.oneSmoothing = std::ranges::all_of(
      state.strands, [](const layout::StrandRest& s) { return s.bendBeta == s.coreBeta; });
  return state;
}

}  // namespace

Groom groomOf(const RestState& state) {
  Groom groom;
  groom.metresPerUnit = 1;
  groom.points.resize(state.groomParticleCount);
  std::vector<std::uint32_t> counts(state.groomStrandCount);
  const auto put = [&](std::uint32_t strand, std::uint32_t first, std::span<const Vec3f> points) {
    counts[strand] = static_cast<std::uint32_t>(points.size());
    std::ranges::copy(points, groom.points.begin() + first);
  };
  for (std::size_t s = 0; s < state.strands.size(); ++s) {
    const layout::StrandRest& strand = state.strands[s];
    put(state.strandInGroom[s], state.firstInGroom[s],
        std::span(state.points).subspan(strand.firstParticle, strand.particleCount));
  }
  for (const auto* others : {&state.rigid, &state.elsewhere})
    for (const RigidStrand& strand : *others) put(strand.strandInGroom, strand.firstInGroom, strand.points);
  groom.firstPoint.assign(1, 0);
  for (const std::uint32_t count : counts) groom.firstPoint.push_back(groom.firstPoint.back() + count);
  return groom;
}

Result<std::vector<StrandGeometry>> measureGeometry(const Groom& groom, unsigned threadCount) {
  if (Status status = checkGroom(groom); !status) return status.error();
  if (const auto sizes = sizesOf(groom); !sizes) return sizes.error();
  return geometryOf(groom, threadCount);
}

Result<RestState> buildRestState(const Groom& groom, const Material& material, const Settings& settings,
                                 std::span<const std::uint32_t> order,
                                 std::span<const StrandGeometry> geometry) {
  const auto survey = surveyOf(groom, material, settings, geometry);
  if (!survey) return survey.error();
  std::vector<std::uint32_t> groomOrder;
  if (order.empty()) order = groomOrder = deviceOrder(groom);
  RINGLET_ASSERT(isDeviceOrder(order, groom), "the order names every strand once, by rising particle count");

  MaterialExtremes extremes;
  RestState state = assemble(groom, material, settings, order, *survey, extremes);
  state.warnings = extremes.warnings(state.strands.size(), material, settings);
  state.materialWarningCount = state.warnings.size();
  for (const auto& warnings :
       {repeatWarnings(survey->sizes), roundingWarnings(survey->sizes, survey->tooFine),
        tooFineWarnings(survey->sizes, survey->tooFine),
        tooQuickWarnings(survey->sizes, survey->tooQuick, survey->longestSteps, settings)})
    state.warnings.insert(state.warnings.end(), warnings.begin(), warnings.end());
  return state;
}

Result<int> chooseStepsPerFrame(const Groom& groom, const Material& material, Settings settings,
                                std::span<const StrandGeometry> geometry) {
  const int most = static_cast<int>(layout::kMaxStepPoses - 1);
  const int fewest = std::clamp(stepsOf(longestMotionStep(settings), settings), 1, most);
  settings.stepsPerFrame = fewest;
  const auto survey = surveyOf(groom, material, settings, geometry);
  if (!survey) return survey.error();
  return std::clamp(stepsOf(survey->longestCalmStep, settings), fewest, std::min(4 * fewest, most));
}

Status checkSettings(const Settings& s, const Material& material) {
  static_assert(kMostStepsPerFrame + 1 == layout::kMaxStepPoses && kMostRoots == layout::kMaxRootCount);
  if (Status status = checkNumbers(s); !status) return status;
  if (s.contacts.on && s.integrator != Integrator::jacobi) {
    return Error{fmt::format(
        "contacts are on with the integrator {}; contacts need jacobi: choose it, or turn contacts off",
        nameOf(s.integrator))};
  }
  if (s.contacts.on && s.contacts.method == ContactMethod::volume && s.contacts.taper == ContactTaper::time) {
    return Error{
        "all hair is to meet as a volume, with a taper in time, which is of pairs: choose contacts auto or "
        "explicit, or the taper distance"};
  }
  if (s.air.on && s.integrator != Integrator::jacobi) {
    return Error{
        fmt::format("the air is on with the integrator {}; air needs jacobi: choose it, or turn the air off",
                    nameOf(s.integrator))};
  }
  if (s.goal.on && s.integrator != Integrator::jacobi) {
    return Error{fmt::format(
        "the goal is on with the integrator {}; a goal needs jacobi: choose it, or turn the goal off",
        nameOf(s.integrator))};
  }
  return checkMaterial(material);
}

}  // namespace ringlet
