// Implements solver/contacts/volume_stage.h.
#include "ringlet/solver/contacts/volume_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "layout/volume.h"
#include "ringlet/gpu/device_buffers.h"

namespace ringlet {
namespace {

// Limit of the grid's cells; hair that extends farther gets larger cells.
constexpr std::uint64_t kMostCells = std::uint64_t{1} << 21;

constexpr std::uint64_t kPerCellBlock = offsetof(layout::VolumeControl, indirectBlocks),
                        kPerNode = offsetof(layout::VolumeControl, indirectNodes),
                        kPerFilled = offsetof(layout::VolumeControl, indirectFilled),
                        kPerReached = offsetof(layout::VolumeControl, indirectReached);

std::uint32_t cellCapacity(std::uint64_t wanted) {
  const std::uint64_t blocks = std::min(wanted + wanted / 500, kMostCells) / layout::kBucketBlock + 1;
  return static_cast<std::uint32_t>(blocks * layout::kBucketBlock);
}

std::vector<layout::VolumeParticle> volumeParticles(const RestState& rest, const Settings& settings,
                                                    const RestVolume& volume) {
  std::vector<layout::VolumeParticle> particles;
  for (std::size_t i = 0; i < volume.firsts.size(); ++i) {
    const layout::StrandRest& strand = rest.strands[volume.strands[i]];
    const std::uint32_t count = volume.counts[i];
    const std::uint32_t pinnedEnd = strand.firstParticle + static_cast<std::uint32_t>(settings.rootCount);
    particles.push_back({.first = volume.firsts[i],
                         .count = count,
                         .present = count,
                         .pinned = std::min(std::max(pinnedEnd, volume.firsts[i]) - volume.firsts[i], count),
                         .mass = volume.masses[i],
                         .ownDensity = volume.ownDensities[i],
                         .inverseMassUnit = 1 / strand.massUnit,
                         .unused = 0});
  }
  return particles;
}

// The state of hair that was just placed: only its densities are known.
std::vector<layout::VolumeState> unknownStates(const std::vector<float>& densities) {
  std::vector<layout::VolumeState> states(densities.size());
  for (std::size_t i = 0; i < states.size(); ++i) states[i].density = densities[i];
  return states;
}

layout::VolumeControl emptyControl() {
  layout::VolumeControl control{};
  for (int axis = 0; axis < 3; ++axis) control.least[axis] = 0x7fffffff, control.greatest[axis] = -0x7fffffff;
  return control;
}

// Numbers per node in the buffer of sums, of rates and of mass (shared/volume_buffers.glsl).
constexpr std::size_t kSumsOfNode = 8, kDensitiesOfNode = 2;

std::uint32_t groupsOf(std::uint64_t particles) {
  return static_cast<std::uint32_t>((particles + kVolumeGroupSize - 1) / kVolumeGroupSize);
}

}  // namespace

std::uint64_t VolumeStage::cellWords() const {
  const std::uint64_t capacity = numbers_.cellCapacity;
  return 5 * capacity + capacity / layout::kBucketBlock + 3 * std::uint64_t{numbers_.count} +
         layout::kCellBins;
}

std::uint64_t VolumeStage::cornerSumBytes() const {
  const std::uint64_t mostFilled = std::min(numbers_.count, numbers_.cellCapacity);
  return mostFilled * layout::kCornerSumsOfCell * sizeof(layout::vec4);
}

std::uint64_t VolumeStage::sumBytes() const {
  const std::uint64_t numbersOfNode = kSumsOfNode + kDensitiesOfNode;
  return isDivided_ ? numbersOfNode * numbers_.cellCapacity * sizeof(std::int32_t) : 0;
}

Result<VolumeStage> VolumeStage::create(gpu::Device& device, const RestState& rest, const Settings& settings,
                                        const RestVolume& volume, const VolumeHair& hair) {
  VolumeStage self;
  self.isDivided_ = hair.isDivided;
  self.largestMass_ = volume.largestMass;
  self.longestStrand_ = volume.longestStrand;
  self.range_ = hair.range;
  self.groom_ = &hair.groom;
  self.poses_ = &hair.poses;
  self.densities_ = volume.densities;
  const std::uint64_t count = volume.firsts.size();
  const std::uint32_t capacity = cellCapacity(volume.cells);
  self.numbers_.count = static_cast<std::uint32_t>(count);
  self.numbers_.cellCapacity = capacity;
  self.numbers_.cell = static_cast<float>(volume.cell);
  self.numbers_.gradient = static_cast<float>(kVolumeGradient);
  self.numbers_.rim = static_cast<float>(kVolumeRim);
  if (groupsOf(count) > device.properties().maxGroupCount) {
    return Error{fmt::format(
        "{} particles that meet as a volume are more than the {} this device takes at once; switch contacts "
        "off, or take a smaller groom",
        count, std::uint64_t{device.properties().maxGroupCount} * kVolumeGroupSize)};
  }
  const std::uint64_t perParticle = sizeof(layout::VolumeParticle) + sizeof(layout::VolumeState) +
                                    sizeof(layout::VolumeBrought) + sizeof(layout::VolumeParcel) +
                                    sizeof(layout::vec4);
  const std::uint64_t needed = count * perParticle + self.cellWords() * sizeof(std::uint32_t) +
                               capacity * sizeof(layout::vec4) + self.cornerSumBytes() + self.sumBytes();
  if (Status status = checkMemory(fmt::format("{} particles as a volume", count), needed,
                                  gpu::availableStorageBytes(device));
      !status)
    return status.error();

  if (Status made = self.makeKernels(device); !made) return made.error();
  if (Status made = self.makeBuffers(device, rest, settings, volume); !made) return made.error();
  if (Status status = self.setSettings(settings); !status) return status.error();
  if (Status status = self.forget(); !status) return status.error();
  for (const auto& kernel : self.kernels_) {
    auto bindings = gpu::Bindings::create(*kernel, self.bufferTable());
    if (!bindings) return bindings.error();
    self.bindings_.push_back(std::move(*bindings));
  }
  return self;
}

Status VolumeStage::makeKernels(gpu::Device& device) {
  const std::uint64_t largest = std::max(
      {groom_->largestTexels(), numbers_.count * sizeof(layout::VolumeState),
       numbers_.cellCapacity * sizeof(layout::vec4), cellWords() * sizeof(std::uint32_t), cornerSumBytes()});
  const bool texels = isSeenAsTexels(device, std::max(largest, kLeastTexelBytes));
  for (std::size_t k = 0; k < kVolumeKernelCount; ++k) {
    const auto description =
        describeVolumeKernel(static_cast<VolumeKernel>(k), texels, !device.properties().isCpu, isDivided_);
    if (!gpu::Kernel::isCompiled(device, description)) newKernels_.push_back(k);
    auto kernel = gpu::Kernel::create(device, description);
    if (!kernel) return kernel.error();
    kernels_.push_back(std::move(*kernel));
  }
  return {};
}

Status VolumeStage::makeBuffers(gpu::Device& device, const RestState& rest, const Settings& settings,
                                const RestVolume& volume) {
  const std::uint64_t count = numbers_.count;
  auto particles = createFilled(device, volumeParticles(rest, settings, volume), "volume particles");
  if (!particles) return particles.error();
  auto states = createFilled(device, unknownStates(volume.densities), "volume states");
  if (!states) return states.error();
  auto brought = createZero(device, count * sizeof(layout::VolumeBrought), "volume brought");
  if (!brought) return brought.error();
  auto sums = gpu::Buffer::create(device, sumBytes(), gpu::BufferKind::stream, "volume sums");
  if (!sums) return sums.error();
  auto located = createZero(device, count * sizeof(layout::vec4), "volume located");
  if (!located) return located.error();
  auto cells = createZero(device, cellWords() * sizeof(std::uint32_t), "volume cells");
  if (!cells) return cells.error();
  auto parcels = createZero(device, count * sizeof(layout::VolumeParcel), "volume parcels");
  if (!parcels) return parcels.error();
  auto nodes = createZero(device, numbers_.cellCapacity * sizeof(layout::vec4), "volume nodes");
  if (!nodes) return nodes.error();
  auto cornerSums =
      gpu::Buffer::create(device, cornerSumBytes(), gpu::BufferKind::storage, "volume corner sums");
  if (!cornerSums) return cornerSums.error();
  auto control = createZero(device, sizeof(layout::VolumeControl), "volume control");
  if (!control) return control.error();
  auto controlRead = gpu::Buffer::create(device, sizeof(layout::VolumeControl), gpu::BufferKind::stream,
                                         "volume control read back");
  if (!controlRead) return controlRead.error();
  auto numbers = createZero(device, sizeof(layout::VolumeNumbers), "volume numbers");
  if (!numbers) return numbers.error();
  buffers_.emplace(Buffers{std::move(*particles), std::move(*states), std::move(*brought), std::move(*cells),
                           std::move(*parcels), std::move(*nodes), std::move(*cornerSums),
                           std::move(*control), std::move(*located), std::move(*sums),
                           std::move(*controlRead), std::move(*numbers)});
  return {};
}

std::uint64_t VolumeStage::bytes() const {
  const Buffers& b = *buffers_;
  return b.particles.bytes() + b.states.bytes() + b.brought.bytes() + b.located.bytes() + b.cells.bytes() +
         b.parcels.bytes() + b.nodes.bytes() + b.cornerSums.bytes() + b.control.bytes() + b.sums.bytes() +
         b.controlRead.bytes() + b.numbers.bytes();
}

gpu::BufferTable VolumeStage::bufferTable() const {
  using namespace layout;
  const auto& [particles, states, brought, cells, parcels, nodes, cornerSums, control, located, sums,
               controlRead, numbers] = *buffers_;
  const DeviceChunk& hair = groom_->chunks[0];
  return {{kBindVolumePositions, hair.positions},
          {kBindVolumeVelocities, hair.velocities},
          {kBindVolumeSolved, hair.solved},
          {kBindVolumePoses, *poses_},
          {kBindVolumeParticles, particles},
          {kBindVolumeStates, states},
          {kBindVolumeBrought, brought},
          {kBindVolumeCells, cells},
          {kBindVolumeParcels, parcels},
          {kBindVolumeNodes, nodes},
          {kBindVolumeAdded, hair.addedByVolume},
          {kBindVolumeCornerSums, cornerSums},
          {kBindVolumeCornerSumTexels, cornerSums},
          {kBindVolumeControl, control},
          {kBindVolumeHalt, groom_->contactControl},
          {kBindVolumeLocated, located},
          {kBindVolumeSums, sums},
          {kBindVolumeNumbers, numbers},
          {kBindVolumeLocatedTexels, located},
          {kBindVolumeCellTexels, cells},
          {kBindVolumePositionTexels, hair.positions},
          {kBindVolumeVelocityTexels, hair.velocities},
          {kBindVolumeSolvedTexels, hair.solved},
          {kBindVolumeParticleTexels, particles},
          {kBindVolumeStateTexels, states},
          {kBindVolumeBroughtTexels, brought},
          {kBindVolumeParcelTexels, parcels},
          {kBindVolumeNodeTexels, nodes},
          {kBindVolumeAddedTexels, hair.addedByVolume}};
}

Status VolumeStage::release(std::span<const std::uint32_t> particles) {
  sorts_.forget();  // so that what is not known any more is left out of the parcels, too
  auto all = downloadAll<layout::VolumeParticle>(buffers_->particles, numbers_.count);
  if (!all) return all.error();
  auto states = downloadAll<layout::VolumeState>(buffers_->states, numbers_.count);
  if (!states) return states.error();
  for (std::size_t i = 0; i < all->size(); ++i) {
    layout::VolumeParticle& each = (*all)[i];
    const auto fallen = std::ranges::lower_bound(particles, each.first);
    const auto past = std::lower_bound(fallen, particles.end(), each.first + each.present);
    if (fallen == past) continue;
    const std::uint32_t present = *fallen - each.first;  // what falls is all that is left beyond a place
    each.mass *= static_cast<float>(present) / static_cast<float>(each.present);
    each.present = present;
    (*states)[i].isKnown = 0;  // its mean is elsewhere now
  }
  if (Status status = buffers_->states.upload(std::as_bytes(std::span(*states))); !status) return status;
  return buffers_->particles.upload(std::as_bytes(std::span(*all)));
}

Status VolumeStage::setSettings(const Settings& settings) {
  const double T = settings.stepSeconds();
  sorts_.setStep(T);
  numbers_.seconds = static_cast<float>(T);
  numbers_.drag = static_cast<float>(settings.contacts.volumeDrag);
  numbers_.stiffness = static_cast<float>(settings.contacts.volumeStiffness);
  numbers_.warmth = static_cast<float>(settings.contacts.volumeWarmth(T));
  numbers_.kept = static_cast<float>(std::exp(-T / settings.contacts.volumeMemorySeconds));
  // A term of the sums is kVolumeUnits at most. Without drag and stiffness there are no terms.
  constexpr auto kUnits = static_cast<double>(layout::kVolumeUnits);
  const double gain = settings.contacts.volumeGain(T);
  const double longest = std::min(settings.maxStretch, kVolumeMostStretch) * longestStrand_;
  numbers_.mostRate = static_cast<float>(range_ * settings.contacts.volumeMostRate(T, longest));
  numbers_.unitsPerMass = static_cast<float>(kUnits / largestMass_);
  numbers_.unitsPerGain = gain > 0 ? static_cast<float>(kUnits / (largestMass_ * gain)) : 0.0f;
  return buffers_->numbers.upload(std::as_bytes(std::span(&numbers_, 1)));
}

layout::VolumeParameters VolumeStage::parameters(Iteration at) const {
  return {at.step, at.isFirst && sorts_.sorts(at.step) ? 1u : 0u};
}
void VolumeStage::dispatch(gpu::CommandList& list, VolumeKernel kernel, Iteration at,
                           std::uint32_t groups) const {
  const auto k = static_cast<std::size_t>(kernel);
  list.dispatch(*kernels_[k], bindings_[k], parameters(at), groups);
}
void VolumeStage::dispatchIndirect(gpu::CommandList& list, VolumeKernel kernel, Iteration at,
                                   std::uint64_t offset) const {
  const auto k = static_cast<std::size_t>(kernel);
  list.dispatchIndirect(*kernels_[k], bindings_[k], parameters(at), buffers_->control, offset);
}

void VolumeStage::recordNothing(gpu::CommandList& list) const {
  for (const std::size_t k : newKernels_) list.dispatchNothing(*kernels_[k], bindings_[k]);
}

void VolumeStage::dispatchParticles(gpu::CommandList& list, VolumeKernel kernel, Iteration at) const {
  const std::uint32_t groups = groupsOf(numbers_.count);
  if (groups > 0) dispatch(list, kernel, at, groups);
}

void VolumeStage::recordBrought(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const {
  pace.beginStage(list, at.isFirst ? "volume_begin" : "volume_bring");
  dispatchParticles(list, at.isFirst ? VolumeKernel::begin : VolumeKernel::bring, at);
  list.endStage();
}

void VolumeStage::recordSort(gpu::CommandList& list, SubmissionPace& pace, std::uint32_t step) const {
  using enum VolumeKernel;
  const Iteration at{step, true};
  pace.beginStage(list, "volume_sort");
  dispatch(list, box, at, 1);
  list.barrier();
  dispatchParticles(list, count, at);
  list.barrier();
  dispatchIndirect(list, scan, at, kPerCellBlock);
  list.barrier();
  dispatchIndirect(list, start, at, kPerCellBlock);
  list.barrier();
  dispatchParticles(list, place, at);
  list.barrier();
  dispatchIndirect(list, rank, at, kPerNode);
  list.barrier();
  dispatchIndirect(list, order, at, kPerNode);
  list.endStage();
}

void VolumeStage::recordSums(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const {
  pace.beginStage(list, "volume_gather");
  dispatchIndirect(list, VolumeKernel::gather, at, kPerFilled);
  list.barrier();
  dispatchIndirect(list, VolumeKernel::nodes, at, isDivided_ ? kPerNode : kPerReached);
  list.endStage();
}

void VolumeStage::recordMeans(gpu::CommandList& list, SubmissionPace& pace, Iteration at) const {
  pace.beginStage(list, "volume_spread");
  if (isDivided_) {
    dispatchIndirect(list, VolumeKernel::mean, at, kPerNode);
    list.barrier();
  }
  dispatchParticles(list, VolumeKernel::spread, at);
  list.endStage();
}

void VolumeStage::recordControl(gpu::CommandList& list) const {
  list.copyBuffer(buffers_->control, buffers_->controlRead, sizeof(layout::VolumeControl));
}
void VolumeStage::recordReach(gpu::CommandList& list) const {
  for (const std::size_t at :
       {offsetof(layout::VolumeControl, least), offsetof(layout::VolumeControl, greatest)})
    list.copyBuffer(buffers_->controlRead, buffers_->control, 3 * sizeof(std::int32_t), at, at);
}

layout::VolumeControl& VolumeStage::hostControl() const {
  return *reinterpret_cast<layout::VolumeControl*>(buffers_->controlRead.mapped().data());
}

std::array<std::int32_t, 6> VolumeStage::reach() const {
  const layout::VolumeControl& c = hostControl();
  return {-c.least[0], -c.least[1], -c.least[2], c.greatest[0], c.greatest[1], c.greatest[2]};
}
void VolumeStage::setReach(const std::array<std::int32_t, 6>& reach) {
  layout::VolumeControl& c = hostControl();
  for (std::size_t axis = 0; axis < 3; ++axis)
    c.least[axis] = -reach[axis], c.greatest[axis] = reach[axis + 3];
}

std::span<std::uint32_t> VolumeStage::sums() {
  auto* all = reinterpret_cast<std::uint32_t*>(buffers_->sums.mapped().data());
  return {all, kSumsOfNode * hostControl().cellCount};
}
std::span<std::uint32_t> VolumeStage::densities() {
  auto* all = reinterpret_cast<std::uint32_t*>(buffers_->sums.mapped().data());
  return {all + kSumsOfNode * numbers_.cellCapacity, kDensitiesOfNode * hostControl().cellCount};
}

Status VolumeStage::forget() {
  sorts_.forget();
  const std::vector<layout::VolumeState> states = unknownStates(densities_);
  if (Status status = buffers_->states.upload(std::as_bytes(std::span(states))); !status) return status;
  const auto before = downloadAll<layout::VolumeControl>(buffers_->control, 1);
  if (!before) return before.error();
  layout::VolumeControl control = emptyControl();
  control.cut = before->front().cut, control.largest = before->front().largest;
  control.largestCell = before->front().largestCell;
  return buffers_->control.upload(std::as_bytes(std::span(&control, 1)));
}

Result<VolumeReach> VolumeStage::reached() const {
  const auto control = downloadAll<layout::VolumeControl>(buffers_->control, 1);
  if (!control) return control.error();
  return VolumeReach{control->front().cut, double{std::bit_cast<float>(control->front().largest)},
                     double{control->front().largestCell} / double{numbers_.cell}};
}

Status VolumeStage::archive(Archive& archive) {
  Buffers& b = *buffers_;
  auto control = downloadAll<layout::VolumeControl>(b.control, 1);
  if (!control) return control.error();
  archive.value(control->front());
  sorts_.archive(archive);
  if (archive.isShort()) return {};
  if (archive.isReading()) {
    if (Status status = b.control.upload(std::as_bytes(std::span(*control))); !status) return status;
  }
  std::vector<gpu::Buffer*> kept{&b.states, &b.parcels, &b.located};
  if (sorts_.isBetweenSorts()) kept.insert(kept.end(), {&b.cells, &b.nodes});
  for (gpu::Buffer* buffer : kept) {
    if (Status status = archiveBuffer(archive, *buffer); !status) return status;
  }
  return {};
}

}  // namespace ringlet
