// Implements solver/hair_asset.h.
#include "ringlet/solver/hair_asset.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "layout/strands.h"
#include "ringlet/rest/rest_part.h"
#include "ringlet/rest/whole_rest.h"
#include "ringlet/solver/hair_asset_implementation.h"
#include "ringlet/solver/part_link.h"
#include "ringlet/solver/plan/dispatch_plan.h"
#include "ringlet/solver/plan/subgroup_choice.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {
namespace {

std::vector<std::uint32_t> particleCounts(const RestState& rest) {
  std::vector<std::uint32_t> counts;
  for (const layout::StrandRest& strand : rest.strands) counts.push_back(strand.particleCount);
  return counts;
}

std::uint64_t lanesOf(std::span<const StrandRange> ranges) {
  std::uint64_t lanes = 0;
  for (const StrandRange& range : ranges) lanes += std::uint64_t{range.end - range.begin} * range.shape.lanes;
  return lanes;
}

// Plans for the whole groom, so that the bits of a strand do not depend on which others are stepped here.
// The first strands are a part's border. There are no ranges if all strands are rigid.
Result<std::vector<StrandRange>> rangesOf(std::span<const std::uint32_t> counts, std::size_t borderCount,
                                          std::span<const std::uint32_t> wholeCounts,
                                          const DeviceLimits& limits, const KernelChoice& choice,
                                          StrandWork work) {
  if (counts.empty()) return std::vector<StrandRange>{};
  const auto whole = planRanges(wholeCounts, limits, choice, work);
  if (!whole) return whole.error();
  std::vector<StrandRange> ranges = rangesOfPart(*whole, counts.first(borderCount));
  for (StrandRange range : rangesOfPart(*whole, counts.subspan(borderCount))) {
    range.begin += static_cast<std::uint32_t>(borderCount);
    range.end += static_cast<std::uint32_t>(borderCount);
    ranges.push_back(range);
  }
  return ranges;
}

// Restricts a groom in parts to what the link's own part knows.
Result<RestHalo> restrictTo(const RestHair& hair, const PartLink& link) {
  const auto partOf = partOfEach(link.parts(), hair.state);
  if (!partOf) return partOf.error();
  RestHalo halo = haloOf(hair.contacts, *partOf, link.own());
  restrictTo(hair, halo);
  return halo;
}

// Without what would be each head's own in a dispatch of many; none of it changes while hair moves.
bool isByItself(const Settings& settings, const KernelChoice& choice, BodyUse bodies) {
  return settings.integrator == Integrator::jacobi && !settings.contacts.on && !settings.air.on &&
         bodies == BodyUse::none && !choice.movingRoots && !choice.forces && !choice.goals &&
         !choice.fields && !choice.taps;
}

}  // namespace

Status checkPart(const Settings& settings, const PartLink* link) {
  if (settings.contacts.on && link == nullptr)
    return Error{
        "a part of hair with contacts needs a link to the others (KernelChoice::link); turn contacts off, or "
        "use one device"};
  if (settings.sleepSpeed > 0)
    return Error{
        "hair that may sleep cannot be divided among devices; set sleep_speed to 0, or use one device"};
  return {};
}

Result<HairAsset> HairAsset::build(const ComputeDevice& device, const Groom& groom, const Material& material,
                                   const Settings& settings, const KernelChoice& choice, BodyUse bodies) {
  if (Status status = device.checkProcess(); !status) return status.error();
  const bool hasBodies = bodies == BodyUse::some;
  if (hasBodies && settings.integrator != Integrator::jacobi) return Error{kBodiesNeedJacobi};
  if (choice.goals && settings.integrator != Integrator::jacobi)
    return Error{"goals need the integrator jacobi; this run has another"};
  if (choice.fields && settings.integrator != Integrator::jacobi)
    return Error{"fields need the integrator jacobi; this run has another"};
  const auto geometry = choice.geometry ? std::span(*choice.geometry) : std::span<const StrandGeometry>();
  auto whole =
      choice.rest ? Result<WholeRest>(*choice.rest) : buildWholeRest(groom, material, settings, geometry);
  if (!whole) return whole.error();
  auto& [rest, contacts, volume] = *whole;
  if (choice.link || !choice.part.empty()) {
    if (Status possible = checkPart(settings, choice.link); !possible) return possible.error();
  }
  std::optional<RestHalo> halo;
  if (contacts && choice.link) {
    auto found = restrictTo({rest, *contacts, volume}, *choice.link);
    if (!found) return found.error();
    halo = std::move(*found);
  } else if (!contacts && !choice.part.empty()) {
    if (Status restricted = restrictTo(rest, choice.part); !restricted) return restricted.error();
  }
  const auto limits = withSubgroupSize(device.limits(), choice.subgroupSize);
  if (!limits) return limits.error();

  auto self = std::make_shared<Implementation>(Implementation{.device = device,
                                                              .material = material,
                                                              .settings = settings,
                                                              .choice = choice,
                                                              .bodies = bodies,
                                                              .limits = *limits,
                                                              .rest = std::move(rest),
                                                              .halo = std::move(halo),
                                                              .contacts = std::move(contacts),
                                                              .volume = std::move(volume)});
  if (settings.goal.on) self->goal = goalOf(groom);
  self->choice.goals = choice.goals || settings.goal.on;
  if (self->choice.goals) self->goalUnits = goalUnits(self->rest, settings.goal.shape);
  self->choice.measured = {};
  self->choice.part = {};
  self->choice.geometry = nullptr;
  self->choice.rest = nullptr;
  const std::vector<std::uint32_t> counts = particleCounts(self->rest);
  self->records = groomRecords(settings, self->choice, self->kinds(), device.gpu().properties().isCpu);
  if (!self->rest.edgeFactors.empty()) self->records.particleRest += sizeof(EdgeFactors);
  const auto chunks = cutForDevice(device.gpu(), counts, self->records, settings, choice);
  if (!chunks) return chunks.error();
  const auto rangesFor = [&](bool amongBodies) -> Result<std::vector<StrandRange>> {
    const auto ranges = rangesOf(std::span(counts).first(hereCount(self->rest)),
                                 self->halo ? self->halo->borderCount : 0, self->rest.wholeCounts, *limits,
                                 choice, strandWork(settings, material, self->kinds(), amongBodies));
    if (!ranges) return ranges.error();
    return cutRanges(*ranges, *chunks);
  };
  auto ranges = rangesFor(hasBodies);
  if (!ranges) return ranges.error();
  self->ranges = std::move(*ranges);
  if (hasBodies && self->kinds().volume && !self->kinds().pairs) {
    auto first = rangesFor(false);
    if (!first) return first.error();
    self->firstRanges = std::move(*first);
  }
  if (choice.heads > 1 && chunks->size() == 1 && isByItself(settings, self->choice, bodies)) {
    auto places = HeadPlaces::create(device.gpu(), chunks->front(), self->records, choice.heads);
    if (!places) return places.error();
    self->places = std::move(*places);
  }
  const std::uint64_t lanes = lanesOf(self->ranges);
  self->groupSize = strandGroupSize(*limits, self->places ? lanes * self->places->headsOfRow() : lanes);
  if (choice.groupSize != 0) {
    const auto asked = askedGroupSize(*limits, choice.groupSize);
    if (!asked) return asked.error();
    self->groupSize = *asked;
  }
  const auto plan = planFrame(self->ranges, *limits, settings, hasBodies ? 1 : 0, self->groupSize);
  if (!plan) return plan.error();  // before anything else is made
  self->framePlaces = FramePlaces::of(self->rest);
  for (const GroomChunk& chunk : *chunks) {
    auto constants = ConstantChunk::create(device.gpu(), self->rest.strands, self->rest.particles,
                                           self->rest.edgeFactors, chunk);
    if (!constants) return constants.error();
    if (!device.gpu().properties().isCpu) {
      auto places = self->framePlaces.onDevice(device.gpu(), chunk);
      if (!places) return places.error();
      constants->framePlaces = std::move(*places);
    }
    self->constants.push_back(std::move(*constants));
  }
  self->rest.particles = {};  // they are on the device
  return HairAsset(std::move(self));
}

std::size_t HairAsset::strandCount() const { return self_->rest.groomStrandCount; }
std::size_t HairAsset::particleCount() const { return self_->rest.groomParticleCount; }
std::size_t HairAsset::rigidStrandCount() const { return self_->rest.rigid.size(); }
const std::vector<std::string>& HairAsset::warnings() const { return self_->rest.warnings; }

}  // namespace ringlet
