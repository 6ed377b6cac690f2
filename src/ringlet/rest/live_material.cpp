// Implements rest/live_material.h.
#include "ringlet/rest/live_material.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "layout/strands.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/rest/material_extremes.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/rest_part.h"

namespace ringlet {
namespace {

// All strands of the groom in the order of the rest state; rigid strands are inserted by their length.
std::vector<std::uint32_t> orderOf(const RestState& rest, const Groom& groom) {
  std::vector<std::uint32_t> order = rest.strandInGroom;
  for (const auto* others : {&rest.rigid, &rest.elsewhere})
    for (const RigidStrand& strand : *others) order.push_back(strand.strandInGroom);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t s) { return groom.strand(s).size(); });
  return order;
}

StrandGeometry geometryOf(std::span<const Vec3f> strand) {
  std::vector<Vec3d> points;
  for (const Vec3f p : strand) points.push_back(static_cast<Vec3d>(p));
  std::vector<double> arcs(points.size() - 1);
  measureArcs(points, arcs);
  return strandGeometry(points, arcs);
}

layout::vec3 minus(const layout::vec3& a, const layout::vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

}  // namespace

std::string fixedDifference(const Material& a, const Material& b) {
  if (a.lineDensity != b.lineDensity) return "line_density";
  if (a.bendSmoothingLength != b.bendSmoothingLength) return "bend_smoothing_length";
  if (a.coreSmoothingLength != b.coreSmoothingLength) return "core_smoothing_length";
  for (const ProfileParameter& profile : profileParameters())
    if (!(a.*profile.member == b.*profile.member)) return std::string("profile.") + profile.key;
  if (!(a.factors == b.factors)) return "map";
  return "";
}

Result<LiveMaterial> LiveMaterial::create(const RestState& rest, const Material& material,
                                          const Settings& settings) {
  const Groom groom = groomOf(rest);
  const std::vector<std::uint32_t> order = orderOf(rest, groom);
  auto loaded = buildRestState(groom, material, settings, order);
  if (!loaded) return loaded.error();
  Settings unloaded = settings;
  unloaded.gravityPreload = 0;
  auto base = buildRestState(groom, material, unloaded, order);
  if (!base) return base.error();
  for (RestState* state : {&*loaded, &*base}) {
    if (rest.elsewhere.empty() && rest.haloCount == 0) break;
    std::vector<std::uint32_t> places(state->groomStrandCount), kept;  // device order of the whole groom
    for (std::uint32_t s = 0; s < state->strands.size(); ++s) places[state->strandInGroom[s]] = s;
    for (const std::uint32_t s : rest.strandInGroom) kept.push_back(places[s]);
    const std::size_t here = hereCount(rest);
    keepStrands(*state, std::span(kept).first(here), std::span(kept).subspan(here));
  }

  LiveMaterial self;
  self.settings_ = settings;
  self.lineDensity_ = material.lineDensity;
  self.particles_ = std::move(base->particles);
  for (std::size_t i = 0; i < self.particles_.size(); ++i)
    self.loads_.push_back({minus(self.particles_[i].target, loaded->particles[i].target),
                           self.particles_[i].stretchRestLength - loaded->particles[i].stretchRestLength});
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const std::uint32_t first = rest.strands[s].firstParticle, count = rest.strands[s].particleCount;
    Strand strand{.geometry = geometryOf(std::span(rest.points).subspan(first, count)),
                  .strandInGroom = rest.strandInGroom[s],
                  .firstParticle = first,
                  .particleCount = count};
    strand.built =
        strandConstants(strand.geometry, materialOfStrand(material, strand.strandInGroom), settings);
    for (std::uint32_t i = first; i + 1 < first + count; ++i) {
      const layout::vec3& load = self.loads_[i].bend;
      const double across = std::hypot(load.x, load.y, load.z) / self.particles_[i].edgeLength;
      if (static_cast<int>(i - first) + 1 >= settings.rootCount) strand.load = std::max(strand.load, across);
      strand.stiffest = std::max<double>(i == first ? 0 : strand.stiffest, self.particles_[i].bendFactor);
    }
    self.strands_.push_back(strand);
  }
  return self;
}

std::vector<layout::ParticleRest> LiveMaterial::with(const Material& material,
                                                     std::span<layout::StrandRest> strands,
                                                     std::vector<std::string>& warnings) const {
  std::vector<layout::ParticleRest> particles = particles_;
  MaterialExtremes extremes;
  for (std::size_t s = 0; s < strands_.size(); ++s) {
    const Strand& strand = strands_[s];
    const StrandConstants now =
        strandConstants(strand.geometry, materialOfStrand(material, strand.strandInGroom), settings_);
    setSprings(strands[s], now, lineDensity_ * strand.geometry.meanEdgeLength);
    const double softer = strand.built.bendStiffness / now.bendStiffness;
    const auto bend = static_cast<float>(softer);
    const auto stretch = static_cast<float>(strand.built.stretchStiffness / now.stretchStiffness);
    for (std::uint32_t i = strand.firstParticle; i < strand.firstParticle + strand.particleCount; ++i) {
      const Load& load = loads_[i];
      layout::vec3& target = particles[i].target;
      target = minus(target, {bend * load.bend.x, bend * load.bend.y, bend * load.bend.z});
      particles[i].stretchRestLength -= stretch * load.stretch;
    }
    extremes.add(now, strand.stiffest, softer * strand.load, strand.strandInGroom, settings_);
  }
  warnings = extremes.warnings(strands_.size(), material, settings_);
  return particles;
}

}  // namespace ringlet
