// Implements cuts of solver/simulation.h. Each call makes a simulation of the strands that it cuts, whose
// records begin with the last particle that is kept. That particle is pinned and the edge from it void
// (kernels/strand_step.comp, kFalls), so that solvers need not know of strands without a root.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/rest_curve.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {
namespace {

Vec3d vectorOf(const layout::vec3& v) { return {v.x, v.y, v.z}; }

// The rest state of what begins with an edge: its frames and smoothed curves begin there, and shape and
// springs stay.
void beginWith(std::uint32_t edge, const layout::StrandRest& whole, std::span<const Vec3f> points,
               layout::StrandRest& strand, std::span<layout::ParticleRest> particles) {
  std::vector<Vec3d> edges;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    edges.push_back(static_cast<Vec3d>(points[i + 1]) - static_cast<Vec3d>(points[i]));
  const auto rest = std::span<const Vec3d>(edges).subspan(edge);
  if (rest.empty()) return;  // a single particle
  const auto before = framesBeforeEdges(smoothEdges(edges, whole.bendBeta), edges[0]);
  const auto frames = framesBeforeEdges(smoothEdges(rest, whole.bendBeta), rest[0]);
  const auto coreEdges = smoothEdges(rest, whole.coreBeta);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    layout::ParticleRest& particle = particles[edge + i];
    const Vec3d target = rotate(before[edge + i], vectorOf(particle.target));
    particle.target = packed3(rotate(frames[i].conjugate(), target));
    particle.coreEdgeLength = static_cast<float>(length(coreEdges[i]));
  }
  strand.firstEdge = packed3(rest[0]);
}

Result<std::vector<layout::ParticleRest>> particlesOn(const DeviceGroom& groom) {
  std::vector<layout::ParticleRest> all;
  for (const DeviceChunk& chunk : groom.chunks) {
    const auto some = downloadAll<layout::ParticleRest>(*chunk.particles, chunk.part.particleCount());
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  return all;
}

}  // namespace

Material fallenMaterial(Material material) {
  material.gravityFactor = material.inertiaFactor = 1;
  return material;
}

Settings fallenSettings(Settings settings) {
  settings.rootCount = 1;
  settings.teleportDistance = 0;
  settings.sleepSpeed = 0;
  settings.goal = {};
  return settings;
}

Status Simulation::Implementation::checkCuts(std::span<const StrandCut> cuts) const {
  if (settings.integrator != Integrator::jacobi)
    return Error{"hair is cut with the integrator jacobi only; this run has another"};
  if (settings.contacts.on) return Error{"hair with contacts is not cut; turn contacts off"};
  if (!rest.elsewhere.empty() || divided)
    return Error{"hair that is divided among devices is not cut; use one device"};
  std::vector<std::uint32_t> stay(rest.groomStrandCount, 0);  // 0: rigid
  for (std::size_t s = 0; s < rest.strands.size(); ++s)
    stay[rest.strandInGroom[s]] = parts.empty() ? rest.strands[s].particleCount : parts[s].end;
  const auto least = static_cast<std::uint32_t>(std::max(settings.rootCount, 2));
  for (const StrandCut& cut : cuts) {
    if (cut.strand >= stay.size())
      return Error{fmt::format("a cut names strand {}; the groom has {}, numbered from 0", cut.strand,
                               rest.groomStrandCount)};
    std::uint32_t& now = stay[cut.strand];
    if (now == 0) continue;
    if (cut.keep < least || cut.keep >= now)
      return Error{fmt::format("strand {} has {} particles, of which a cut is to keep {}; expected {} to {}",
                               cut.strand, now, cut.keep, least, now - 1)};
    now = cut.keep;
  }
  return {};
}

// Takes over what is known of each strand's part.
void Simulation::Implementation::restrict(std::span<layout::StrandRest> of,
                                          std::span<layout::ParticleRest> particles) const {
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const layout::StrandRest& whole = rest.strands[s];
    const StrandPart& part = parts[s];
    if (part.begin == 0 && part.end == whole.particleCount) continue;
    const auto own = particles.subspan(whole.firstParticle, whole.particleCount);
    if (falls)
      beginWith(part.begin, whole, std::span(rest.points).subspan(whole.firstParticle, part.end), of[s], own);
    const std::uint32_t first = falls ? part.begin - 1 : 0;
    of[s].firstParticle = whole.firstParticle + first;
    of[s].particleCount = part.end - first;
    double core = 0;
    for (std::uint32_t i = part.begin; i + 1 < part.end; ++i) core += own[i].coreEdgeLength;
    of[s].restCoreLength = static_cast<float>(std::max(core, 1e-12));
  }
}

Status Simulation::Implementation::takeParts(std::vector<StrandPart> wanted) {
  auto particles = particlesOn(buffers);
  if (!particles) return particles.error();
  parts = std::move(wanted);
  // Springs as they are: those of a material that has changed too.
  std::vector<layout::StrandRest> own;
  for (const DeviceChunk& chunk : buffers.chunks) {
    auto some = downloadAll<layout::StrandRest>(*chunk.strands, chunk.part.strandCount());
    if (!some) return some.error();
    own.insert(own.end(), some->begin(), some->end());
  }
  for (std::size_t s = 0; s < own.size(); ++s) own[s].firstParticle = rest.strands[s].firstParticle;
  restrict(own, *particles);
  if (Status status = buffers.setConstants(device.gpu(), own, *particles); !status) return status;
  stillness.wake();
  forgetRecordings();
  return bindKernels();
}

Result<FallenHair> Simulation::Implementation::fall(std::span<const StrandCut> cuts,
                                                    const HairState& state) const {
  std::vector<std::uint32_t> strandsCut;
  for (const StrandCut& cut : cuts) strandsCut.push_back(cut.strand);
  std::ranges::sort(strandsCut);
  KernelChoice kernels = choice;
  kernels.part = strandsCut;
  kernels.observer = nullptr;
  kernels.heads = 1;
  kernels.movingRoots = kernels.goals = kernels.taps = kernels.residual = false;
  const auto made = HairAsset::build(device, groomOf(rest), fallenMaterial(asset->material),
                                     fallenSettings(asset->settings), kernels, asset->bodies);
  if (!made) return made.error();
  auto hair = Simulation::create(*made, {.head = head.now,
                                         .oneStepEarlier = head.oneStepEarlier,
                                         .bodies = world.bodies(),
                                         .bodyPlaces = world.places(),
                                         .readsBack = readsBack});
  if (!hair) return hair.error();
  FallenHair fallenHair{std::move(*hair), {}};
  Implementation& self = *fallenHair.hair.self_;
  if (Status set = fallenHair.hair.setSettings(fallenSettings(settings)); !set) return set.error();
  // A material that has changed has other last bits than one that never did.
  if (liveMaterial) {
    if (Status set = self.change(fallenMaterial(material)); !set) return set.error();
  }
  if (choice.fields) {
    if (Status set = fallenHair.hair.setFields(fields.now()); !set) return set.error();
  }
  self.stepsDone = stepsDone, self.stepsBefore = stepsBefore, self.secondsBefore = secondsBefore;
  self.falls = true;
  self.restTurn = head.now.rotation;
  if (Status status = self.makeKernels(); !status) return status.error();
  std::vector<StrandPart> wanted(self.rest.strands.size());
  for (std::size_t s = 0; s < wanted.size(); ++s) {
    const std::uint32_t strand = self.rest.strandInGroom[s];
    const auto own = std::ranges::find(rest.strandInGroom, strand) - rest.strandInGroom.begin();
    const auto cut = std::ranges::find(cuts, strand, &StrandCut::strand);
    wanted[s] = {cut->keep, parts.empty() ? self.rest.strands[s].particleCount
                                          : parts[static_cast<std::size_t>(own)].end};
    fallenHair.runs.push_back({self.rest.firstInGroom[s] + wanted[s].begin, wanted[s].end - wanted[s].begin});
  }
  if (Status status = self.takeParts(std::move(wanted)); !status) return status.error();
  if (Status status = fallenHair.hair.setState(state); !status) return status.error();
  return fallenHair;
}

Status Simulation::cut(std::span<const StrandCut> wanted) {
  Implementation& self = *self_;
  RINGLET_ASSERT(self.lostFrame || self.waited == self.submitted, "cut while frames are in flight");
  if (Status status = self.checkCuts(wanted); !status) return status;
  std::vector<StrandCut> cuts(wanted.begin(), wanted.end());
  std::erase_if(cuts, [&](const StrandCut& cut) {
    return std::ranges::find(self.rest.strandInGroom, cut.strand) == self.rest.strandInGroom.end();
  });
  if (cuts.empty()) return {};
  const auto state = this->state();
  if (!state) return state.error();
  auto fallen = self.fall(cuts, *state);
  if (!fallen) return fallen.error();
  std::vector<StrandPart> kept = self.parts;
  if (kept.empty())
    for (const layout::StrandRest& strand : self.rest.strands) kept.push_back({0, strand.particleCount});
  for (std::size_t s = 0; s < kept.size(); ++s) {
    const auto cut = std::ranges::find(cuts, self.rest.strandInGroom[s], &StrandCut::strand);
    if (cut != cuts.end()) kept[s].end = cut->keep;
  }
  if (Status status = self.takeParts(std::move(kept)); !status) return status;
  self.fallen.push_back(std::move(*fallen));
  return {};
}

}  // namespace ringlet
