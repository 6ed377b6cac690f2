// Implements the frames of solver/simulation.h: a frame is one recorded list of dispatches, replayed with new
// poses; one recording for each frame in flight.
#include <algorithm>
#include <utility>
#include <vector>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {

layout::HairNumbers Simulation::Implementation::numbers() const {
  layout::HairNumbers n{};
  n.gravity = packed3(settings.gravity * material.gravityFactor);
  n.inertiaFactor = static_cast<float>(material.inertiaFactor);
  n.fallGravity = packed3(settings.gravity);
  n.seconds = static_cast<float>(settings.stepSeconds());
  n.maxStretch = static_cast<float>(settings.maxStretch);
  n.coreRelaxedShare = static_cast<float>(material.coreRelaxedShare);
  n.coreElongationLow = static_cast<float>(material.coreElongationLow);
  n.coreElongationHigh = static_cast<float>(material.coreElongationHigh);
  n.dragStrength = static_cast<float>(kStandardGravity / (settings.air.fallSpeed * settings.air.fallSpeed));
  n.dragAlong = static_cast<float>(settings.air.alongShare);
  n.rootCount = static_cast<std::uint32_t>(settings.rootCount);
  n.stepCount = static_cast<std::uint32_t>(settings.stepsPerFrame);
  n.bodyCount = static_cast<std::uint32_t>(bodyCount());
  n.fieldCount = static_cast<std::uint32_t>(inputs.get<FieldsInput>().count());
  n.pointIterations = static_cast<std::uint32_t>(settings.pointIterations);
  n.chebyshev = settings.chebyshev ? 1 : 0;
  n.forceLoops = static_cast<std::uint32_t>(settings.forceLoops);
  n.dampingLoops = static_cast<std::uint32_t>(settings.dampingLoops);
  return n;
}

layout::StepParameters Simulation::Implementation::parametersOf(const StrandKernels& of,
                                                                const PlannedDispatch& dispatch,
                                                                std::uint32_t heads) const {
  layout::StepParameters p{};
  p.strandBegin = dispatch.strandBegin;
  p.strandEnd = dispatch.strandEnd;
  p.stepBegin = dispatch.stepBegin;
  p.stepEnd = dispatch.stepEnd;
  p.phases = dispatch.phases;
  const GroomChunk& chunk = buffers.chunks[(*of.ranges)[dispatch.range].chunk].part;
  p.particleCount = chunk.particleCount();
  p.strandCount = chunk.strandCount();
  if (of.areOfHeads) {
    const HeadRow& row = buffers.place->row();
    p.headCount = heads;
    p.headParticles = row.strides.particles;
    p.headStrands = row.strides.strands;
    p.headPoses = row.strides.stepPoses;
  }
  return p;
}

// One stage; if it is cut into several submissions, one stage in each.
void Simulation::Implementation::dispatchAll(FrameRecording& frame, const StrandKernels& of,
                                             std::span<const PlannedDispatch> dispatches) const {
  if (dispatches.empty()) return;  // all strands are rigid, or none was cut
  for (std::size_t d = 0; d < dispatches.size(); ++d) {
    const PlannedDispatch& now = dispatches[d];
    const auto particleSteps = static_cast<double>(particleStepsOf(now, *of.ranges));
    frame.particleSteps += particleSteps;
    const bool cuts = frame.pace.cutsBeforeStrands(particleSteps);
    if (cuts && d > 0) frame.list.endStage();
    if (cuts) frame.list.cut();
    if (cuts || d == 0) frame.list.beginStage(SubmissionPace::kStrandStage);
    // Dispatches of different strands may overlap. The validation layer tracks whole buffers and would report
    // these as hazards, so there they get a barrier.
    const bool isValidated = device().gpu().validationLog() != nullptr;
    const bool readsLast = d > 0 && sharesStrands(dispatches[d - 1], now);
    if (!cuts && (readsLast || (isValidated && (d > 0 || of.areFallen)))) frame.list.barrier();
    if (frame.heads == 0) continue;
    frame.list.dispatch(
        *of.kernels[of.kernelOf[now.range]], of.bindingsOf(now.range, frame.heads),
        parametersOf(of, now, frame.heads),
        groupCountOf(now, (*of.ranges)[now.range].shape, featurePlan->groupSize, frame.heads));
  }
  frame.list.endStage();
}

// The cloth near to the particles of these dispatches' strands, at the step's start.
void Simulation::Implementation::listCloth(FrameRecording& frame, const StrandKernels& of,
                                           std::span<const PlannedDispatch> dispatches) const {
  if (!of.cloth || dispatches.empty()) return;
  frame.pace.beginStage(frame.list, "cloth_near");
  const bool isValidated = device().gpu().validationLog() != nullptr;  // as dispatchAll
  for (const PlannedDispatch& now : dispatches) {
    const std::uint32_t size = of.cloth->groupSize(), most = (*of.ranges)[now.range].longest;
    const std::uint64_t invocations = std::uint64_t{device().gpu().properties().maxGroupCount} * size;
    const auto atOnce =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(invocations / most, 1, UINT32_MAX));
    layout::StepParameters parameters = parametersOf(of, now, 1);
    parameters.phases = most;
    for (std::uint32_t begin = now.strandBegin; begin < now.strandEnd;
         begin += parameters.strandEnd - begin) {
      parameters.strandBegin = begin;
      parameters.strandEnd = begin + std::min(atOnce, now.strandEnd - begin);
      const std::uint32_t items = (parameters.strandEnd - begin) * most;
      if (isValidated) frame.list.barrier();
      frame.list.dispatch(*of.cloth, of.clothBindings[now.range], parameters, (items + size - 1) / size);
    }
  }
  frame.list.endStage();
}

// Copies results to the host; frames without steps do this too. The copy is a stage of its own only with
// timestamps: without them a submission's time is divided among its stages, and all of it belongs to
// stepping. With divided hair every submission copies the control block back (startPart).
void Simulation::Implementation::recordEnd(FrameRecording& frame) const {
  const bool isTimed = frames.readBack() && device().gpu().properties().hasTimestamps;
  if (isTimed) frame.list.beginStage(kCopyStage);
  frames.slots[frame.slot].recordPositions(frame.list);
  if (isTimed) frame.list.endStage();
  if (contacts.kinds().any() && !contacts.divided) buffers.recordControl(frame.list);
}

Status Simulation::Implementation::recordSteps(FrameRecording& frame) const {
  for (const StrandKernels* of : {&kernels.strands, &kernels.fallen}) {
    const DispatchRoom room{asset->limits, featurePlan->groupSize, frame.pace.mostParticleSteps()};
    const auto dispatches = planFrame(*of->ranges, room, settings, bodyCount());
    if (!dispatches) return dispatches.error();
    dispatchAll(frame, *of, *dispatches);
  }
  return {};
}

Status Simulation::Implementation::recordSolve(FrameRecording& frame, const PlannedStage& stage) const {
  std::vector<std::pair<const StrandKernels*, std::vector<PlannedDispatch>>> planned;
  for (const StrandKernels* of :
       {stage.withoutBodies ? &kernels.firstSolve : &kernels.strands, &kernels.fallen}) {
    const std::size_t bodies = of == &kernels.firstSolve ? 0 : bodyCount();
    const DispatchRoom room{asset->limits, featurePlan->groupSize, frame.pace.mostParticleSteps()};
    auto dispatches = planPass(*of->ranges, room, settings, bodies, stage.pass);
    if (!dispatches) return dispatches.error();
    if (stage.strands != StrandsOf::all) {
      const bool isBorder = stage.strands == StrandsOf::border;
      std::erase_if(*dispatches, [&](const PlannedDispatch& dispatch) {
        return isBorder != (dispatch.strandEnd <= asset->halo->borderCount);
      });
    }
    planned.emplace_back(of, std::move(*dispatches));
  }
  if (stage.listsCloth) {
    for (const auto& [of, dispatches] : planned) listCloth(frame, *of, dispatches);
    frame.list.barrier();
  }
  for (const auto& [of, dispatches] : planned) dispatchAll(frame, *of, dispatches);
  return {};
}

void Simulation::Implementation::recordRows(FrameRecording& frame, const PlannedStage& stage) const {
  const bool isOut = stage.stage == FrameStage::rowsOut;
  frame.pace.beginStage(frame.list, isOut ? "part_pack" : "part_unpack");
  if (isOut) {
    contacts.divided->recordOut(frame.list, stage.rows);
  } else {
    contacts.divided->recordIn(frame.list, stage.rows);
  }
  frame.list.endStage();
}

Status Simulation::Implementation::record(FrameRecording& frame, const PlannedStage& stage) const {
  gpu::CommandList& list = frame.list;
  SubmissionPace& now = frame.pace;
  const bool isRepeated = frame.repeatsStep && stage.whose == layout::kOfElsewhere;
  switch (stage.stage) {
    case FrameStage::inputs:
      for (const FrameInput* input : inputs.each()) input->record(list, frame.slot);
      break;
    case FrameStage::bodies:
      now.beginStage(list, "mesh_fields");
      inputs.get<BodiesInput>().recordFields(list, frame.slot);
      list.endStage();
      break;
    case FrameStage::steps:
      return recordSteps(frame);
    case FrameStage::solve:
      return recordSolve(frame, stage);
    case FrameStage::motion:
      contacts.pairs->recordMotion(list, now, stage.step, isRepeated ? layout::kOfAll : stage.whose);
      break;
    case FrameStage::grid:
      contacts.pairs->recordGrid(list, now, stage.step);
      break;
    case FrameStage::lists:
      contacts.pairs->recordLists(list, now, stage.step);
      break;
    case FrameStage::touch:
      contacts.pairs->recordFirst(list, now);
      break;
    case FrameStage::next:
      contacts.pairs->recordNext(list, now);
      break;
    case FrameStage::brought:
      contacts.volume->recordBrought(list, now, {stage.step, stage.isFirst});
      break;
    case FrameStage::sort:
      contacts.volume->recordSort(list, now, stage.step);
      break;
    case FrameStage::sums:
      contacts.volume->recordSums(list, now, {stage.step, stage.isFirst});
      break;
    case FrameStage::means:
      contacts.volume->recordMeans(list, now, {stage.step, stage.isFirst});
      break;
    case FrameStage::reach:
      contacts.volume->recordReach(list);
      break;
    case FrameStage::rowsOut:
    case FrameStage::rowsIn:
      recordRows(frame, stage);
      break;
    case FrameStage::exchange:
      break;  // ends the submission (divided_frames.cpp)
    case FrameStage::end:
      recordEnd(frame);
      break;
  }
  return {};
}

Status Simulation::Implementation::record(FrameRecording& frame, std::span<const PlannedStage> stages) const {
  for (const PlannedStage& stage : stages) {
    if (Status status = record(frame, stage); !status) return status;
    if (stage.barrier) frame.list.barrier();
  }
  return {};
}

std::vector<PlannedStage> Simulation::Implementation::planStages() const {
  FrameNeeds needs{
      .steps = static_cast<std::uint32_t>(settings.stepsPerFrame),
      .iterations = static_cast<std::uint32_t>(settings.contacts.iterationCount(contacts.pairs.has_value())),
      .contacts = contacts.kinds(),
      .sleeps = stillness.sleeps(),
      .bends = inputs.get<BodiesInput>().bends(),
      .hasCloth = kernels.strands.cloth != nullptr,
      .predictsWithoutBodies = kernels.firstSolve.areThere(),
      .isDivided = contacts.divided.has_value(),
      .samples = contacts.pairs && contacts.pairs->samples(),
      .keepsApart = contacts.crossings.has_value()};
  if (contacts.volume) needs.sorts = [this](std::uint32_t step) { return contacts.volume->sorts(step); };
  return stagesOf(needs);
}

// Records the whole frame. It can be submitted again, since what changes from frame to frame is in its
// inputs.
Status Simulation::Implementation::recordFrame(FrameRecording& frame) const {
  frame.pace.beginRecording();
  return record(frame, planStages());
}

// Records the frame of this slot.
Status Simulation::Implementation::recordSlot(std::size_t slot) {
  FrameSlot& of = frames.slots[slot];
  if (Status status = of.recorder.begin(); !status) return status;
  FrameRecording frame{of.recorder, pace, slot};
  if (Status status = recordFrame(frame); !status) return status;
  of.particleSteps = frame.particleSteps;
  of.recorded = wantedRecording();
  of.fieldWork = inputs.get<BodiesInput>().fieldWork(slot);
  if (contacts.volume) of.untilSort = contacts.volume->untilSort();
  return {};
}

// Records the rest of a frame that halted, from the contacts of the halted step on.
Status Simulation::Implementation::recordRest(std::size_t slot) {
  FrameSlot& of = frames.slots[slot];
  of.recorded = FrameSlot::Recorded::nothing;
  if (Status status = of.recorder.begin(); !status) return status;
  FrameRecording frame{of.recorder, pace, slot};
  frame.pace.beginRecording();
  const std::vector<PlannedStage> plan = planStages();
  const std::size_t begin = contactsBegin(plan, contacts.pairs->haltedStep());
  if (Status status = record(frame, std::span(plan).subspan(begin)); !status) return status;
  of.particleSteps = frame.particleSteps;
  return {};
}

// The host's work before a frame. Returns whether the device has work: it has none where the head jumps.
Result<bool> Simulation::Implementation::prepareFrame(std::span<const HeadPose> stepPoses,
                                                      std::span<const BodyPose> bodyPoses,
                                                      std::span<const BodyPose> rootPoses,
                                                      BodyPoints bodyPoints) {
  const bool jumps = isJump(stepPoses);
  std::vector<HeadPose> heads{head().oneStepEarlier, head().now};
  heads.insert(heads.end(), stepPoses.begin(), stepPoses.end());
  const FrameContext frame{.heads = heads,
                           .bodyPoses = bodyPoses,
                           .rootPoses = rootPoses,
                           .bodyPoints = bodyPoints,
                           .seconds = clock.seconds(settings.stepSeconds()),
                           .stepSeconds = settings.stepSeconds()};
  const auto isQuiet = [&](const FrameInput* input) { return input->isQuiet(frame); };
  stillness.begin(settings.sleepSpeed > 0 && !jumps && std::ranges::all_of(inputs.each(), isQuiet));
  const std::size_t slot = frames.slotNumber(frames.submitted);
  if (jumps) {
    if (Status status = jump(frame); !status) return status.error();
    stillness.observe({}, 0);
  } else {
    inputs.get<NumbersInput>().set(numbers());
    for (FrameInput* input : inputs.each()) input->writeFrame(slot, frame);
  }
  if (contacts.volume && !jumps && !stillness.sleeps())
    contacts.volume->beginFrame(static_cast<std::uint32_t>(stepPoses.size()));
  if (contacts.crossings) contacts.crossings->beginFrame(std::span(heads).subspan(1));
  frames.slots[slot].rigid = inputs.get<RigidHair>().positions(head().now);
  clock.steps += stepPoses.size();
  frames.isReadBack = frames.readBack();
  return !jumps;
}

Status Simulation::Implementation::submitFrame(std::span<const HeadPose> stepPoses,
                                               std::span<const BodyPose> bodyPoses,
                                               std::span<const BodyPose> rootPoses, BodyPoints bodyPoints) {
  if (frames.lost) return *frames.lost;
  RINGLET_ASSERT(frames.submitted - frames.waited < kFramesInFlight,
                 "more frames in flight than there are places");
  if (Status status = prepare({.roots = !rootPoses.empty()}); !status) return status;
  // A frame with contacts may halt and need to be continued, so the next one cannot be submitted before it
  // has ended.
  if (contacts.pairs || contacts.isInParts() || isJump(stepPoses)) {
    if (Status status = finishFrames(); !status) return status;
  }
  const auto works = prepareFrame(stepPoses, bodyPoses, rootPoses, bodyPoints);
  if (!works) return works.error();
  const std::size_t slot = frames.slotNumber(frames.submitted);
  if (*works && contacts.isInParts()) {
    if (Status status = runParts(slot); !status) {
      if (contacts.divided) contacts.divided->fail(status.error());
      frames.lost = status.error();
      return status;
    }
    arrive(slot);
    ++frames.finished;
  } else if (*works) {
    if (!isRecorded(slot)) {
      if (Status status = recordSlot(slot); !status) return status;
    }
    if (Status status = frames.slots[slot].recorder.submit(); !status) return status;
  } else {
    ++frames.finished;
  }
  ++frames.submitted;
  return {};
}

// Finishes all frames before frame `end`.
Status Simulation::Implementation::finishFrames(std::uint64_t end) {
  if (frames.lost) return *frames.lost;
  for (; frames.finished < end; ++frames.finished) {
    const std::size_t slot = frames.slotNumber(frames.finished);
    if (frames.slots[slot].isHosts)
      return Error{
          "a frame of this hair is in a host's commands: say that the frame is over once they are done"};
    if (Status status = runToEnd(slot); !status) {
      frames.lost = status.error();
      return status;
    }
  }
  return {};
}

void SpentTimes::add(const gpu::Recorder& recorder) {
  for (const auto& [stage, milliseconds] : recorder.stageMilliseconds()) stages[stage] += milliseconds;
  host.submit += recorder.submitMilliseconds();
  host.fence += recorder.fenceMilliseconds();
}

// Takes over the positions of a frame that has ended.
void Simulation::Implementation::arrive(std::size_t slot) {
  frames.slots[slot].arrive(asset->framePlaces);
  const bool isWatched = settings.sleepSpeed > 0;
  stillness.observe(isWatched ? frames.slots[slot].positions() : std::span<const Vec3f>(),
                    settings.sleepSpeed / settings.framesPerSecond);
}

// If a list was too short, the frame halted; it continues from that step with longer lists, so that no pair
// is lost. A frame in a host's commands has been finished by the device when this is called.
Status Simulation::Implementation::runToEnd(std::size_t slot) {
  gpu::Recorder& recorder = frames.slots[slot].recorder;
  for (bool isHosts = std::exchange(frames.slots[slot].isHosts, false);; isHosts = false) {
    if (!isHosts) {
      if (Status status = recorder.wait(); !status) return status;
      times.add(recorder);
    }
    if (contacts.pairs) contacts.pairs->readControl();
    if ((contacts.pairs || contacts.volume) && buffers.control().isHalted == layout::kHaltedByTurns) {
      return Error{kTooManyNear};
    }
    const bool isHalted = contacts.pairs && contacts.pairs->isHalted();
    // The times of a frame that halted, or that has no steps, do not tell how long its work takes.
    const double work = frames.slots[slot].particleSteps;
    if (isHalted || (!isHosts && work > 0 && pace.learn(recorder.stageMilliseconds(), work))) {
      frames.forgetRecordings();
    }
    if (!isHalted) {
      arrive(slot);
      return {};
    }
    if (Status status = contacts.pairs->makeRoom(); !status) return status;
    if (Status status = recordRest(slot); !status) return status;
    if (Status status = recorder.submit(); !status) return status;
  }
}

// A frame in which the head jumps: no kernel steps it.
Status Simulation::Implementation::jump(const FrameContext& frame) {
  const HeadHistory before = head();
  for (FrameInput* input : inputs.each()) input->jump(frame);
  if (Status status = carry(before); !status) return status;
  return frames.slotOf(frames.submitted).downloadPositions(asset->framePlaces);
}

Status Simulation::stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                             std::span<const BodyPose> rootPoses, BodyPoints bodyPoints) {
  RINGLET_ASSERT(self_->frames.lost || self_->frames.waited == self_->frames.submitted,
                 "stepFrame while frames are in flight");
  if (Status status = submitFrame(stepPoses, bodyPoses, rootPoses, bodyPoints); !status) return status;
  return waitFrame();
}

Status Simulation::submitFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                               std::span<const BodyPose> rootPoses, BodyPoints bodyPoints) {
  return self_->submitFrame(stepPoses, bodyPoses, rootPoses, bodyPoints);
}

Status Simulation::waitFrame() {
  RINGLET_ASSERT(self_->frames.waited < self_->frames.submitted, "waitFrame without submitFrame");
  if (Status status = self_->finishFrames(self_->frames.waited + 1); !status) return status;
  ++self_->frames.waited;
  return {};
}

std::vector<Vec3f> Simulation::framePositions() const {
  std::vector<Vec3f> all(self_->rest().groomParticleCount);
  framePositions(all);
  return all;
}

const FrameSlot& Simulation::Implementation::waitedSlot() {
  RINGLET_ASSERT(frames.readBack(), "positions of a frame of a simulation that reads nothing back");
  RINGLET_ASSERT(frames.waited > 0 && frames.submitted - frames.waited < kFramesInFlight,
                 "positions of a frame before waitFrame, or after its place was taken");
  return frames.slotOf(frames.waited - 1);
}

void Simulation::framePositions(std::span<Vec3f> all) const {
  self_->waitedSlot().copyPositions(self_->rest(), self_->asset->framePlaces, self_->inputs.get<RigidHair>(),
                                    all);
}

std::span<const Vec3f> Simulation::frameView() const {
  RINGLET_ASSERT(self_->asset->framePlaces.areOfGroom, "a view of the positions of divided hair");
  return self_->waitedSlot().viewPositions(self_->inputs.get<RigidHair>());
}

Status Simulation::stepFrame(const HeadPose& end) {
  const HeadPose start = self_->head().now;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= self_->settings.stepsPerFrame; ++k) {
    poses.push_back(interpolate(start, end, double(k) / self_->settings.stepsPerFrame));
  }
  return stepFrame(poses);
}

}  // namespace ringlet
