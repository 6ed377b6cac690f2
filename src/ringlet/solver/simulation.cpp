// Implements solver/simulation.h: the frame is one recorded list of dispatches, replayed with new poses; one
// recording for each frame in flight.
#include "ringlet/solver/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
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
// An object rather than a function: loops over particles see through it.
constexpr auto unpacked = [](layout::vec4 v) { return Vec3f{v.x, v.y, v.z}; };

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

// A place for a frame in flight.
struct FrameSlot {
  gpu::Buffer positions;    // as the frame left them, in the host's memory
  gpu::Recorder recorder;   // goes first, waiting for what it writes
  bool isRecorded = false;  // as a whole frame

  static Result<FrameSlot> create(gpu::Device& device, std::size_t particles) {
    auto recorder = gpu::Recorder::create(device, "frame");
    if (!recorder) return recorder.error();
    auto positions = gpu::Buffer::create(device, particles * sizeof(layout::vec4), gpu::BufferKind::stream,
                                         "positions read back");
    if (!positions) return positions.error();
    return FrameSlot{std::move(*positions), std::move(*recorder)};
  }
  std::span<const layout::vec4> values() const {
    const auto bytes = positions.mapped();
    return {reinterpret_cast<const layout::vec4*>(bytes.data()), bytes.size() / sizeof(layout::vec4)};
  }
};

std::string describe(std::span<const StrandRange> ranges, std::uint32_t subgroupSize) {
  std::string text;
  for (const StrandRange& range : ranges) {
    text += (text.empty() ? "" : ", ") + range.shape.describe();
  }
  return fmt::format("{} (subgroup {})", text, subgroupSize);
}

// Tells the observer, where there is one, of a beginning and, whatever happens, of an end.
class CompileNotice {
 public:
  CompileNotice(CompileObserver* observer, std::size_t kernelCount) : observer_(observer) {
    if (observer_) observer_->begin(kernelCount);
  }
  ~CompileNotice() {
    if (observer_) observer_->end();
  }
  CompileNotice(const CompileNotice&) = delete;

 private:
  CompileObserver* observer_;
};

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
  std::vector<gpu::Kernel> kernels{};  // one a range
  std::vector<gpu::Bindings> bindings{};

  std::optional<ContactStage> contacts{};
  ContactReport contactReport{};  // what is known of the rest pose, and sums

  std::uint64_t stepsDone = 0;
  std::map<std::string, double> stageMilliseconds{};

  double compileMilliseconds = 0;

  Status makeKernels(bool hasBodies);

  // Frame n has slot n % kFramesInFlight: submitted to the device, finished by it, waited for by the caller.
  std::uint64_t submitted = 0, finished = 0, waited = 0;
  bool isReadBack = false;           // the last frame's positions are those on the device
  std::optional<Error> lostFrame{};  // after which nothing can be told of any
  std::vector<FrameSlot> slots{};    // go first, waiting for what still uses the rest

  layout::StepParameters parametersOf(const PlannedDispatch& dispatch) const;
  FrameSlot& slotOf(std::uint64_t frame) { return slots[frame % kFramesInFlight]; }
  Status beginFrame(std::size_t slot);
  void endFrame(FrameSlot& slot);
  Status recordFrame(std::size_t slot);
  Status recordContactFrame(std::size_t slot, std::uint32_t firstStep, bool predictFirst);
  Status recordPass(gpu::Recorder& recorder, const SolvePass& pass);
  void dispatchAll(gpu::Recorder& recorder, std::span<const PlannedDispatch> dispatches);
  Status submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                     std::span<const BodyPose> rootPoses);
  Status finishFrames(std::uint64_t end);
  Status finishFrames() { return finishFrames(submitted); }
  Status runToEnd(std::size_t slot);
  Status addContacts();
  void writePoses(std::size_t slot, std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                  std::span<const BodyPose> rootPoses);
  Status jumpTo(const HeadPose& end, std::span<const BodyPose> bodyPoses,
                std::span<const BodyPose> rootPoses);
  Status carryTo(const HeadPose& end);
  Status uploadState(std::span<const layout::vec4> positions, std::span<const layout::vec4> velocities);
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

  const DeviceLimits limits = device.limits();
  std::vector<std::uint32_t> counts;
  for (const layout::StrandRest& strand : rest->strands) counts.push_back(strand.particleCount);
  const bool isHairAlone = !settings.contacts.on && !settings.air.on && bodies.empty();
  auto ranges = planRanges(counts, limits, choice, isHairAlone);
  if (!ranges) return ranges.error();
  auto plan = planFrame(*ranges, limits, settings, bodies.size(), kStrandGroupSize);
  if (!plan) return plan.error();

  const bool anySerial =
      std::any_of(ranges->begin(), ranges->end(), [](const auto& r) { return r.shape.serial(); });
  const std::uint64_t scratchPerParticle =
      (anySerial ? layout::kScratchPerParticle + (bodies.empty() ? 0 : layout::kBodyScratch) +
                       (settings.air.on ? layout::kAirScratch : 0)
                 : 0) +
      (choice.taps ? layout::kTapCount : 0);
  auto buffers =
      DeviceGroom::create(device.gpu(), *rest, rest->points.size() * scratchPerParticle, settings.contacts.on,
                          settings.contacts.on || (anySerial && !bodies.empty()), kFramesInFlight);
  if (!buffers) return buffers.error();
  auto world = DeviceWorld::create(device.gpu(), bodies, settings, start, kFramesInFlight);
  if (!world) return world.error();
  auto roots = DeviceRoots::create(device.gpu(), *rest, settings, choice.movingRoots, kFramesInFlight);
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
  if (Status status = self->placeAtRest(); !status) return status.error();
  if (settings.contacts.on) {
    if (Status status = self->addContacts(); !status) return status.error();
  }
  if (Status status = self->makeKernels(!bodies.empty()); !status) return status.error();
  for (std::size_t slot = 0; slot < kFramesInFlight; ++slot) {
    auto made = FrameSlot::create(device.gpu(), self->rest.points.size());
    if (!made) return made.error();
    self->slots.push_back(std::move(*made));
    if (Status status = self->recordFrame(slot); !status) return status.error();
  }
  return Simulation(std::move(self));
}

// Made, several at a time, and compiled by a dispatch of nothing: some drivers compile only then.
Status Simulation::Implementation::makeKernels(bool hasBodies) {
  const auto start = std::chrono::steady_clock::now();
  const CompileNotice notice(choice.observer, ranges.size() + (contacts ? kContactKernelCount : 0));
  const bool oneSmoothing = std::all_of(rest.strands.begin(), rest.strands.end(),
                                        [](const layout::StrandRest& s) { return s.bendBeta == s.coreBeta; });
  const bool bendVaries =
      !material.bendStiffnessProfile.points.empty() && settings.integrator != Integrator::paper;
  const bool fitsTexels =
      buffers.fitsTexels(device.gpu()) &&
      isSeenAsTexels(device.gpu(), std::max(world.largestBuffer(), roots.largestBuffer()));
  const StrandKernelOptions options{settings.integrator,  oneSmoothing,        bendVaries,        choice.taps,
                                    settings.contacts.on, fitsTexels,          choice.residual,   hasBodies,
                                    settings.air.on,      world.isTurbulent(), choice.movingRoots};
  auto made = createStrandKernels(device.gpu(), ranges, options);
  if (!made) return made.error();
  kernels = std::move(*made);
  auto buffersInOrder = buffers.inBindingOrder();
  std::ranges::copy(world.inBindingOrder(), std::back_inserter(buffersInOrder));
  std::ranges::copy(roots.inBindingOrder(), std::back_inserter(buffersInOrder));
  for (const gpu::Kernel& kernel : kernels) {
    auto bound = gpu::Bindings::create(kernel, buffersInOrder);
    if (!bound) return bound.error();
    bindings.push_back(std::move(*bound));
  }

  auto recorder = gpu::Recorder::create(device.gpu(), "compile");
  if (!recorder) return recorder.error();
  if (Status status = recorder->begin(); !status) return status;
  for (std::size_t k = 0; k < kernels.size(); ++k) recorder->dispatchNothing(kernels[k], bindings[k]);
  if (contacts) contacts->recordNothing(*recorder);
  if (Status status = recorder->submitAndWait(); !status) return status;
  compileMilliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return {};
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
  p.particleCount = static_cast<std::uint32_t>(rest.points.size());
  p.phases = dispatch.phases;
  p.loopBegin = dispatch.loopBegin;
  p.loopEnd = dispatch.loopEnd;
  p.bodyCount = static_cast<std::uint32_t>(world.bodyCount());
  p.dragStrength = static_cast<float>(kStandardGravity / (settings.air.fallSpeed * settings.air.fallSpeed));
  p.dragAlong = static_cast<float>(settings.air.alongShare);
  p.strandCount = static_cast<std::uint32_t>(rest.strands.size());
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

void Simulation::Implementation::dispatchAll(gpu::Recorder& recorder,
                                             std::span<const PlannedDispatch> dispatches) {
  recorder.beginStage("strand_step");
  for (std::size_t d = 0; d < dispatches.size(); ++d) {
    const PlannedDispatch& now = dispatches[d];
    // Only dispatches on the same strands depend on each other; but the validation layer sees whole buffers,
    // and takes those on other strands for hazards.
    if (d > 0) recorder.barrier();
    recorder.dispatch(kernels[now.range], bindings[now.range], parametersOf(now), now.groupCount);
  }
  recorder.endStage();
}

// A recording takes over what the host wrote for the frame, and at its end brings positions back.
Status Simulation::Implementation::beginFrame(std::size_t slot) {
  gpu::Recorder& recorder = slots[slot].recorder;
  if (Status status = recorder.begin(); !status) return status;
  buffers.poses.record(recorder, slot);
  world.record(recorder, slot);
  roots.record(recorder, slot);
  recorder.barrier();
  return {};
}
void Simulation::Implementation::endFrame(FrameSlot& slot) {
  slot.recorder.barrier();
  slot.recorder.copyBuffer(buffers.positions, slot.positions, slot.positions.bytes());
}

// The whole frame, once: what changes from frame to frame is in its inputs.
Status Simulation::Implementation::recordFrame(std::size_t slot) {
  if (contacts) return recordContactFrame(slot, 0, true);
  if (Status status = beginFrame(slot); !status) return status;
  dispatchAll(slots[slot].recorder, plan);
  endFrame(slots[slot]);
  slots[slot].isRecorded = true;
  return {};
}

Status Simulation::Implementation::recordPass(gpu::Recorder& recorder, const SolvePass& pass) {
  const auto dispatches =
      planPass(ranges, device.limits(), settings, world.bodyCount(), kStrandGroupSize, pass);
  if (!dispatches) return dispatches.error();
  dispatchAll(recorder, *dispatches);
  recorder.barrier();
  return {};
}

// The frame from a step on. Between the solves of a step stand its contacts (contact_stage.h).
Status Simulation::Implementation::recordContactFrame(std::size_t slot, std::uint32_t firstStep,
                                                      bool predictFirst) {
  if (Status status = beginFrame(slot); !status) return status;
  gpu::Recorder& recorder = slots[slot].recorder;
  if (predictFirst) {
    if (Status status = recordPass(recorder, {.step = firstStep}); !status) return status;
  }
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  for (std::uint32_t step = firstStep; step < steps; ++step) {
    contacts->recordLists(recorder, step);
    recorder.barrier();
    contacts->recordLife(recorder);
    recorder.barrier();
    for (int iteration = 1; iteration <= settings.contacts.iterations; ++iteration) {
      const bool isLast = iteration == settings.contacts.iterations;
      const SolvePass pass{step, true, isLast, isLast && step + 1 < steps};
      if (Status status = recordPass(recorder, pass); !status) return status;
      if (isLast) continue;
      contacts->recordGather(recorder);
      recorder.barrier();
    }
  }
  endFrame(slots[slot]);
  slots[slot].isRecorded = firstStep == 0 && predictFirst;
  return {};
}

Status Simulation::Implementation::submitFrame(std::span<const HeadPose> stepPoses,
                                               std::span<const BodyPose> bodyPoses,
                                               std::span<const BodyPose> rootPoses) {
  RINGLET_ASSERT(stepPoses.size() == static_cast<std::size_t>(settings.stepsPerFrame),
                 "a frame takes one pose per outer step");
  if (lostFrame) return *lostFrame;
  RINGLET_ASSERT(submitted - waited < kFramesInFlight, "more frames in flight than there are places");
  const HeadPose& end = stepPoses.back();
  const bool jumps = settings.jumps(length(end.position - head.now.position));
  // A frame with contacts may not be over when the device stops.
  if (contacts || jumps) {
    if (Status status = finishFrames(); !status) return status;
  }
  const std::size_t slot = submitted % kFramesInFlight;
  if (jumps) {
    if (Status status = jumpTo(end, bodyPoses, rootPoses); !status) return status;
    ++finished;
  } else {
    writePoses(slot, stepPoses, bodyPoses, rootPoses);
    if (!slots[slot].isRecorded) {
      if (Status status = recordFrame(slot); !status) return status;
    }
    if (Status status = slots[slot].recorder.submit(); !status) return status;
  }
  ++submitted;
  stepsDone += stepPoses.size();
  isReadBack = true;
  return {};
}

// Until frame `end`, not itself, is over.
Status Simulation::Implementation::finishFrames(std::uint64_t end) {
  if (lostFrame) return *lostFrame;
  while (finished < end) {
    if (Status status = runToEnd(finished % kFramesInFlight); !status) {
      lostFrame = status.error();
      return status;
    }
    ++finished;
  }
  return {};
}

// A frame that stopped because a list was too long goes on from its step with longer ones: no pair is
// dropped.
Status Simulation::Implementation::runToEnd(std::size_t slot) {
  gpu::Recorder& recorder = slots[slot].recorder;
  while (true) {
    if (Status status = recorder.wait(); !status) return status;
    for (const auto& [stage, milliseconds] : recorder.stageMilliseconds())
      stageMilliseconds[stage] += milliseconds;
    if (!contacts) return {};
    contactReport.pairTests += contacts->takePairTests();
    if (!contacts->isHalted()) return {};
    if (Status status = contacts->makeRoom(); !status) return status;
    for (FrameSlot& other : slots) other.isRecorded = false;
    if (Status status = recordContactFrame(slot, contacts->haltedStep(), false); !status) return status;
    if (Status status = recorder.submit(); !status) return status;
  }
}

void Simulation::Implementation::writePoses(std::size_t slot, std::span<const HeadPose> stepPoses,
                                            std::span<const BodyPose> bodyPoses,
                                            std::span<const BodyPose> rootPoses) {
  const double T = settings.stepSeconds();
  std::vector<HeadPose> heads{head.oneStepEarlier, head.now};
  heads.insert(heads.end(), stepPoses.begin(), stepPoses.end());
  world.writeFrame(slot, std::span(heads).subspan(1), bodyPoses, static_cast<double>(stepsDone) * T);
  roots.writeFrame(slot, heads, rootPoses);
  const auto poses = buffers.poses.of<layout::StepPose>(slot);
  poses[0] = {packed(head.now.rotation), packed(head.turn()), {0, 0, 0, static_cast<float>(head.now.shift)}};
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    const Vec3d before = head.velocity(T);
    head = {head.now, stepPoses[k]};
    head.now.rotation = normalized(head.now.rotation);
    poses[1 + k] = {packed(head.now.rotation), packed(head.turn()), packed(head.velocity(T) - before)};
    poses[1 + k].velocityChange.w = static_cast<float>(head.now.shift);
  }
}

Status Simulation::Implementation::uploadState(std::span<const layout::vec4> positions,
                                               std::span<const layout::vec4> velocities) {
  isReadBack = false;
  if (Status status = buffers.positions.upload(std::as_bytes(positions)); !status) return status;
  return buffers.velocities.upload(std::as_bytes(velocities));
}

// A frame that no kernel steps.
Status Simulation::Implementation::jumpTo(const HeadPose& end, std::span<const BodyPose> bodyPoses,
                                          std::span<const BodyPose> rootPoses) {
  world.endFrame(end, bodyPoses);
  roots.endFrame(rootPoses);
  if (Status status = carryTo(end); !status) return status;
  return buffers.positions.download(slotOf(submitted).positions.mapped());
}

// Rigidly: seen from the head nothing changes.
Status Simulation::Implementation::carryTo(const HeadPose& end) {
  const Quatd turned = normalized(end.rotation * head.now.rotation.conjugate());
  const bool turns = length(Vec3d{turned.x, turned.y, turned.z}) > 1e-12;
  head.jump(end);
  if (!turns) return {};
  const std::size_t count = rest.points.size();
  auto positions = downloadAll<layout::vec4>(buffers.positions, count);
  if (!positions) return positions.error();
  auto velocities = downloadAll<layout::vec4>(buffers.velocities, count);
  if (!velocities) return velocities.error();
  for (auto* values : {&*positions, &*velocities}) {
    for (layout::vec4& v : *values) v = packed(rotate(turned, static_cast<Vec3d>(unpacked(v))));
  }
  if (contacts) {
    if (Status status = contacts->forget(); !status) return status;
  }
  return uploadState(*positions, *velocities);
}

// The rest pose carried by the head and the roots, moving with them.
Status Simulation::Implementation::placeAtRest() {
  std::vector<layout::vec4> positions(rest.points.size()), velocities(rest.points.size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const BodyPose now = carriedBy(head.now.rotation, roots.areMoving() ? roots.now(s) : BodyPose{});
    const BodyPose earlier =
        carriedBy(head.oneStepEarlier.rotation, roots.areMoving() ? roots.oneStepEarlier(s) : BodyPose{});
    for (std::uint32_t k = 0; k < rest.strands[s].particleCount; ++k) {
      const std::uint32_t i = rest.strands[s].firstParticle + k;
      const Vec3d p = static_cast<Vec3d>(rest.points[i]);
      const Vec3d here = now.position + rotate(now.rotation, p);
      const Vec3d before = earlier.position + rotate(earlier.rotation, p);
      positions[i] = packed(here);
      velocities[i] = packed((here - before) / settings.stepSeconds());
    }
  }
  return uploadState(positions, velocities);
}

Simulation::Simulation(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Status Simulation::stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                             std::span<const BodyPose> rootPoses) {
  RINGLET_ASSERT(self_->lostFrame || self_->waited == self_->submitted,
                 "stepFrame while frames are in flight");
  if (Status status = self_->submitFrame(stepPoses, bodyPoses, rootPoses); !status) return status;
  return waitFrame();
}

Status Simulation::submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                               std::span<const BodyPose> rootPoses) {
  return self_->submitFrame(stepPoses, bodyPoses, rootPoses);
}

Status Simulation::waitFrame() {
  RINGLET_ASSERT(self_->waited < self_->submitted, "waitFrame without submitFrame");
  if (Status status = self_->finishFrames(self_->waited + 1); !status) return status;
  ++self_->waited;
  return {};
}

std::vector<Vec3f> Simulation::framePositions() const {
  RINGLET_ASSERT(self_->waited > 0 && self_->submitted - self_->waited < kFramesInFlight,
                 "framePositions before waitFrame, or after its place was taken");
  return inGroomOrder<Vec3f, layout::vec4>(self_->rest, self_->slotOf(self_->waited - 1).values(), unpacked);
}

Status Simulation::stepFrame(const HeadPose& end) {
  const HeadPose start = self_->head.now;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= self_->settings.stepsPerFrame; ++k) {
    poses.push_back(interpolate(start, end, double(k) / self_->settings.stepsPerFrame));
  }
  return stepFrame(poses);
}

Result<std::vector<Vec3f>> Simulation::positions() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  if (self_->isReadBack) {
    return inGroomOrder<Vec3f, layout::vec4>(self_->rest, self_->slotOf(self_->submitted - 1).values(),
                                             unpacked);
  }
  auto values = downloadAll<layout::vec4>(self_->buffers.positions, self_->rest.points.size());
  if (!values) return values.error();
  return inGroomOrder<Vec3f, layout::vec4>(self_->rest, *values, unpacked);
}

Result<HairState> Simulation::state() const {
  auto p = positions();
  if (!p) return p.error();
  auto values = downloadAll<layout::vec4>(self_->buffers.velocities, self_->rest.points.size());
  if (!values) return values.error();
  return HairState{std::move(*p), inGroomOrder<Vec3f, layout::vec4>(self_->rest, *values, unpacked)};
}

Status Simulation::setState(const HairState& state) {
  const std::size_t count = self_->rest.points.size();
  RINGLET_ASSERT(state.positions.size() == count && state.velocities.size() == count,
                 "a state has one position and velocity a particle");
  if (Status status = self_->finishFrames(); !status) return status;
  if (self_->contacts) {
    if (Status status = self_->contacts->forget(); !status) return status;
  }
  const auto pack = [](Vec3f v) { return packed(v); };
  return self_->uploadState(inDeviceOrder<layout::vec4, Vec3f>(self_->rest, state.positions, pack),
                            inDeviceOrder<layout::vec4, Vec3f>(self_->rest, state.velocities, pack));
}

void Simulation::placeBodies(std::span<const BodyPose> poses) {
  RINGLET_ASSERT(poses.size() == self_->world.bodyCount(), "every body has a place");
  self_->world.placeBodies(poses);
}

Status Simulation::placeRoots(std::span<const BodyPose> now, std::span<const BodyPose> oneStepEarlier) {
  if (Status status = self_->finishFrames(); !status) return status;
  self_->roots.place(now, oneStepEarlier);
  if (self_->contacts) {
    if (Status status = self_->contacts->forget(); !status) return status;
  }
  return self_->placeAtRest();
}

Status Simulation::setRootShifts(std::span<const Vec3d> shifts) {
  std::vector<layout::StrandRest>& strands = self_->rest.strands;
  RINGLET_ASSERT(shifts.size() == strands.size(), "every strand has a root shift");
  if (Status status = self_->finishFrames(); !status) return status;
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const Vec3f shift = static_cast<Vec3f>(shifts[self_->rest.strandInGroom[s]]);
    strands[s].pins[0].w = shift.x, strands[s].pins[1].w = shift.y, strands[s].pins[2].w = shift.z;
  }
  return self_->buffers.strands.upload(std::as_bytes(std::span(strands)));
}

const HeadPose& Simulation::head() const { return self_->head.now; }

Result<SimulationReport> Simulation::report() const {
  if (Status status = self_->finishFrames(); !status) return status.error();
  auto reports = downloadAll<layout::StrandReport>(self_->buffers.reports, self_->rest.strands.size());
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
  if (Status status = self_->finishFrames(); !status) return status.error();
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
  if (Status status = self_->finishFrames(); !status) return status.error();
  return self_->contacts->listed(self_->rest);
}

const std::vector<std::string>& Simulation::warnings() const { return self_->rest.warnings; }
std::map<std::string, double> Simulation::stageMilliseconds() const { return self_->stageMilliseconds; }

Result<std::vector<std::array<float, 4>>> Simulation::tap(std::uint32_t field) const {
  RINGLET_ASSERT(self_->choice.taps && field < layout::kTapCount,
                 "taps are written only with KernelChoice::taps");
  if (Status status = self_->finishFrames(); !status) return status.error();
  const std::size_t count = self_->rest.points.size();
  auto values = downloadAll<layout::vec4>(self_->buffers.scratch, count, field * count);
  if (!values) return values.error();
  return inGroomOrder<std::array<float, 4>, layout::vec4>(self_->rest, *values, [](layout::vec4 v) {
    return std::array<float, 4>{v.x, v.y, v.z, v.w};
  });
}

double Simulation::compileMilliseconds() const { return self_->compileMilliseconds; }

std::string Simulation::kernelDescription() const {
  return describe(self_->ranges, self_->device.gpu().properties().subgroupSize);
}

}  // namespace ringlet
