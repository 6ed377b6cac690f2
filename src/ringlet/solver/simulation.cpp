// Implements solver/simulation.h, except its frames (simulation_frames.cpp) and kernels
// (simulation_kernels.cpp): creation, and reading and writing the hair's state.
#include "ringlet/solver/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/checksum.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/solver/contacts/contact_momentum.h"
#include "ringlet/solver/plan/groom_chunks.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {
namespace {

// Limit of a submission [s]; 0 for a CPU device, whose work no desktop watches.
double longestSubmission(const KernelChoice& choice, const DeviceLimits& limits) {
  constexpr double kOnGpus = 0.3;
  if (choice.longestSubmissionSeconds > 0) return choice.longestSubmissionSeconds;
  return limits.isCpu ? 0 : kOnGpus;
}

// The constants of the strands, with their roots shifted relative to the head.
std::vector<layout::StrandRest> shiftedStrands(const RestState& rest, std::span<const Vec3d> shifts) {
  if (shifts.empty()) return {};
  RINGLET_ASSERT(shifts.size() == rest.groomStrandCount, "every strand has a root shift");
  std::vector<layout::StrandRest> strands = rest.strands;
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const Vec3f shift = static_cast<Vec3f>(shifts[rest.strandInGroom[s]]);
    layout::RootRest* roots = strands[s].roots;
    roots[0].shift = shift.x, roots[1].shift = shift.y, roots[2].shift = shift.z;
  }
  return strands;
}

// The features that a head uses from its first frame on.
Features usedBy(const InitialState& initial) {
  return {.bodies = !initial.bodies.empty(), .roots = !initial.roots.empty()};
}

}  // namespace

Result<Simulation> Simulation::create(const ComputeDevice& device, const Groom& groom,
                                      const Material& material, const Settings& settings,
                                      const InitialState& initial, const KernelChoice& kernel) {
  KernelChoice choice = kernel;
  choice.features = choice.features | usedBy(initial);
  const auto asset = HairAsset::build(device, groom, material, settings, choice);
  return asset ? create(*asset, initial) : asset.error();
}

Result<Simulation> Simulation::create(const HairAsset& asset, const InitialState& initial) {
  const HairAsset::Implementation& constant = *asset.self_;
  const Settings& settings = constant.settings;
  const RestState& rest = constant.rest;
  if (Status status = constant.device.checkProcess(); !status) return status.error();
  gpu::Device& device = constant.device.gpu();
  const auto featurePlan = constant.plan(constant.choice.features | usedBy(initial));
  if (!featurePlan) return featurePlan.error();
  const DeviceLimits& limits = constant.limits;
  const auto plan =
      planFrame((*featurePlan)->ranges, {limits, (*featurePlan)->groupSize}, settings, initial.bodies.size());
  if (!plan) return plan.error();  // before anything is made for it

  std::vector<layout::StrandRest> strands = shiftedStrands(rest, initial.rootShifts);
  auto buffers = DeviceGroom::create(device, constant.constants, strands, constant.records,
                                     (*featurePlan)->features.any() ? nullptr : constant.places.get());
  if (!buffers) return buffers.error();
  auto inputs = FrameInputs::create(constant.inputSource(**featurePlan, initial, buffers->place));
  if (!inputs) return inputs.error();

  std::unique_ptr<Implementation> self(
      new Implementation{.asset = asset.self_,
                         .featurePlan = *featurePlan,
                         .settings = settings,
                         .material = constant.material,
                         .constants = {.strands = std::move(strands), .warnings = rest.warnings},
                         .buffers = std::move(*buffers),
                         .inputs = std::move(*inputs),
                         .pace = SubmissionPace(longestSubmission(constant.choice, limits))});
  if (Status status = self->placeAtRest(); !status) return status.error();
  if (Status status = self->addContacts(); !status) return status.error();
  if (Status status = self->makeKernels(); !status) return status.error();
  for (std::size_t slot = 0; slot < kFramesInFlight; ++slot) {
    auto made = FrameSlot::create(device, self->buffers, constant.framePlaces,
                                  mostBufferBytes(device, constant.choice), initial.readsBack);
    if (!made) return made.error();
    self->frames.slots.push_back(std::move(*made));
    if (Status status = self->recordSlot(slot); !status) return status.error();
  }
  return Simulation(std::move(self));
}

Status Simulation::Implementation::addContacts() {
  if (!asset->contacts) return {};
  const RestContacts& atRest = *asset->contacts;
  contacts.atRest = {.contactParticles = atRest.particleCount,
                     .pairsUnpruned = atRest.graph.pairsUnpruned,
                     .pairs = atRest.graph.pairs,
                     .volumeStrands = atRest.volume.count};
  if (asset->kinds().pairs) {
    auto stage =
        ContactStage::create(device().gpu(), rest(), settings, atRest, buffers, asset->choice.contactRoom);
    if (!stage) return stage.error();
    contacts.pairs = std::move(*stage);
  }
  if (asset->volume) {
    auto stage = VolumeStage::create(device().gpu(), rest(), settings, *asset->volume,
                                     {.groom = buffers,
                                      .poses = inputs.get<HeadInput>().poses(),
                                      .isDivided = asset->halo.has_value(),
                                      .range = asset->choice.volumeRange});
    if (!stage) return stage.error();
    contacts.volume = std::move(*stage);
  }
  if (settings.contacts.noCrossings) contacts.crossings.emplace(rest(), settings);
  if (asset->halo) {
    auto made =
        DividedHair::create(device().gpu(), atRest, *asset->halo, *asset->choice.link, buffers.chunks[0]);
    if (!made) return made.error();
    contacts.divided.emplace(std::move(*made));
  }
  return {};
}

// Access for changes outside a frame; invalidates the positions that were read back.
DeviceGroom& Simulation::Implementation::changed() {
  frames.isReadBack = false;
  return buffers;
}

InputSource Simulation::Implementation::inputSource() const {
  static const InitialState kNone;
  return asset->inputSource(*featurePlan, kNone, buffers.place);
}

// Moves all hair rigidly with the head, whose pose was `before`. Fallen hair stays where it is.
Status Simulation::Implementation::carry(const HeadHistory& before) {
  const HeadHistory& now = head();
  const Quatd turned = normalized(now.now.rotation * before.now.rotation.conjugate());
  const bool turns = length(Vec3d{turned.x, turned.y, turned.z}) > 1e-12;
  if (!turns && fallen().pieces().empty()) return {};
  if (Status status = contacts.forget(); !status) return status;
  const std::vector<std::uint32_t> ofPieces = fallen().particles();
  const double T = settings.stepSeconds();
  const auto carryEach = [&](DeviceGroom::Field field, Vec3d change) {
    std::uint32_t i = 0;
    std::size_t next = 0;
    return changed().changeEach(field, [&](layout::vec4 value) {
      const auto v = static_cast<Vec3d>(unpacked(value));
      const bool falls = next < ofPieces.size() && ofPieces[next] == i;
      ++i;
      if (!falls) return packed(turns ? rotate(turned, v) : v);
      ++next;
      return packed(v - change);
    });
  };
  if (Status status = carryEach(&DeviceChunk::positions, now.now.position - before.now.position); !status)
    return status;
  return carryEach(&DeviceChunk::velocities, now.velocity(T) - before.velocity(T));
}

// Sets the rest pose at the present poses of head and roots, at rest relative to them.
Status Simulation::Implementation::placeAtRest() {
  const RootsInput& roots = inputs.get<RootsInput>();
  const auto nowAt = [&](std::size_t s) {
    return carriedBy(head().now.rotation, roots.areMoving() ? roots.now(s) : BodyPose{});
  };
  const auto earlierAt = [&](std::size_t s) {
    return carriedBy(head().oneStepEarlier.rotation,
                     roots.areMoving() ? roots.oneStepEarlier(s) : BodyPose{});
  };
  const auto placedBy = [](const BodyPose& pose, Vec3d p) {
    return pose.position + rotate(pose.rotation, p);
  };
  GroomPlaces places(rest());
  const auto positionAt = [&](std::size_t i) {
    return packed(placedBy(nowAt(places.strandOf(i)), static_cast<Vec3d>(rest().points[i])));
  };
  if (Status status = changed().uploadEach(&DeviceChunk::positions, positionAt); !status) return status;
  places = GroomPlaces(rest());
  const auto velocityAt = [&](std::size_t i) {
    const std::size_t s = places.strandOf(i);
    const Vec3d p = static_cast<Vec3d>(rest().points[i]);
    return packed((placedBy(nowAt(s), p) - placedBy(earlierAt(s), p)) / settings.stepSeconds());
  };
  return changed().uploadEach(&DeviceChunk::velocities, velocityAt);
}

Simulation::Simulation(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<std::vector<Vec3f>> Simulation::Implementation::inGroomOrder(DeviceGroom::Field field) const {
  std::vector<Vec3f> values(rest().groomParticleCount);
  GroomPlaces place(rest());
  const auto take = [&](std::size_t i, layout::vec4 value) { values[place(i)] = unpacked(value); };
  if (Status status = buffers.downloadEach(field, take); !status) return status.error();
  return values;
}

std::vector<Vec3f> Simulation::Implementation::positionsOf(const FrameSlot& slot) const {
  std::vector<Vec3f> all(rest().groomParticleCount);
  slot.copyPositions(rest(), asset->framePlaces, inputs.get<RigidHair>(), all);
  return all;
}

Result<std::vector<Vec3f>> Simulation::positions() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  const RigidHair& rigid = self_->inputs.get<RigidHair>();
  Result<std::vector<Vec3f>> values = std::vector<Vec3f>();
  if (self_->frames.isReadBack) {
    values = self_->positionsOf(self_->frames.slotOf(self_->frames.submitted - 1));
  } else {
    values = self_->inGroomOrder(&DeviceChunk::positions);
    if (!values) return values;
    rigid.scatter(rigid.positions(self_->head().now), *values);
  }
  return values;
}

std::vector<DevicePositions> Simulation::devicePositions() const {
  const std::vector<std::uint32_t> all = groomIndices(self_->rest());
  std::vector<DevicePositions> chunks;
  for (const DeviceChunk& chunk : self_->buffers.chunks) {
    const auto begin = all.begin() + chunk.part.particleBegin, end = all.begin() + chunk.part.particleEnd;
    chunks.push_back({reinterpret_cast<void*>(chunk.positions.handle()),
                      chunk.positions.bytes(),
                      {begin, end},
                      &chunk.positions});
  }
  return chunks;
}

Result<HairState> Simulation::state() const {
  auto p = positions();
  if (!p) return p.error();
  auto v = self_->inGroomOrder(&DeviceChunk::velocities);
  if (!v) return v.error();
  const HeadHistory& head = self_->head();
  self_->inputs.get<RigidHair>().scatter(
      self_->inputs.get<RigidHair>().velocities(head.now, head.oneStepEarlier, self_->settings.stepSeconds()),
      *v);
  return HairState{std::move(*p), std::move(*v)};
}

Status Simulation::setState(const HairState& state) {
  const std::size_t count = self_->rest().groomParticleCount;
  RINGLET_ASSERT(state.positions.size() == count && state.velocities.size() == count,
                 "a state has one position and velocity a particle");
  if (Status status = self_->finishFrames(); !status) return status;
  self_->stillness.wake();
  if (Status status = self_->contacts.forget(); !status) return status;
  const auto upload = [&](DeviceGroom::Field field, const std::vector<Vec3f>& values) {
    GroomPlaces place(self_->rest());
    return self_->changed().uploadEach(field, [&](std::size_t i) { return packed(values[place(i)]); });
  };
  if (Status status = upload(&DeviceChunk::positions, state.positions); !status) return status;
  return upload(&DeviceChunk::velocities, state.velocities);
}

Status Simulation::Implementation::archive(Archive& archive) {
  if (Status status = finishFrames(); !status) return status;
  Features features = featurePlan->features;
  archive.value(features);
  if (archive.isReading() && !archive.isShort()) {
    if (Status status = prepare(features); !status) return status;
  }
  clock.archive(archive);
  for (FrameInput* input : inputs.each()) {
    if (Status status = input->archive(archive); !status) return status;
  }
  stillness.archive(archive);
  for (DeviceChunk& chunk : buffers.chunks) {
    for (gpu::Buffer* buffer : {&chunk.positions, &chunk.velocities, &chunk.reports}) {
      if (Status status = archiveBuffer(archive, *buffer); !status) return status;
    }
  }
  if (contacts.kinds().any()) {
    DeviceChunk& hair = buffers.chunks[0];
    for (gpu::Buffer* buffer : {&hair.contactSystems, &hair.addedByVolume, &hair.solved}) {
      if (Status status = archiveBuffer(archive, *buffer); !status) return status;
    }
  }
  return contacts.archive(archive);
}

// The hair, cuts and bodies that a checkpoint made now belongs to.
CheckpointOwner Simulation::Implementation::checkpointOwner() const {
  std::vector<std::uint32_t> cuts;
  for (const FallenPiece& piece : fallen().pieces())
    cuts.insert(cuts.end(), {piece.strand, piece.begin, piece.end});
  return {asset->fingerprint(), checksum64(std::as_bytes(std::span(cuts))), bodyCount()};
}

Result<std::vector<std::byte>> Simulation::checkpoint() {
  Archive archive = Archive::writing();
  archive.room(kCheckpointGuardBytes);
  if (Status status = self_->archive(archive); !status) return status.error();
  std::vector<std::byte> bytes = archive.take();
  guardCheckpoint(bytes, self_->checkpointOwner());
  return bytes;
}

Status Simulation::restore(std::span<const std::byte> checkpoint) {
  const auto state = stateOfCheckpoint(checkpoint, self_->checkpointOwner());
  if (!state) return state.error();
  Archive archive = Archive::reading(*state);
  if (Status status = self_->archive(archive); !status) return status;
  if (!archive.isWhole()) return Error{kForeignCheckpoint};
  self_->frames.forget();
  return self_->fallen().pieces().empty() ? Status{} : self_->renewConstants();
}

const HeadPose& Simulation::head() const { return self_->head().now; }

Result<SimulationReport> Simulation::report() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  const auto reports = self_->buffers.downloadReports();
  if (!reports) return reports.error();
  const auto ofPieces = self_->fallen().reports();
  if (!ofPieces) return ofPieces.error();
  SimulationReport total;
  std::uint64_t edges = 0, limited = 0;
  // Adds the report of particles [begin, end) of strand s, whose record begins with particle `first`.
  const auto add = [&](const layout::StrandReport& r, std::size_t s, std::uint32_t begin, std::uint32_t end,
                       std::uint32_t first) {
    edges += end - begin - 1;
    limited += r.limitedEdges;
    total.maxEdgeStretch = std::max<double>(total.maxEdgeStretch, r.maxStretch);
    total.degenerateEdges += r.degenerateEdges;
    total.velocityResidual = std::max<double>(total.velocityResidual, r.velocityResidual);
    total.nonfinite += r.nonfiniteParticles;
    const std::int64_t strand = self_->rest().strandInGroom[s];
    const bool isFirst = total.firstNonfiniteStrand < 0 || strand < total.firstNonfiniteStrand;
    if (r.nonfiniteParticles == 0 || !isFirst) return;
    total.firstNonfiniteStrand = strand;
    total.firstNonfiniteParticle = first + r.firstNonfinite;
  };
  for (std::size_t s = 0; s < hereCount(self_->rest()); ++s)
    add((*reports)[s], s, 0, self_->fallen().keptOf(s), 0);
  for (std::size_t k = 0; k < self_->fallen().pieces().size(); ++k) {
    const FallenPiece& piece = self_->fallen().pieces()[k];
    add((*ofPieces)[k], piece.strand, piece.begin, piece.end, piece.begin - 1);
  }
  const double edgeSteps = static_cast<double>(edges) * static_cast<double>(self_->clock.steps);
  total.limitedShare = edgeSteps > 0 ? static_cast<double>(limited) / edgeSteps : 0;
  if (total.nonfinite > 0) total.maxEdgeStretch = std::numeric_limits<double>::infinity();
  return total;
}

std::vector<std::string> ContactReport::warnings() const {
  std::vector<std::string> sentences;
  if (volumeCut > 0) {
    sentences.push_back(fmt::format(
        "hair that meets as a volume was held back {} times, at most by a factor of {:.3g}: it moved faster "
        "than {} m/s beside the head, or farther than twice its length. Look for jumps in the motion of the "
        "head and the roots, or have contacts by pairs (contacts.method explicit)",
        volumeCut, volumeLargest, kVolumeMostSpeed));
  }
  if (volumeCoarsest > 1) {
    sentences.push_back(fmt::format(
        "hair that meets as a volume extended over more cells than there is room for, so that cells became "
        "{:.3g} times as large and hair was coupled over as much more. Use a larger contacts.volume_cell, or "
        "look for hair that is far away",
        volumeCoarsest));
  }
  return sentences;
}

Result<ContactReport> Simulation::contactReport() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  auto report = self_->contacts.report();
  if (!report || !self_->contacts.kinds().any()) return report;
  const auto momentum = contactMomentum(self_->buffers.chunks[0], self_->rest(), self_->contacts.kinds());
  if (!momentum) return momentum.error();
  report->momentum = *momentum;
  report->derive();
  return report;
}

const std::vector<std::string>& Simulation::warnings() const { return self_->constants.warnings; }

}  // namespace ringlet
