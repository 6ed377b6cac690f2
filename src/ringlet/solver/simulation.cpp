// Implements solver/simulation.h, less its frames (simulation_frames.cpp) and kernels
// (simulation_kernels.cpp): what is made at creation, and the ways to and from the hair's state.
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

// Limit of a submission [s]; 0 for a CPU device, which no desktop watches.
double longestSubmission(const KernelChoice& choice, const DeviceLimits& limits) {
  constexpr double kOnGpus = 0.3;
  if (choice.longestSubmissionSeconds > 0) return choice.longestSubmissionSeconds;
  return limits.isCpu ? 0 : kOnGpus;
}

// The strands, with the shifts of their roots beside the head.
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

}  // namespace

Result<Simulation> Simulation::create(const ComputeDevice& device, const Groom& groom,
                                      const Material& material, const Settings& settings,
                                      const InitialState& initial, const KernelChoice& kernel) {
  const BodyUse use = initial.bodies.empty() ? BodyUse::none : BodyUse::some;
  const auto asset = HairAsset::build(device, groom, material, settings, kernel, use);
  return asset ? create(*asset, initial) : asset.error();
}

Result<Simulation> Simulation::create(const HairAsset& asset, const InitialState& initial) {
  const HairAsset::Implementation& constant = *asset.self_;
  const Settings& settings = constant.settings;
  const RestState& rest = constant.rest;
  if (Status status = constant.device.checkProcess(); !status) return status.error();
  gpu::Device& device = constant.device.gpu();
  if (!initial.bodies.empty() && constant.bodies == BodyUse::none) return Error{kBuiltWithoutBodies};
  const DeviceLimits& limits = constant.limits;
  const auto plan = planFrame(constant.ranges, limits, settings, initial.bodies.size(), constant.groupSize);
  if (!plan) return plan.error();  // before anything is made for it

  std::vector<layout::StrandRest> strands = shiftedStrands(rest, initial.rootShifts);
  auto buffers = DeviceGroom::create(device, constant.constants, strands, constant.records, kFramesInFlight,
                                     constant.places.get());
  if (!buffers) return buffers.error();
  auto world = DeviceWorld::create(device, initial.bodies, settings, initial.head, kFramesInFlight);
  if (!world) return world.error();
  if (!initial.bodyPlaces.empty()) {
    RINGLET_ASSERT(initial.bodyPlaces.size() == initial.bodies.size(), "every body has a place");
    world->placeBodies(initial.bodyPlaces);
  }
  auto roots = DeviceRoots::create(device, rest, settings, constant.choice.movingRoots, constant.chunks(),
                                   kFramesInFlight);
  if (!roots) return roots.error();
  auto forces =
      DeviceForces::create(device, rest, constant.choice.forces, constant.chunks(), kFramesInFlight);
  if (!forces) return forces.error();
  auto goals = DeviceGoals::create(device, rest, constant.goalUnits ? &*constant.goalUnits : nullptr,
                                   constant.chunks(), kFramesInFlight);
  if (!goals) return goals.error();
  auto fields = DeviceFields::create(device, {}, settings.stepsPerFrame, kFramesInFlight);
  if (!fields) return fields.error();
  if (constant.goal)
    goals->set(constant.goal->places, strengthsOf(*constant.goal, settings.goal), settings.goal.damping, {});
  RigidHair rigidHair(rest.rigid, rest.groomStrandCount);
  if (!initial.rootShifts.empty()) rigidHair.setRootShifts(initial.rootShifts);
  if (!initial.roots.empty()) {
    roots->place(initial.roots, initial.rootsEarlier);
    rigidHair.placeRoots(initial.roots, initial.rootsEarlier);
  }

  std::unique_ptr<Implementation> self(
      new Implementation{.asset = asset.self_,
                         .device = constant.device,
                         .rest = rest,
                         .choice = constant.choice,
                         .ranges = constant.ranges,
                         .settings = settings,
                         .material = constant.material,
                         .warnings = rest.warnings,
                         .strands = std::move(strands),
                         .readsBack = initial.readsBack,
                         .head = {initial.oneStepEarlier.value_or(initial.head), initial.head},
                         .buffers = std::move(*buffers),
                         .world = std::move(*world),
                         .roots = std::move(*roots),
                         .forces = std::move(*forces),
                         .goals = std::move(*goals),
                         .fields = std::move(*fields),
                         .rigidHair = std::move(rigidHair),
                         .pace = SubmissionPace(longestSubmission(constant.choice, limits)),
                         .strandKernels = {constant.ranges},
                         .firstSolveKernels = {constant.firstRanges}});
  if (Status status = self->placeAtRest(); !status) return status.error();
  if (Status status = self->addContacts(); !status) return status.error();
  if (Status status = self->makeKernels(); !status) return status.error();
  for (std::size_t slot = 0; slot < kFramesInFlight; ++slot) {
    auto made = FrameSlot::create(device, self->buffers, constant.framePlaces,
                                  mostBufferBytes(device, constant.choice), initial.readsBack);
    if (!made) return made.error();
    self->slots.push_back(std::move(*made));
    if (Status status = self->recordSlot(slot); !status) return status.error();
  }
  return Simulation(std::move(self));
}

Status Simulation::Implementation::addContacts() {
  if (!asset->contacts) return {};
  const RestContacts& atRest = *asset->contacts;
  contactReport = {.contactParticles = atRest.particleCount,
                   .pairsUnpruned = atRest.graph.pairsUnpruned,
                   .pairs = atRest.graph.pairs,
                   .volumeStrands = atRest.volume.count};
  if (asset->kinds().pairs) {
    auto stage = ContactStage::create(device.gpu(), rest, settings, atRest, buffers, choice.contactRoom);
    if (!stage) return stage.error();
    contacts = std::move(*stage);
  }
  if (asset->volume) {
    auto stage = VolumeStage::create(device.gpu(), rest, settings, *asset->volume, asset->halo.has_value(),
                                     buffers, choice.volumeRange);
    if (!stage) return stage.error();
    volume = std::move(*stage);
  }
  if (asset->halo) {
    auto made = DividedHair::create(device.gpu(), atRest, *asset->halo, *choice.link, buffers.chunks[0]);
    if (!made) return made.error();
    divided.emplace(std::move(*made));
  }
  return {};
}

// Clears contacts and the volume's displacements, after the hair was moved to another state.
Status Simulation::Implementation::forgetContacts() {
  if (contacts) {
    if (Status status = contacts->forget(); !status) return status;
  }
  return volume ? volume->forget() : Status{};
}

// Access for changes outside a frame; invalidates the positions that were read back.
DeviceGroom& Simulation::Implementation::changed() {
  isReadBack = false;
  return buffers;
}

// Moves all hair rigidly with the head, but for what was cut off, which stays where it is.
Status Simulation::Implementation::carryTo(const HeadPose& end) {
  const Quatd turned = normalized(end.rotation * head.now.rotation.conjugate());
  const bool turns = length(Vec3d{turned.x, turned.y, turned.z}) > 1e-12;
  const HeadHistory before = head;
  head.jump(end);
  if (!turns && pieces.empty()) return {};
  if (Status status = forgetContacts(); !status) return status;
  const std::vector<std::uint32_t> fallen = fallenParticles();
  const double T = settings.stepSeconds();
  const auto carry = [&](DeviceGroom::Field field, Vec3d change) {
    std::uint32_t i = 0;
    std::size_t next = 0;
    return changed().changeEach(field, [&](layout::vec4 value) {
      const auto v = static_cast<Vec3d>(unpacked(value));
      const bool falls = next < fallen.size() && fallen[next] == i;
      ++i;
      if (!falls) return packed(turns ? rotate(turned, v) : v);
      ++next;
      return packed(v - change);
    });
  };
  if (Status status = carry(&DeviceChunk::positions, head.now.position - before.now.position); !status)
    return status;
  return carry(&DeviceChunk::velocities, head.velocity(T) - before.velocity(T));
}

// Sets the rest pose, carried by the head and the roots and moving with them.
Status Simulation::Implementation::placeAtRest() {
  const auto nowAt = [&](std::size_t s) {
    return carriedBy(head.now.rotation, roots.areMoving() ? roots.now(s) : BodyPose{});
  };
  const auto earlierAt = [&](std::size_t s) {
    return carriedBy(head.oneStepEarlier.rotation, roots.areMoving() ? roots.oneStepEarlier(s) : BodyPose{});
  };
  const auto placedBy = [](const BodyPose& pose, Vec3d p) {
    return pose.position + rotate(pose.rotation, p);
  };
  GroomPlaces places(rest);
  const auto positionAt = [&](std::size_t i) {
    return packed(placedBy(nowAt(places.strandOf(i)), static_cast<Vec3d>(rest.points[i])));
  };
  if (Status status = changed().uploadEach(&DeviceChunk::positions, positionAt); !status) return status;
  places = GroomPlaces(rest);
  const auto velocityAt = [&](std::size_t i) {
    const std::size_t s = places.strandOf(i);
    const Vec3d p = static_cast<Vec3d>(rest.points[i]);
    return packed((placedBy(nowAt(s), p) - placedBy(earlierAt(s), p)) / settings.stepSeconds());
  };
  return changed().uploadEach(&DeviceChunk::velocities, velocityAt);
}

Simulation::Simulation(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<std::vector<Vec3f>> Simulation::Implementation::inGroomOrder(DeviceGroom::Field field) const {
  std::vector<Vec3f> values(rest.groomParticleCount);
  GroomPlaces place(rest);
  const auto take = [&](std::size_t i, layout::vec4 value) { values[place(i)] = unpacked(value); };
  if (Status status = buffers.downloadEach(field, take); !status) return status.error();
  return values;
}

std::vector<Vec3f> Simulation::Implementation::positionsOf(const FrameSlot& slot) const {
  std::vector<Vec3f> all(rest.groomParticleCount);
  slot.copyPositions(rest, asset->framePlaces, rigidHair, all);
  return all;
}

Result<std::vector<Vec3f>> Simulation::positions() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  const RigidHair& rigid = self_->rigidHair;
  Result<std::vector<Vec3f>> values = std::vector<Vec3f>();
  if (self_->isReadBack) {
    values = self_->positionsOf(self_->slotOf(self_->submitted - 1));
  } else {
    values = self_->inGroomOrder(&DeviceChunk::positions);
    if (!values) return values;
    rigid.scatter(rigid.positions(self_->head.now), *values);
  }
  return values;
}

std::vector<DevicePositions> Simulation::devicePositions() const {
  const std::vector<std::uint32_t> all = groomIndices(self_->rest);
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
  const HeadHistory& head = self_->head;
  self_->rigidHair.scatter(
      self_->rigidHair.velocities(head.now, head.oneStepEarlier, self_->settings.stepSeconds()), *v);
  return HairState{std::move(*p), std::move(*v)};
}

Status Simulation::setState(const HairState& state) {
  const std::size_t count = self_->rest.groomParticleCount;
  RINGLET_ASSERT(state.positions.size() == count && state.velocities.size() == count,
                 "a state has one position and velocity a particle");
  if (Status status = self_->finishFrames(); !status) return status;
  self_->stillness.wake();
  if (Status status = self_->forgetContacts(); !status) return status;
  const auto upload = [&](DeviceGroom::Field field, const std::vector<Vec3f>& values) {
    GroomPlaces place(self_->rest);
    return self_->changed().uploadEach(field, [&](std::size_t i) { return packed(values[place(i)]); });
  };
  if (Status status = upload(&DeviceChunk::positions, state.positions); !status) return status;
  return upload(&DeviceChunk::velocities, state.velocities);
}

Status Simulation::Implementation::archive(Archive& archive) {
  if (Status status = finishFrames(); !status) return status;
  archive.value(head);
  archive.value(stepsDone);
  archive.value(stepsBefore);
  archive.value(secondsBefore);
  for (FallenPiece& piece : pieces) archive.value(piece.restTurn);
  for (FallenChunk& chunk : fallenChunks) {
    if (Status status = archiveBuffer(archive, chunk.reports); !status) return status;
  }
  stillness.archive(archive);
  world.archive(archive);
  roots.archive(archive);
  rigidHair.archive(archive);
  for (DeviceChunk& chunk : buffers.chunks) {
    for (gpu::Buffer* buffer : {&chunk.positions, &chunk.velocities, &chunk.reports}) {
      if (Status status = archiveBuffer(archive, *buffer); !status) return status;
    }
  }
  if (contacts || volume) {
    DeviceChunk& hair = buffers.chunks[0];
    for (gpu::Buffer* buffer : {&hair.contactSystems, &hair.addedByVolume, &hair.solved}) {
      if (Status status = archiveBuffer(archive, *buffer); !status) return status;
    }
  }
  if (volume) {
    if (Status status = volume->archive(archive); !status) return status;
  }
  if (contacts) {
    if (Status status = contacts->archive(archive); !status) return status;
  }
  return {};
}

// Of what a checkpoint of this hair is, now.
CheckpointOwner Simulation::Implementation::checkpointOwner() const {
  std::vector<std::uint32_t> cuts;
  for (const FallenPiece& piece : pieces) cuts.insert(cuts.end(), {piece.strand, piece.begin, piece.end});
  return {asset->fingerprint(), checksum64(std::as_bytes(std::span(cuts))), world.bodyCount()};
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
  self_->forgetFrames();
  return self_->pieces.empty() ? Status{} : self_->renewConstants();
}

const HeadPose& Simulation::head() const { return self_->head.now; }

Result<SimulationReport> Simulation::report() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  const auto reports = self_->buffers.downloadReports();
  if (!reports) return reports.error();
  const auto ofPieces = self_->fallenReports();
  if (!ofPieces) return ofPieces.error();
  SimulationReport total;
  std::uint64_t edges = 0, limited = 0;
  // Of the particles [begin, end) of a strand.
  const auto add = [&](const layout::StrandReport& r, std::size_t s, std::uint32_t begin, std::uint32_t end,
                       std::uint32_t first) {
    edges += end - begin - 1;
    limited += r.limitedEdges;
    total.maxEdgeStretch = std::max<double>(total.maxEdgeStretch, r.maxStretch);
    total.degenerateEdges += r.degenerateEdges;
    total.velocityResidual = std::max<double>(total.velocityResidual, r.velocityResidual);
    total.nonfinite += r.nonfiniteParticles;
    const std::int64_t strand = self_->rest.strandInGroom[s];
    const bool isFirst = total.firstNonfiniteStrand < 0 || strand < total.firstNonfiniteStrand;
    if (r.nonfiniteParticles == 0 || !isFirst) return;
    total.firstNonfiniteStrand = strand;
    total.firstNonfiniteParticle = first + r.firstNonfinite;
  };
  for (std::size_t s = 0; s < hereCount(self_->rest); ++s) add((*reports)[s], s, 0, self_->keptOf(s), 0);
  for (std::size_t k = 0; k < self_->pieces.size(); ++k) {
    const FallenPiece& piece = self_->pieces[k];
    add((*ofPieces)[k], piece.strand, piece.begin, piece.end, piece.begin - 1);
  }
  const double edgeSteps = static_cast<double>(edges) * static_cast<double>(self_->stepsDone);
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

Result<std::vector<BufferContent>> Simulation::bufferContents() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  std::map<std::string, const gpu::Buffer*> buffers;
  const auto add = [&](const gpu::BufferTable& table, const std::string& ending) {
    for (const auto& [binding, buffer] : table)
      if (buffer.get().bytes() > 0) buffers.try_emplace(buffer.get().name() + ending, &buffer.get());
  };
  for (std::size_t chunk = 0; chunk < self_->buffers.chunks.size(); ++chunk)
    add(self_->bufferTable(chunk), chunk > 0 ? fmt::format("_{}", chunk) : "");
  if (self_->contacts) add(self_->contacts->bufferTable(), "");
  if (self_->volume) add(self_->volume->bufferTable(), "");
  std::vector<BufferContent> contents;
  for (const auto& [name, buffer] : buffers) {
    std::vector<std::byte> bytes(buffer->bytes());
    if (Status read = buffer->download(bytes); !read) return read.error();
    contents.push_back({name, std::move(bytes)});
  }
  return contents;
}

Result<ContactReport> Simulation::contactReport() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  ContactReport report = self_->contactReport;
  if (!self_->contacts && !self_->volume) return report;
  if (self_->contacts) {
    report.listedSides = self_->contacts->listedSides();
    const auto sides = self_->contacts->contactSides();
    if (!sides) return sides.error();
    report.contactSides = *sides;
    report.rebuilds = self_->contacts->rebuilds();
    report.pairTests = self_->contacts->pairTests();
  }
  if (self_->volume) {
    const auto reached = self_->volume->reached();
    if (!reached) return reached.error();
    report.volumeCut = reached->cut, report.volumeLargest = reached->largest;
    report.volumeCoarsest = reached->coarsest;
  }
  const auto momentum = contactMomentum(self_->buffers.chunks[0], self_->rest, self_->contactKinds());
  if (!momentum) return momentum.error();
  report.momentum = *momentum;
  report.derive();
  return report;
}

Result<std::vector<ListedContact>> Simulation::listedContacts() const {
  if (!self_->contacts) return std::vector<ListedContact>{};
  if (Status status = self_->finishFrames(); !status) return status.error();
  return self_->contacts->listed(self_->rest);
}

std::size_t Simulation::rigidStrandCount() const { return self_->rigidHair.strandCount(); }
const std::vector<std::string>& Simulation::warnings() const { return self_->warnings; }
std::map<std::string, double> Simulation::stageMilliseconds() const {
  std::map<std::string, double> all = self_->stageMilliseconds;
  return all;
}

std::vector<StageSpan> Simulation::frameStages() const {
  const gpu::Recorder& recorder = self_->waitedSlot().recorder;
  std::vector<StageSpan> spans;
  for (std::size_t i = 0; i < recorder.stageStarts().size(); ++i) {
    const auto& [stage, milliseconds] = recorder.stageMilliseconds()[i];
    spans.push_back({stage, recorder.stageStarts()[i], milliseconds});
  }
  return spans;
}

HostMilliseconds Simulation::hostMilliseconds() const { return self_->hostMilliseconds; }

Result<std::vector<std::array<float, 4>>> Simulation::tap(std::uint32_t field) const {
  RINGLET_ASSERT(self_->choice.taps && field < layout::kTapCount,
                 "taps are written only with KernelChoice::taps");
  if (Status status = self_->finishFrames(); !status) return status.error();
  std::vector<std::array<float, 4>> values(self_->rest.groomParticleCount);
  GroomPlaces place(self_->rest);
  const auto take = [&](std::size_t i, layout::vec4 v) { values[place(i)] = {v.x, v.y, v.z, v.w}; };
  if (Status status = self_->buffers.downloadEach(&DeviceChunk::taps, take, field); !status)
    return status.error();
  return values;
}

DeviceMemory Simulation::memory() const {
  const Implementation& s = *self_;
  DeviceMemory memory;
  memory.particles = s.buffers.particleBytes() + s.forces.bytes() + s.goals.bytes();
  memory.strands = s.buffers.strandBytes();
  memory.shared = s.buffers.sharedBytes();
  memory.rootPoses = s.roots.bytes();
  if (s.contacts) memory.contacts = s.contacts->bytes(), memory.contactLists = s.contacts->listBytes();
  if (s.volume) memory.volume = s.volume->bytes();
  memory.world =
      s.buffers.poses.bytes() + s.buffers.contactControl.bytes() + s.world.bytes() + s.fields.bytes();
  memory.frames = s.buffers.poses.writtenBytes() + s.world.writtenBytes() + s.roots.writtenBytes() +
                  s.forces.writtenBytes() + s.goals.writtenBytes() + s.fields.writtenBytes();
  for (const FrameSlot& slot : s.slots) memory.frames += slot.bytes();
  if (s.divided) memory.frames += s.divided->bytes();
  for (const FallenChunk& chunk : s.fallenChunks)
    memory.strands += chunk.strands.bytes() + chunk.reports.bytes();
  return memory;
}

std::vector<std::string> Simulation::recordedFrame() const {
  return self_->slotOf(std::max<std::uint64_t>(self_->submitted, 1) - 1).recorder.recorded();
}

}  // namespace ringlet
