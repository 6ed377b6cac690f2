// Implements the frames of solver/simulation.h: a frame is one recorded list of dispatches, replayed with new
// poses; one recording for each frame in flight.
#include <algorithm>
#include <utility>

#include "layout/contacts.h"
#include "layout/strands.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strands/strand_kernels.h"

namespace ringlet {

layout::StepParameters Simulation::Implementation::parametersOf(const StrandKernels& of,
                                                                const PlannedDispatch& dispatch,
                                                                std::uint32_t heads) const {
  layout::StepParameters p{};
  p.gravity = packed3(settings.gravity * (of.areFallen ? 1 : material.gravityFactor));
  p.inertiaFactor = static_cast<float>(of.areFallen ? 1 : material.inertiaFactor);
  p.seconds = static_cast<float>(settings.stepSeconds());
  p.maxStretch = static_cast<float>(settings.maxStretch);
  p.coreRelaxedShare = static_cast<float>(material.coreRelaxedShare);
  p.coreElongationLow = static_cast<float>(material.coreElongationLow);
  p.coreElongationHigh = static_cast<float>(material.coreElongationHigh);
  p.strandBegin = dispatch.strandBegin;
  p.strandEnd = dispatch.strandEnd;
  p.stepBegin = dispatch.stepBegin;
  p.stepEnd = dispatch.stepEnd;
  p.rootCount = of.areFallen ? 1 : static_cast<std::uint32_t>(settings.rootCount);
  p.pointIterations = static_cast<std::uint32_t>(settings.pointIterations);
  p.chebyshev = settings.chebyshev ? 1 : 0;
  p.forceLoops = static_cast<std::uint32_t>(settings.forceLoops);
  p.dampingLoops = static_cast<std::uint32_t>(settings.dampingLoops);
  const GroomChunk& chunk = buffers.chunks[of.ranges[dispatch.range].chunk].part;
  p.particleCount = chunk.particleCount();
  p.phases = dispatch.phases;
  p.bodyCount = static_cast<std::uint32_t>(world.bodyCount());
  p.dragStrength = static_cast<float>(kStandardGravity / (settings.air.fallSpeed * settings.air.fallSpeed));
  p.dragAlong = static_cast<float>(settings.air.alongShare);
  p.strandCount = chunk.strandCount();
  p.stepCount = static_cast<std::uint32_t>(settings.stepsPerFrame);
  p.fieldCount = static_cast<std::uint32_t>(fields.count());
  if (of.areOfHeads) {
    const HeadRow& row = buffers.place->row();
    p.headCount = heads;
    p.headParticles = row.strides.particles;
    p.headStrands = row.strides.strands;
    p.headPoses = row.strides.stepPoses;
  }
  return p;
}

// One stage, or in several submissions one in each.
void Simulation::Implementation::dispatchAll(FrameRecording& frame, const StrandKernels& of,
                                             std::span<const PlannedDispatch> dispatches) const {
  if (dispatches.empty()) return;  // all strands are rigid, or none was cut
  for (std::size_t d = 0; d < dispatches.size(); ++d) {
    const PlannedDispatch& now = dispatches[d];
    const auto particleSteps = static_cast<double>(particleStepsOf(now, of.ranges));
    frame.particleSteps += particleSteps;
    const bool cuts = frame.pace.cutsBeforeStrands(particleSteps);
    if (cuts && d > 0) frame.list.endStage();
    if (cuts) frame.list.cut();
    if (cuts || d == 0) frame.list.beginStage(SubmissionPace::kStrandStage);
    // Dispatches on other strands may overlap. The validation layer sees whole buffers, and would take them
    // for hazards.
    const bool isValidated = device.gpu().validationLog() != nullptr;
    const bool readsLast = d > 0 && sharesStrands(dispatches[d - 1], now);
    if (!cuts && (readsLast || (isValidated && (d > 0 || of.areFallen)))) frame.list.barrier();
    if (frame.heads == 0) continue;
    frame.list.dispatch(*of.kernels[of.kernelOf[now.range]], of.bindingsOf(now.range, frame.heads),
                        parametersOf(of, now, frame.heads),
                        groupCountOf(now, of.ranges[now.range].shape, asset->groupSize, frame.heads));
  }
  frame.list.endStage();
}

// What the host wrote for the frame, to where kernels read it.
void Simulation::Implementation::recordInputs(FrameRecording& frame) const {
  buffers.poses.record(frame.list, frame.slot);
  world.record(frame.list, frame.slot);
  roots.record(frame.list, frame.slot);
  forces.record(frame.list, frame.slot);
  goals.record(frame.list, frame.slot);
  fields.record(frame.list, frame.slot);
}

// What a frame brings back to the host, also one without steps. Without timestamps a submission's time is
// divided among its stages: stepping then keeps all of it. Each submission of divided hair brings its control
// block back.
void Simulation::Implementation::recordEnd(FrameRecording& frame) const {
  const bool isTimed = readsBack && device.gpu().properties().hasTimestamps;
  if (isTimed) frame.list.beginStage(kCopyStage);
  slots[frame.slot].recordPositions(frame.list);
  if (isTimed) frame.list.endStage();
  if (contactKinds().any() && !divided) buffers.recordControl(frame.list);
}

Status Simulation::Implementation::recordSteps(FrameRecording& frame) const {
  for (const StrandKernels* of : {&strandKernels, &fallenKernels}) {
    const auto dispatches = planFrame(of->ranges, asset->limits, settings, world.bodyCount(),
                                      asset->groupSize, frame.pace.mostParticleSteps());
    if (!dispatches) return dispatches.error();
    dispatchAll(frame, *of, *dispatches);
  }
  return {};
}

Status Simulation::Implementation::recordSolve(FrameRecording& frame, const PlannedStage& stage) const {
  for (const StrandKernels* of :
       {stage.withoutBodies ? &firstSolveKernels : &strandKernels, &fallenKernels}) {
    const std::size_t bodies = of == &firstSolveKernels ? 0 : world.bodyCount();
    auto dispatches = planPass(of->ranges, asset->limits, settings, bodies, asset->groupSize, stage.pass,
                               frame.pace.mostParticleSteps());
    if (!dispatches) return dispatches.error();
    if (stage.strands != StrandsOf::all) {
      const bool isBorder = stage.strands == StrandsOf::border;
      std::erase_if(*dispatches, [&](const PlannedDispatch& dispatch) {
        return isBorder != (dispatch.strandEnd <= asset->halo->borderCount);
      });
    }
    dispatchAll(frame, *of, *dispatches);
  }
  return {};
}

void Simulation::Implementation::recordRows(FrameRecording& frame, const PlannedStage& stage) const {
  const bool isOut = stage.stage == FrameStage::rowsOut;
  frame.pace.beginStage(frame.list, isOut ? "part_pack" : "part_unpack");
  if (isOut) {
    divided->recordOut(frame.list, stage.rows);
  } else {
    divided->recordIn(frame.list, stage.rows);
  }
  frame.list.endStage();
}

Status Simulation::Implementation::record(FrameRecording& frame, const PlannedStage& stage) const {
  gpu::CommandList& list = frame.list;
  SubmissionPace& now = frame.pace;
  const bool isRepeated = frame.repeatsStep && stage.whose == layout::kOfElsewhere;
  switch (stage.stage) {
    case FrameStage::inputs:
      recordInputs(frame);
      break;
    case FrameStage::steps:
      return recordSteps(frame);
    case FrameStage::solve:
      return recordSolve(frame, stage);
    case FrameStage::motion:
      contacts->recordMotion(list, now, stage.step, isRepeated ? layout::kOfAll : stage.whose);
      break;
    case FrameStage::grid:
      contacts->recordGrid(list, now, stage.step);
      break;
    case FrameStage::lists:
      contacts->recordLists(list, now, stage.step);
      break;
    case FrameStage::touch:
      contacts->recordFirst(list, now);
      break;
    case FrameStage::next:
      contacts->recordNext(list, now);
      break;
    case FrameStage::brought:
      volume->recordBrought(list, now, stage.step, stage.isFirst);
      break;
    case FrameStage::sort:
      volume->recordSort(list, now, stage.step);
      break;
    case FrameStage::sums:
      volume->recordSums(list, now, stage.step);
      break;
    case FrameStage::means:
      volume->recordMeans(list, now, stage.step);
      break;
    case FrameStage::reach:
      volume->recordReach(list);
      break;
    case FrameStage::rowsOut:
    case FrameStage::rowsIn:
      recordRows(frame, stage);
      break;
    case FrameStage::exchange:
      break;  // it ends the submission
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
      .iterations = static_cast<std::uint32_t>(settings.contacts.iterationCount(contacts.has_value())),
      .contacts = contactKinds(),
      .sleeps = stillness.sleeps(),
      .predictsWithoutBodies = firstSolveKernels.areThere(),
      .isDivided = divided.has_value(),
      .samples = contacts && contacts->samples()};
  if (volume) needs.sorts = [this](std::uint32_t step) { return volume->sorts(step); };
  return stagesOf(needs);
}

// The whole frame, once: what changes from frame to frame is in its inputs.
Status Simulation::Implementation::recordFrame(FrameRecording& frame) const {
  frame.pace.beginRecording();
  return record(frame, planStages());
}

// A frame of this slot's, to be submitted as often as wanted.
Status Simulation::Implementation::recordSlot(std::size_t slot) {
  FrameSlot& of = slots[slot];
  if (Status status = of.recorder.begin(); !status) return status;
  FrameRecording frame{of.recorder, pace, slot};
  if (Status status = recordFrame(frame); !status) return status;
  of.particleSteps = frame.particleSteps;
  of.recorded = wantedRecording();
  if (volume) of.untilSort = volume->untilSort();
  return {};
}

// What is left of a frame that halted.
Status Simulation::Implementation::recordRest(std::size_t slot) {
  FrameSlot& of = slots[slot];
  of.recorded = FrameSlot::Recorded::nothing;
  if (Status status = of.recorder.begin(); !status) return status;
  FrameRecording frame{of.recorder, pace, slot};
  frame.pace.beginRecording();
  const std::vector<PlannedStage> plan = planStages();
  const std::size_t begin = contactsBegin(plan, contacts->haltedStep());
  if (Status status = record(frame, std::span(plan).subspan(begin)); !status) return status;
  of.particleSteps = frame.particleSteps;
  return {};
}

// Whether all that acts on the hair in a frame did so in the one before.
bool Simulation::Implementation::isQuiet(std::span<const HeadPose> stepPoses,
                                         std::span<const BodyPose> bodyPoses,
                                         std::span<const BodyPose> rootPoses) const {
  const auto isThere = [&](const HeadPose& pose) {
    return pose.position == head.now.position && normalized(pose.rotation) == head.now.rotation &&
           pose.shift == head.now.shift;
  };
  return isThere(head.oneStepEarlier) && std::ranges::all_of(stepPoses, isThere) &&
         world.isQuiet(bodyPoses) && fields.areQuiet() && roots.areStill(rootPoses);
}

// What the host does before a frame. Whether the device has something to do: not where the head jumps.
Result<bool> Simulation::Implementation::prepareFrame(std::span<const HeadPose> stepPoses,
                                                      std::span<const BodyPose> bodyPoses,
                                                      std::span<const BodyPose> rootPoses) {
  const bool jumps = isJump(stepPoses);
  stillness.begin(settings.sleepSpeed > 0 && !jumps && isQuiet(stepPoses, bodyPoses, rootPoses));
  const std::size_t slot = submitted % kFramesInFlight;
  if (jumps) {
    if (Status status = jumpTo(stepPoses.back(), bodyPoses, rootPoses); !status) return status.error();
    stillness.observe({}, 0);
  } else {
    writePoses(slot, stepPoses, bodyPoses, rootPoses);
    rigidHair.endFrame(rootPoses);
  }
  if (volume && !jumps && !stillness.sleeps())
    volume->beginFrame(static_cast<std::uint32_t>(stepPoses.size()));
  slots[slot].rigid = rigidHair.positions(head.now);
  stepsDone += stepPoses.size();
  isReadBack = readsBack;
  return !jumps;
}

Status Simulation::Implementation::submitFrame(std::span<const HeadPose> stepPoses,
                                               std::span<const BodyPose> bodyPoses,
                                               std::span<const BodyPose> rootPoses) {
  if (lostFrame) return *lostFrame;
  RINGLET_ASSERT(submitted - waited < kFramesInFlight, "more frames in flight than there are places");
  // A frame with contacts may not be over when the device stops.
  if (contacts || divided || isJump(stepPoses)) {
    if (Status status = finishFrames(); !status) return status;
  }
  const auto works = prepareFrame(stepPoses, bodyPoses, rootPoses);
  if (!works) return works.error();
  const std::size_t slot = submitted % kFramesInFlight;
  if (*works && divided) {
    if (Status status = runParts(slot); !status) {
      divided->fail(status.error());
      lostFrame = status.error();
      return status;
    }
    slots[slot].arrive(asset->framePlaces);
    ++finished;
  } else if (*works) {
    if (!isRecorded(slots[slot])) {
      if (Status status = recordSlot(slot); !status) return status;
    }
    if (Status status = slots[slot].recorder.submit(); !status) return status;
  } else {
    ++finished;
  }
  ++submitted;
  return {};
}

// Until frame `end`, not itself, is over.
Status Simulation::Implementation::finishFrames(std::uint64_t end) {
  if (lostFrame) return *lostFrame;
  for (; finished < end; ++finished) {
    const std::size_t slot = finished % kFramesInFlight;
    if (slots[slot].isHosts)
      return Error{
          "a frame of this hair is in a host's commands: say that the frame is over once they are done"};
    if (Status status = runToEnd(slot); !status) {
      lostFrame = status.error();
      return status;
    }
  }
  return {};
}

void Simulation::Implementation::addTimes(const gpu::Recorder& recorder) {
  for (const auto& [stage, milliseconds] : recorder.stageMilliseconds())
    stageMilliseconds[stage] += milliseconds;
  hostMilliseconds.submit += recorder.submitMilliseconds();
  hostMilliseconds.fence += recorder.fenceMilliseconds();
}

// A frame that stopped because a list was too long goes on from its step with longer ones: no pair is
// dropped. Commands of a host's are done.
Status Simulation::Implementation::runToEnd(std::size_t slot) {
  gpu::Recorder& recorder = slots[slot].recorder;
  for (bool isHosts = std::exchange(slots[slot].isHosts, false);; isHosts = false) {
    if (!isHosts) {
      if (Status status = recorder.wait(); !status) return status;
      addTimes(recorder);
    }
    if (contacts) contacts->readControl();
    if ((contacts || volume) && buffers.control().isHalted == layout::kHaltedByTurns) {
      return Error{kTooManyNear};
    }
    const bool isHalted = contacts && contacts->isHalted();
    // A frame that stopped, or sleeps, says nothing of how long its work takes.
    const double work = slots[slot].particleSteps;
    if (isHalted || (!isHosts && work > 0 && pace.learn(recorder.stageMilliseconds(), work))) {
      forgetRecordings();
    }
    if (!isHalted) {
      slots[slot].arrive(asset->framePlaces);
      const bool isWatched = settings.sleepSpeed > 0;
      stillness.observe(isWatched ? slots[slot].positions() : std::span<const Vec3f>(),
                        settings.sleepSpeed / settings.framesPerSecond);
      return {};
    }
    if (Status status = contacts->makeRoom(); !status) return status;
    if (Status status = recordRest(slot); !status) return status;
    if (Status status = recorder.submit(); !status) return status;
  }
}

void Simulation::Implementation::writePoses(std::size_t slot, std::span<const HeadPose> stepPoses,
                                            std::span<const BodyPose> bodyPoses,
                                            std::span<const BodyPose> rootPoses) {
  const double T = settings.stepSeconds();
  std::vector<HeadPose> heads{head.oneStepEarlier, head.now};
  heads.insert(heads.end(), stepPoses.begin(), stepPoses.end());
  world.writeFrame(slot, std::span(heads).subspan(1), bodyPoses, seconds());
  roots.writeFrame(slot, heads, rootPoses);
  forces.writeFrame(slot);
  goals.writeFrame(slot);
  fields.writeFrame(slot, std::span(heads).subspan(1), T);
  const auto poses = buffers.poses.of<layout::StepPose>(slot);
  const auto rotation = [&] { return packed(head.now.rotation); };
  poses[0] = {rotation(), packed(head.turn()), {}, static_cast<float>(head.now.shift)};
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    const Vec3d before = head.velocity(T);
    head = {head.now, stepPoses[k]};
    head.now.rotation = normalized(head.now.rotation);
    poses[1 + k] = {rotation(), packed(head.turn()), packed3(head.velocity(T) - before),
                    static_cast<float>(head.now.shift)};
  }
}

// A frame that no kernel steps.
Status Simulation::Implementation::jumpTo(const HeadPose& end, std::span<const BodyPose> bodyPoses,
                                          std::span<const BodyPose> rootPoses) {
  world.endFrame(end, bodyPoses);
  fields.endFrame();
  roots.endFrame(rootPoses);
  rigidHair.jump(rootPoses);
  if (Status status = carryTo(end); !status) return status;
  return slotOf(submitted).downloadPositions(asset->framePlaces);
}

Status Simulation::stepFrame(std::span<const HeadPose> stepPoses, std::span<const BodyPose> bodyPoses,
                             std::span<const BodyPose> rootPoses) {
  RINGLET_ASSERT(self_->lostFrame || self_->waited == self_->submitted,
                 "stepFrame while frames are in flight");
  if (Status status = submitFrame(stepPoses, bodyPoses, rootPoses); !status) return status;
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
  std::vector<Vec3f> all(self_->rest.groomParticleCount);
  framePositions(all);
  return all;
}

const FrameSlot& Simulation::Implementation::waitedSlot() {
  RINGLET_ASSERT(readsBack, "positions of a frame of a simulation that reads nothing back");
  RINGLET_ASSERT(waited > 0 && submitted - waited < kFramesInFlight,
                 "positions of a frame before waitFrame, or after its place was taken");
  return slotOf(waited - 1);
}

void Simulation::framePositions(std::span<Vec3f> all) const {
  self_->waitedSlot().copyPositions(self_->rest, self_->asset->framePlaces, self_->rigidHair, all);
}

std::span<const Vec3f> Simulation::frameView() const {
  RINGLET_ASSERT(self_->asset->framePlaces.areOfGroom, "a view of the positions of divided hair");
  return self_->waitedSlot().viewPositions(self_->rigidHair);
}

Status Simulation::stepFrame(const HeadPose& end) {
  const HeadPose start = self_->head.now;
  std::vector<HeadPose> poses;
  for (int k = 1; k <= self_->settings.stepsPerFrame; ++k) {
    poses.push_back(interpolate(start, end, double(k) / self_->settings.stepsPerFrame));
  }
  return stepFrame(poses);
}

}  // namespace ringlet
