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
#include "ringlet/solver/simulation.h"
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

// Plans for the whole groom, so that the bits of a strand do not depend on which others are stepped here. The
// first borderCount strands are the part's border. There are no ranges if all strands are rigid.
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

// Restricts the rest state of a groom in parts to what the link's own part needs.
Result<RestHalo> restrictTo(const RestHair& hair, const PartLink& link) {
  const auto partOf = partOfEach(link.parts(), hair.state);
  if (!partOf) return partOf.error();
  RestHalo halo = haloOf(hair.contacts, *partOf, link.own());
  restrictTo(hair, halo);
  return halo;
}

// The rest state of the strands that are simulated here.
struct AssetRest {
  RestState state;
  std::optional<RestContacts> contacts;
  std::optional<RestVolume> volume;
  std::optional<RestHalo> halo;
};

Result<AssetRest> restOf(const Groom& groom, const Material& material, const Settings& settings,
                         const KernelChoice& choice) {
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
  return AssetRest{std::move(rest), std::move(contacts), std::move(volume), std::move(halo)};
}

// Whether heads with these settings can share a dispatch: none of the features is on whose data each head
// holds for itself. None of these settings can change while hair moves.
bool isByItself(const Settings& settings, const KernelChoice& choice) {
  return settings.integrator == Integrator::jacobi && !settings.contacts.on && !settings.air.on &&
         !choice.features.any() && !choice.taps;
}

Status checkFeatures(const Features& features, const Settings& settings) {
  if (settings.integrator == Integrator::jacobi) return {};
  if (features.bodies) return Error{kBodiesNeedJacobi};
  if (features.goals) return Error{"goals need the integrator jacobi; this run has another"};
  if (features.fields) return Error{"fields need the integrator jacobi; this run has another"};
  return {};
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
  if (settings.contacts.on && settings.contacts.noCrossings)
    return Error{
        "hair that is kept from going through hair cannot be divided among devices yet; set no_crossings to "
        "false, or use one device"};
  return {};
}

Result<HairAsset> HairAsset::build(const ComputeDevice& device, const Groom& groom, const Material& material,
                                   const Settings& settings, const KernelChoice& choice) {
  if (Status status = device.checkProcess(); !status) return status.error();
  if (Status status = checkFeatures(choice.features, settings); !status) return status.error();
  auto rest = restOf(groom, material, settings, choice);
  if (!rest) return rest.error();
  auto& [state, contacts, volume, halo] = *rest;
  const auto limits = withSubgroupSize(device.limits(), choice.subgroupSize);
  if (!limits) return limits.error();
  auto self = std::make_shared<Implementation>(Implementation{
      .device = device, .material = material, .settings = settings, .choice = choice, .limits = *limits});
  self->plans = std::make_unique<FeaturePlans>();
  self->rest = std::move(state);
  self->halo = std::move(halo);
  self->contacts = std::move(contacts);
  self->volume = std::move(volume);
  self->measured.assign(choice.measured.begin(), choice.measured.end());
  if (settings.goal.on) self->goal = goalOf(groom);
  self->choice.features.goals = choice.features.goals || settings.goal.on;
  self->choice.measured = self->measured;
  self->choice.part = {};
  self->choice.geometry = nullptr;
  self->choice.rest = nullptr;
  self->records = groomRecords(settings, self->choice, self->kinds(), device.gpu().properties().isCpu);
  if (!self->rest.edgeFactors.empty()) self->records.particleRest += sizeof(EdgeFactors);
  auto chunks = cutForDevice(device.gpu(), particleCounts(self->rest), self->records, settings, choice);
  if (!chunks) return chunks.error();
  self->chunks = std::move(*chunks);
  if (choice.heads > 1 && self->chunks.size() == 1 && isByItself(settings, self->choice)) {
    auto places = HeadPlaces::create(device.gpu(), self->chunks.front(), self->records, choice.heads);
    if (!places) return places.error();
    self->places = std::move(*places);
  }
  if (const auto plan = self->plan(self->choice.features); !plan)
    return plan.error();  // before the large buffers are made
  if (Status status = self->makeConstants(); !status) return status.error();
  self->rest.particles = {};  // they are on the device
  return HairAsset(std::move(self));
}

Status HairAsset::Implementation::makeConstants() {
  framePlaces = FramePlaces::of(rest);
  for (const GroomChunk& chunk : chunks) {
    auto made = ConstantChunk::create(device.gpu(), rest.strands, rest.particles, rest.edgeFactors, chunk);
    if (!made) return made.error();
    if (!device.gpu().properties().isCpu) {
      auto onDevice = framePlaces.onDevice(device.gpu(), chunk);
      if (!onDevice) return onDevice.error();
      made->framePlaces = std::move(*onDevice);
    }
    constants.push_back(std::move(*made));
  }
  return {};
}

Result<std::shared_ptr<const FeaturePlan>> HairAsset::Implementation::plan(const Features& features) const {
  const std::lock_guard lock(plans->guard);
  std::shared_ptr<const FeaturePlan>& made = plans->made[features];
  if (made) return made;
  auto plan = makePlan(features);
  if (!plan) return plan.error();
  made = std::make_shared<const FeaturePlan>(std::move(*plan));
  return made;
}

Result<FeaturePlan> HairAsset::Implementation::makePlan(const Features& features) const {
  if (Status status = checkFeatures(features, settings); !status) return status.error();
  FeaturePlan plan{features};
  const std::vector<std::uint32_t> counts = particleCounts(rest);
  const auto rangesFor = [&](bool amongBodies) -> Result<std::vector<StrandRange>> {
    const auto ranges =
        rangesOf(std::span(counts).first(hereCount(rest)), halo ? halo->borderCount : 0, rest.wholeCounts,
                 limits, choice, strandWork(settings, material, kinds(), amongBodies));
    if (!ranges) return ranges.error();
    return cutRanges(*ranges, chunks);
  };
  auto ranges = rangesFor(features.bodies);
  if (!ranges) return ranges.error();
  plan.ranges = std::move(*ranges);
  if (features.bodies && kinds().volume && !kinds().pairs) {
    auto first = rangesFor(false);
    if (!first) return first.error();
    plan.firstRanges = std::move(*first);
  }
  const std::uint64_t lanes = lanesOf(plan.ranges);
  const bool areMany = places && !features.any();
  plan.groupSize = strandGroupSize(limits, areMany ? lanes * places->headsOfRow() : lanes);
  if (choice.groupSize != 0) {
    const auto asked = askedGroupSize(limits, choice.groupSize);
    if (!asked) return asked.error();
    plan.groupSize = *asked;
  }
  const auto frame = planFrame(plan.ranges, {limits, plan.groupSize}, settings, features.bodies ? 1 : 0);
  if (!frame) return frame.error();
  if (!features.goals) return plan;
  if (!rest.particles.empty()) {
    plan.goalUnits = goalUnits(rest.strands, rest.particles, settings.goal.shape);
    return plan;
  }
  const auto particles = particlesOf(constants);
  if (!particles) return particles.error();
  plan.goalUnits = goalUnits(rest.strands, *particles, settings.goal.shape);
  return plan;
}

InputSource HairAsset::Implementation::inputSource(const FeaturePlan& plan, const InitialState& initial,
                                                   const std::optional<HeadPlace>& place) const {
  return {.device = device.gpu(),
          .rest = rest,
          .settings = settings,
          .features = plan.features,
          .chunks = chunks,
          .goal = goal ? &*goal : nullptr,
          .goalUnits = plan.goalUnits,
          .initial = initial,
          .place = place,
          .slots = Simulation::kFramesInFlight};
}

std::size_t HairAsset::strandCount() const { return self_->rest.groomStrandCount; }
std::size_t HairAsset::particleCount() const { return self_->rest.groomParticleCount; }
std::size_t HairAsset::rigidStrandCount() const { return self_->rest.rigid.size(); }
const std::vector<std::string>& HairAsset::warnings() const { return self_->rest.warnings; }

}  // namespace ringlet
