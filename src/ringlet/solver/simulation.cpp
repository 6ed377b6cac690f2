// Implements solver/simulation.h: the frame is one recorded list of dispatches, replayed with new poses.
#include "ringlet/solver/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "ringlet/gpu/kernel.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/strand_order.h"
#include "ringlet/solver/contact_stage.h"
#include "ringlet/solver/device_buffers.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/device_roots.h"
#include "ringlet/solver/device_world.h"
#include "ringlet/solver/dispatch_plan.h"
#include "ringlet/solver/groom_chunks.h"
#include "ringlet/solver/strand_kernels.h"

namespace ringlet {
namespace {

layout::vec4 packed(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
layout::vec4 packed(Vec3f v) { return {v.x, v.y, v.z, 0}; }
layout::vec4 packed(Quatd q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}
Vec3f unpacked(layout::vec4 v) { return {v.x, v.y, v.z}; }

DeviceLimits limitsOf(const gpu::Device& device) {
  const gpu::DeviceProperties& p = device.properties();
  return {p.subgroupSize, p.hasSubgroupShuffle, p.type == "cpu", p.maxGroupCount};
}

// Where the head is and was one outer step before.
struct HeadHistory {
  HeadPose oneStepEarlier, now;

  Vec3d velocity(double T) const { return (now.position - oneStepEarlier.position) / T; }
  Quatd turn() const { return now.rotation * oneStepEarlier.rotation.conjugate(); }
  // To a place elsewhere, as fast and turning as before, seen from the head.
  void jump(const HeadPose& to) {
    const Quatd turned = normalized(to.rotation * now.rotation.conjugate());
    const Vec3d step = rotate(turned, now.position - oneStepEarlier.position);
    const Quatd turn = turned * this->turn() * turned.conjugate();
    now = to;
    oneStepEarlier = {to.position - step, normalized(turn.conjugate() * to.rotation), to.shift};
  }
};

std::string describe(std::span<const StrandRange> ranges, std::uint32_t subgroupSize) {
  std::string text;
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    const StrandRange& range = ranges[r];
    if (r > 0 && range.shape == ranges[r - 1].shape) continue;  // of the next chunk
    text += (text.empty() ? "" : ", ") + range.shape.describe();
  }
  return fmt::format("{} (subgroup {})", text, subgroupSize);
}

// Chunks are as large as storage allows, and as texels do where a device sees as many as the smallest storage
// buffers hold: kernels read those faster. With contacts a strand may meet any other, so all are in one
// chunk.
Result<std::vector<GroomChunk>> cutForDevice(const gpu::Device& device,
                                             std::span<const std::uint32_t> particleCounts,
                                             const GroomRecords& records, const Settings& settings,
                                             const KernelChoice& choice) {
  const gpu::DeviceProperties& p = device.properties();
  std::uint64_t most = std::min({p.maxStorageBufferRange, p.maxAllocationBytes,
                                 std::uint64_t{std::numeric_limits<std::uint32_t>::max()}});
  if (!settings.contacts.on && isSeenAsTexels(device, kLeastTexelBytes))
    most = std::min(most, p.maxTexelRecords * sizeof(layout::vec4));
  if (choice.mostBufferBytes > 0) most = std::min(most, choice.mostBufferBytes);
  auto chunks = cutGroom(particleCounts, records, most,
                         settings.contacts.on ? "contacts"
                         : choice.taps        ? "taps"
                                              : "");
  if (!chunks) return chunks;
  const std::uint64_t bytes =
      chunks->back().particleEnd * records.perParticle() + chunks->back().strandEnd * records.perStrand();
  std::uint64_t available = gpu::availableStorageBytes(device);
  if (choice.mostDeviceBytes > 0) available = std::min(available, choice.mostDeviceBytes);
  const std::string what = fmt::format("a groom of {} strands and {} particles", chunks->back().strandEnd,
                                       chunks->back().particleEnd);
  if (Status status = checkMemory(what, bytes, available); !status) return status.error();
  return chunks;
}

}  // namespace

struct Simulation::Implementation {
  ComputeDevice device;
  RestState rest;
  Settings settings;
  Material material;
  KernelChoice choice;
  HeadHistory head;

  DeviceGroom buffers;
  DeviceWorld world;
  DeviceRoots roots;
  std::vector<StrandRange> ranges;
  std::vector<PlannedDispatch> plan;
  std::vector<gpu::Kernel> kernels{};     // one a shape
  std::vector<std::size_t> kernelOf{};    // each range's
  std::vector<gpu::Bindings> bindings{};  // one a range
  std::optional<gpu::Recorder> frame{};

  std::optional<ContactStage> contacts{};
  ContactReport contactReport{};  // what is known of the rest pose, and sums
  bool isWholeFrame = true;       // the recording is the whole frame, not the rest of one

  std::uint64_t stepsDone = 0;
  std::map<std::string, double> stageMilliseconds{};

  layout::StepParameters parametersOf(const PlannedDispatch& dispatch) const;
  Status recordFrame();
  Status recordContactFrame(std::uint32_t firstStep, bool predictFirst);
  Status recordPass(const SolvePass& pass);
  void dispatchAll(std::span<const PlannedDispatch> dispatches);
  Status runFrame();
  Status addContacts();
  void writePoses(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                  std::span<const BodyPose> rootPoses);
  Status carryTo(const HeadPose& end);
  Result<std::vector<Vec3f>> inGroomOrder(DeviceGroom::Field field) const;
  Status placeAtRest();
};

Result<Simulation> Simulation::create(const ComputeDevice& device, const Groom& groom,
                                      const Material& material, const Settings& settings,
                                      const HeadPose& start, const HeadPose& oneStepEarlier,
                                      const KernelChoice& choice, std::span<const Body> bodies) {
  if (!bodies.empty() && settings.integrator != Integrator::jacobi) return Error{kBodiesNeedJacobi};
  // Strands that may meet stand near each other in memory.
  std::vector<std::uint32_t> order;
  if (settings.contacts.on) order = orderAlongCurve(groom);
  auto rest = buildRestState(groom, material, settings, order);
  if (!rest) return rest.error();

  const DeviceLimits limits = limitsOf(device.gpu());
  std::vector<std::uint32_t> counts;
  for (const layout::StrandRest& strand : rest->strands) counts.push_back(strand.particleCount);
  auto ranges = planRanges(counts, limits, choice);
  if (!ranges) return ranges.error();
  const bool anySerial =
      std::any_of(ranges->begin(), ranges->end(), [](const auto& r) { return r.shape.serial(); });
  const GroomRecords records = groomRecords(settings, choice, anySerial, !bodies.empty());
  const auto chunks = cutForDevice(device.gpu(), counts, records, settings, choice);
  if (!chunks) return chunks.error();
  *ranges = cutRanges(*ranges, *chunks);
  auto plan = planFrame(*ranges, limits, settings, bodies.size(), kStrandGroupSize);
  if (!plan) return plan.error();

  auto buffers = DeviceGroom::create(device.gpu(), *rest, *chunks, records);
  if (!buffers) return buffers.error();
  auto world = DeviceWorld::create(device.gpu(), bodies, settings, start);
  if (!world) return world.error();
  auto roots = DeviceRoots::create(device.gpu(), *rest, settings, choice.movingRoots, *chunks);
  if (!roots) return roots.error();

  std::unique_ptr<Implementation> self(new Implementation{device,
                                                          std::move(*rest),
                                                          settings,
                                                          material,
                                                          choice,
                                                          {oneStepEarlier, start},
                                                          std::move(*buffers),
                                                          std::move(*world),
                                                          std::move(*roots),
                                                          std::move(*ranges),
                                                          std::move(*plan)});
  const bool oneSmoothing = std::all_of(self->rest.strands.begin(), self->rest.strands.end(),
                                        [](const layout::StrandRest& s) { return s.bendBeta == s.coreBeta; });
  const bool bendVaries =
      !material.bendStiffnessProfile.points.empty() && settings.integrator != Integrator::paper;
  const bool fitsTexels = isSeenAsTexels(
      device.gpu(),
      std::max({self->buffers.largestTexels(), self->world.largestBuffer(), self->roots.largestBuffer()}));
  for (std::size_t r = 0; r < self->ranges.size(); ++r) {
    const StrandRange& range = self->ranges[r];
    if (r == 0 || range.shape != self->ranges[r - 1].shape) {
      auto kernel = createStrandKernel(
          device.gpu(), range.shape,
          {settings.integrator, oneSmoothing, bendVaries, choice.taps, settings.contacts.on, fitsTexels,
           choice.residual, !bodies.empty(), settings.air.on, self->world.isTurbulent(), choice.movingRoots});
      if (!kernel) return kernel.error();
      self->kernels.push_back(std::move(*kernel));
    }
    self->kernelOf.push_back(self->kernels.size() - 1);
    auto buffersInOrder = self->buffers.inBindingOrder(range.chunk);
    std::ranges::copy(self->world.inBindingOrder(), std::back_inserter(buffersInOrder));
    std::ranges::copy(self->roots.inBindingOrder(range.chunk), std::back_inserter(buffersInOrder));
    auto bindings = gpu::Bindings::create(self->kernels.back(), buffersInOrder);
    if (!bindings) return bindings.error();
    self->bindings.push_back(std::move(*bindings));
  }
  if (Status status = self->placeAtRest(); !status) return status.error();
  if (settings.contacts.on) {
    if (Status status = self->addContacts(); !status) return status.error();
  }
  self->rest.particles = {};  // the device has them
  if (Status status = self->recordFrame(); !status) return status.error();
  return Simulation(std::move(self));
}

layout::StepParameters Simulation::Implementation::parametersOf(const PlannedDispatch& dispatch) const {
  layout::StepParameters p{};
  p.gravity = packed(settings.gravity);
  p.gravity.w = static_cast<float>(settings.stepSeconds());
  p.maxStretch = static_cast<float>(settings.maxStretch);
  p.coreRelaxedShare = static_cast<float>(material.coreRelaxedShare);
  p.coreElongationLow = static_cast<float>(material.coreElongationLow);
  p.coreElongationHigh = static_cast<float>(material.coreElongationHigh);
  p.strandBegin = dispatch.strandBegin;
  p.strandEnd = dispatch.strandEnd;
  p.stepBegin = dispatch.stepBegin;
  p.stepEnd = dispatch.stepEnd;
  p.rootCount = static_cast<std::uint32_t>(settings.rootCount);
  p.pointIterations = static_cast<std::uint32_t>(settings.pointIterations);
  p.chebyshev = settings.chebyshev ? 1 : 0;
  p.forceLoops = static_cast<std::uint32_t>(settings.forceLoops);
  p.dampingLoops = static_cast<std::uint32_t>(settings.dampingLoops);
  const GroomChunk& chunk = buffers.chunks[ranges[dispatch.range].chunk].part;
  p.particleCount = chunk.particleCount();
  p.phases = dispatch.phases;
  p.loopBegin = dispatch.loopBegin;
  p.loopEnd = dispatch.loopEnd;
  p.bodyCount = static_cast<std::uint32_t>(world.bodyCount());
  p.dragStrength = static_cast<float>(kStandardGravity / (settings.air.fallSpeed * settings.air.fallSpeed));
  p.dragAlong = static_cast<float>(settings.air.alongShare);
  p.strandCount = chunk.strandCount();
  return p;
}

Status Simulation::Implementation::addContacts() {
  const RestContacts atRest = buildRestContacts(rest, settings.contacts);
  std::ranges::copy(atRest.warnings(), std::back_inserter(rest.warnings));
  auto stage = ContactStage::create(device.gpu(), rest, settings, atRest, buffers);
  if (!stage) return stage.error();
  contacts = std::move(*stage);
  contactReport = {.contactParticles = atRest.particles.particles.size(),
                   .pairsUnpruned = atRest.graph.pairsUnpruned,
                   .pairs = atRest.graph.pairs};
  return {};
}

void Simulation::Implementation::dispatchAll(std::span<const PlannedDispatch> dispatches) {
  frame->beginStage("strand_step");
  for (std::size_t d = 0; d < dispatches.size(); ++d) {
    const PlannedDispatch& now = dispatches[d];
    // Only dispatches on the same strands depend on each other; but the validation layer sees whole buffers,
    // and takes those on other strands for hazards.
    if (d > 0) frame->barrier();
    frame->dispatch(kernels[kernelOf[now.range]], bindings[now.range], parametersOf(now), now.groupCount);
  }
  frame->endStage();
}

// The whole frame, once: what changes from frame to frame is in the poses buffer.
Status Simulation::Implementation::recordFrame() {
  if (!frame) {
    auto recorder = gpu::Recorder::create(device.gpu(), "frame");
    if (!recorder) return recorder.error();
    frame = std::move(*recorder);
  }
  if (contacts) return recordContactFrame(0, true);
  if (Status status = frame->begin(); !status) return status;
  dispatchAll(plan);
  return {};
}

Status Simulation::Implementation::recordPass(const SolvePass& pass) {
  const auto dispatches =
      planPass(ranges, limitsOf(device.gpu()), settings, world.bodyCount(), kStrandGroupSize, pass);
  if (!dispatches) return dispatches.error();
  dispatchAll(*dispatches);
  frame->barrier();
  return {};
}

// The frame from a step on. Between the solves of a step stand its contacts (contact_stage.h).
Status Simulation::Implementation::recordContactFrame(std::uint32_t firstStep, bool predictFirst) {
  if (Status status = frame->begin(); !status) return status;
  if (predictFirst) {
    if (Status status = recordPass({.step = firstStep}); !status) return status;
  }
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  for (std::uint32_t step = firstStep; step < steps; ++step) {
    contacts->recordLists(*frame, step);
    frame->barrier();
    contacts->recordLife(*frame);
    frame->barrier();
    for (int iteration = 1; iteration <= settings.contacts.iterations; ++iteration) {
      const bool isLast = iteration == settings.contacts.iterations;
      const SolvePass pass{step, true, isLast, isLast && step + 1 < steps};
      if (Status status = recordPass(pass); !status) return status;
      if (isLast) continue;
      contacts->recordGather(*frame);
      frame->barrier();
    }
  }
  isWholeFrame = firstStep == 0 && predictFirst;
  return {};
}

// A frame that stopped because a list was too long goes on from its step with longer ones: no pair is
// dropped.
Status Simulation::Implementation::runFrame() {
  if (!isWholeFrame) {
    if (Status status = recordFrame(); !status) return status;
  }
  while (true) {
    if (Status status = frame->submitAndWait(); !status) return status;
    for (const auto& [stage, milliseconds] : frame->stageMilliseconds())
      stageMilliseconds[stage] += milliseconds;
    if (!contacts) return {};
    contactReport.pairTests += contacts->takePairTests();
    if (!contacts->isHalted()) return {};
    if (Status status = contacts->makeRoom(); !status) return status;
    if (Status status = recordContactFrame(contacts->haltedStep(), false); !status) return status;
    isWholeFrame = false;
  }
}

void Simulation::Implementation::writePoses(std::span<const HeadPose> stepPoses,
                                            std::span<const BodyPose> bodyPoses,
                                            std::span<const BodyPose> rootPoses) {
  const double T = settings.stepSeconds();
  std::vector<HeadPose> heads{head.oneStepEarlier, head.now};
  heads.insert(heads.end(), stepPoses.begin(), stepPoses.end());
  world.writeFrame(std::span(heads).subspan(1), bodyPoses, static_cast<double>(stepsDone) * T);
  roots.writeFrame(heads, rootPoses);
  const auto poses = buffers.mappedPoses();
  poses[0] = {packed(head.now.rotation), packed(head.turn()), {0, 0, 0, static_cast<float>(head.now.shift)}};
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    const Vec3d before = head.velocity(T);
    head = {head.now, stepPoses[k]};
    head.now.rotation = normalized(head.now.rotation);
    poses[1 + k] = {packed(head.now.rotation), packed(head.turn()), packed(head.velocity(T) - before)};
    poses[1 + k].velocityChange.w = static_cast<float>(head.now.shift);
  }
}

// Rigidly: seen from the head nothing changes.
Status Simulation::Implementation::carryTo(const HeadPose& end) {
  const Quatd turned = normalized(end.rotation * head.now.rotation.conjugate());
  const bool turns = length(Vec3d{turned.x, turned.y, turned.z}) > 1e-12;
  head.jump(end);
  if (!turns) return {};
  if (contacts) {
    if (Status status = contacts->forget(); !status) return status;
  }
  for (const DeviceGroom::Field field : {&DeviceChunk::positions, &DeviceChunk::velocities}) {
    const auto rotated = [&](layout::vec4 v) {
      return packed(rotate(turned, static_cast<Vec3d>(unpacked(v))));
    };
    if (Status status = buffers.changeEach(field, rotated); !status) return status;
  }
  return {};
}

// The rest pose carried by the head and the roots, moving with them.
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
  if (Status status = buffers.uploadEach(&DeviceChunk::positions, positionAt); !status) return status;
  places = GroomPlaces(rest);
  const auto velocityAt = [&](std::size_t i) {
    const std::size_t s = places.strandOf(i);
    const Vec3d p = static_cast<Vec3d>(rest.points[i]);
    return packed((placedBy(nowAt(s), p) - placedBy(earlierAt(s), p)) / settings.stepSeconds());
  };
  return buffers.uploadEach(&DeviceChunk::velocities, velocityAt);
}

Simulation::Simulation(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Status Simulation::stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                             std::span<const BodyPose> rootPoses) {
  RINGLET_ASSERT(stepPoses.size() == static_cast<std::size_t>(self_->settings.stepsPerFrame),
                 "stepFrame takes one pose per outer step");
  if (const HeadPose& end = stepPoses.back();
      self_->settings.jumps(length(end.position - self_->head.now.position))) {
    self_->world.endFrame(end, bodyPoses);
    self_->roots.endFrame(rootPoses);
    self_->stepsDone += stepPoses.size();
    return self_->carryTo(end);
  }
  self_->writePoses(stepPoses, bodyPoses, rootPoses);
  if (Status status = self_->runFrame(); !status) return status;
  self_->stepsDone += stepPoses.size();
  return {};
}

Status Simulation::stepFrame(const HeadPose& end) {
  const HeadPose start = self_->head.now;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= self_->settings.stepsPerFrame; ++k) {
    poses.push_back(interpolate(start, end, double(k) / self_->settings.stepsPerFrame));
  }
  return stepFrame(poses);
}

Result<std::vector<Vec3f>> Simulation::Implementation::inGroomOrder(DeviceGroom::Field field) const {
  std::vector<Vec3f> values(rest.points.size());
  GroomPlaces place(rest);
  const auto take = [&](std::size_t i, layout::vec4 value) { values[place(i)] = unpacked(value); };
  if (Status status = buffers.downloadEach(field, take); !status) return status.error();
  return values;
}

Result<std::vector<Vec3f>> Simulation::positions() const {
  return self_->inGroomOrder(&DeviceChunk::positions);
}

Result<HairState> Simulation::state() const {
  auto p = positions();
  if (!p) return p.error();
  auto v = self_->inGroomOrder(&DeviceChunk::velocities);
  if (!v) return v.error();
  return HairState{std::move(*p), std::move(*v)};
}

Status Simulation::setState(const HairState& state) {
  const std::size_t count = self_->rest.points.size();
  RINGLET_ASSERT(state.positions.size() == count && state.velocities.size() == count,
                 "a state has one position and velocity a particle");
  if (self_->contacts) {
    if (Status status = self_->contacts->forget(); !status) return status;
  }
  const auto upload = [&](DeviceGroom::Field field, const std::vector<Vec3f>& values) {
    GroomPlaces place(self_->rest);
    return self_->buffers.uploadEach(field, [&](std::size_t i) { return packed(values[place(i)]); });
  };
  if (Status status = upload(&DeviceChunk::positions, state.positions); !status) return status;
  return upload(&DeviceChunk::velocities, state.velocities);
}

void Simulation::placeBodies(std::span<const BodyPose> poses) {
  RINGLET_ASSERT(poses.size() == self_->world.bodyCount(), "every body has a place");
  self_->world.placeBodies(poses);
}

Status Simulation::placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
  self_->roots.place(now, oneStepEarlier);
  if (self_->contacts) {
    if (Status status = self_->contacts->forget(); !status) return status;
  }
  return self_->placeAtRest();
}

Status Simulation::setRootShifts(std::span<const Vec3d> shifts) {
  std::vector<layout::StrandRest>& strands = self_->rest.strands;
  RINGLET_ASSERT(shifts.size() == strands.size(), "every strand has a root shift");
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const Vec3f shift = static_cast<Vec3f>(shifts[self_->rest.strandInGroom[s]]);
    strands[s].pins[0].w = shift.x, strands[s].pins[1].w = shift.y, strands[s].pins[2].w = shift.z;
  }
  return self_->buffers.uploadStrands(self_->rest);
}

const HeadPose& Simulation::head() const { return self_->head.now; }

Result<SimulationReport> Simulation::report() const {
  const auto reports = self_->buffers.downloadReports();
  if (!reports) return reports.error();
  SimulationReport total;
  std::uint64_t edges = 0, limited = 0;
  for (std::size_t s = 0; s < reports->size(); ++s) {
    const layout::StrandReport& r = (*reports)[s];
    edges += self_->rest.strands[s].particleCount - 1;
    limited += r.limitedEdges;
    total.maxEdgeStretch = std::max<double>(total.maxEdgeStretch, r.maxStretch);
    total.degenerateEdges += r.degenerateEdges;
    total.velocityResidual = std::max<double>(total.velocityResidual, r.velocityResidual);
    total.nonfinite += r.nonfiniteParticles;
    const std::int64_t strand = self_->rest.strandInGroom[s];
    if (r.nonfiniteParticles > 0 && (total.firstNonfiniteStrand < 0 || strand < total.firstNonfiniteStrand)) {
      total.firstNonfiniteStrand = strand;
      total.firstNonfiniteParticle = r.firstNonfinite;
    }
  }
  if (total.nonfinite > 0) total.maxEdgeStretch = std::numeric_limits<double>::infinity();
  const double edgeSteps = static_cast<double>(edges) * static_cast<double>(self_->stepsDone);
  total.limitedShare = edgeSteps > 0 ? static_cast<double>(limited) / edgeSteps : 0;
  return total;
}

Result<ContactReport> Simulation::contactReport() const {
  ContactReport report = self_->contactReport;
  if (!self_->contacts) return report;
  report.listed = self_->contacts->listedCount();
  const auto contacts = self_->contacts->contactCount();
  if (!contacts) return contacts.error();
  report.contacts = *contacts;
  report.rebuilds = self_->contacts->rebuilds();
  auto error = self_->contacts->momentumError(self_->rest);
  if (!error) return error.error();
  report.momentumError = *error;
  return report;
}

Result<std::vector<ListedContact>> Simulation::listedContacts() const {
  if (!self_->contacts) return std::vector<ListedContact>{};
  return self_->contacts->listed(self_->rest);
}

const std::vector<std::string>& Simulation::warnings() const { return self_->rest.warnings; }
std::map<std::string, double> Simulation::stageMilliseconds() const { return self_->stageMilliseconds; }

Result<std::vector<std::array<float, 4>>> Simulation::tap(std::uint32_t field) const {
  RINGLET_ASSERT(self_->choice.taps && field < layout::kTapCount,
                 "taps are written only with KernelChoice::taps");
  std::vector<std::array<float, 4>> values(self_->rest.points.size());
  GroomPlaces place(self_->rest);
  const auto take = [&](std::size_t i, layout::vec4 v) { values[place(i)] = {v.x, v.y, v.z, v.w}; };
  if (Status status = self_->buffers.downloadEach(&DeviceChunk::scratch, take, field); !status)
    return status.error();
  return values;
}

DeviceMemory Simulation::memory() const {
  const std::optional<ContactStage>& contacts = self_->contacts;
  return {
      .particles = self_->buffers.particleBytes(),
      .strands = self_->buffers.strandBytes(),
      .rootPoses = self_->roots.bytes(),
      .contacts = contacts ? contacts->bytes() : 0,
      .contactLists = contacts ? contacts->listBytes() : 0,
      .world = self_->buffers.poses.bytes() + self_->buffers.contactControl.bytes() + self_->world.bytes()};
}

std::string Simulation::kernelDescription() const {
  return describe(self_->ranges, self_->device.gpu().properties().subgroupSize);
}

}  // namespace ringlet
