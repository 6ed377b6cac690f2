// Implements the frames of solver/simulation.h: a frame is one recorded list of dispatches, replayed with new
// poses; one recording for each frame in flight.
#include <algorithm>

#include "ringlet/base/assert.h"
#include "ringlet/solver/packed.h"
#include "ringlet/solver/simulation_implementation.h"
#include "ringlet/solver/strand_kernels.h"

namespace ringlet {

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

// One stage, or in several submissions one in each.
void Simulation::Implementation::dispatchAll(FrameSlot& slot, std::span<const PlannedDispatch> dispatches) {
  if (dispatches.empty()) return;  // all strands are rigid
  gpu::Recorder& recorder = slot.recorder;
  for (std::size_t d = 0; d < dispatches.size(); ++d) {
    const PlannedDispatch& now = dispatches[d];
    const auto particleSteps = static_cast<double>(particleStepsOf(now, ranges));
    slot.particleSteps += particleSteps;
    const bool cuts = pace.cutsBeforeStrands(particleSteps);
    if (cuts && d > 0) recorder.endStage();
    if (cuts) recorder.cut();
    if (cuts || d == 0) recorder.beginStage(SubmissionPace::kStrandStage);
    // Dispatches on other strands may overlap. The validation layer sees whole buffers, and would take them
    // for hazards.
    const bool isValidated = device.gpu().validationLog() != nullptr;
    if (d > 0 && !cuts && (isValidated || sharesStrands(dispatches[d - 1], now))) recorder.barrier();
    recorder.dispatch(*kernels[kernelOf[now.range]], bindings[now.range], parametersOf(now), now.groupCount);
  }
  recorder.endStage();
}

// A recording takes over what the host wrote for the frame, and at its end brings positions back.
Status Simulation::Implementation::beginFrame(std::size_t slot) {
  gpu::Recorder& recorder = slots[slot].recorder;
  slots[slot].particleSteps = 0;
  pace.beginRecording();
  if (Status status = recorder.begin(); !status) return status;
  buffers.poses.record(recorder, slot);
  world.record(recorder, slot);
  roots.record(recorder, slot);
  recorder.barrier();
  return {};
}

// The whole frame, once: what changes from frame to frame is in its inputs.
Status Simulation::Implementation::recordFrame(std::size_t slot) {
  if (contacts || volume) return recordContactFrame(slot, 0, true);
  const auto plan = planFrame(ranges, device.limits(), settings, world.bodyCount(), kStrandGroupSize,
                              pace.mostParticleSteps());
  if (!plan) return plan.error();
  if (Status status = beginFrame(slot); !status) return status;
  dispatchAll(slots[slot], *plan);
  slots[slot].recordPositions(buffers);
  slots[slot].isRecorded = true;
  return {};
}

Status Simulation::Implementation::recordPass(FrameSlot& slot, const SolvePass& pass) {
  const auto dispatches = planPass(ranges, device.limits(), settings, world.bodyCount(), kStrandGroupSize,
                                   pass, pace.mostParticleSteps());
  if (!dispatches) return dispatches.error();
  dispatchAll(slot, *dispatches);
  slot.recorder.barrier();
  return {};
}

// What strands hear of each other before the first iteration of a step's solve, and before each later one.
// Contacts come first: they may halt, and then the volume must not go on.
void Simulation::Implementation::recordFirstMeeting(gpu::Recorder& recorder, std::uint32_t step) {
  if (contacts) {
    contacts->recordLists(recorder, pace, step);
    recorder.barrier();
    contacts->recordFirst(recorder, pace);
    recorder.barrier();
  }
  if (volume) {
    volume->recordBegin(recorder, pace, step);
    recorder.barrier();
    volume->recordMeans(recorder, pace, step, true);
    recorder.barrier();
  }
}
void Simulation::Implementation::recordNextMeeting(gpu::Recorder& recorder, std::uint32_t step) {
  if (contacts) {
    contacts->recordNext(recorder, pace);
    recorder.barrier();
  }
  if (volume) {
    volume->recordMeans(recorder, pace, step, false);
    recorder.barrier();
  }
}

// The frame from a step on. Between the solves of a step stand its contacts (contact_stage.h,
// volume_stage.h).
Status Simulation::Implementation::recordContactFrame(std::size_t slot, std::uint32_t firstStep,
                                                      bool predictFirst) {
  if (Status status = beginFrame(slot); !status) return status;
  gpu::Recorder& recorder = slots[slot].recorder;
  if (predictFirst) {
    if (Status status = recordPass(slots[slot], {.step = firstStep}); !status) return status;
  }
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  const int iterations = settings.contacts.iterationCount(contacts.has_value());
  for (std::uint32_t step = firstStep; step < steps; ++step) {
    recordFirstMeeting(recorder, step);
    for (int iteration = 1; iteration <= iterations; ++iteration) {
      const bool isLast = iteration == iterations;
      const SolvePass pass{step, true, isLast, isLast && step + 1 < steps};
      if (Status status = recordPass(slots[slot], pass); !status) return status;
      if (!isLast) recordNextMeeting(recorder, step);
    }
  }
  slots[slot].recordPositions(buffers);
  buffers.recordControl(recorder);
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
    rigidHair.endFrame(rootPoses);
    if (!slots[slot].isRecorded) {
      if (Status status = recordFrame(slot); !status) return status;
    }
    if (Status status = slots[slot].recorder.submit(); !status) return status;
  }
  slots[slot].rigid = rigidHair.positions(head.now);
  ++submitted;
  stepsDone += stepPoses.size();
  isReadBack = readsBack;
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
    if (contacts) contacts->readControl();
    if ((contacts || volume) && buffers.control().isHalted == layout::kHaltedByTurns) {
      return Error{
          "more contact particles are near one another than this device can look through; use a smaller "
          "contact radius or volume cell, or fewer strands in one place"};
    }
    const bool isHalted = contacts && contacts->isHalted();
    // A frame that stopped says nothing of how long its work takes.
    if (isHalted || pace.learn(recorder.stageMilliseconds(), slots[slot].particleSteps)) {
      for (FrameSlot& other : slots) other.isRecorded = false;
    }
    if (!isHalted) return {};
    if (Status status = contacts->makeRoom(); !status) return status;
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

// A frame that no kernel steps.
Status Simulation::Implementation::jumpTo(const HeadPose& end, std::span<const BodyPose> bodyPoses,
                                          std::span<const BodyPose> rootPoses) {
  world.endFrame(end, bodyPoses);
  roots.endFrame(rootPoses);
  rigidHair.jump(rootPoses);
  if (Status status = carryTo(end); !status) return status;
  return slotOf(submitted).downloadPositions(buffers);
}

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
  RINGLET_ASSERT(self_->readsBack, "framePositions of a simulation that reads nothing back");
  RINGLET_ASSERT(self_->waited > 0 && self_->submitted - self_->waited < kFramesInFlight,
                 "framePositions before waitFrame, or after its place was taken");
  return self_->slotOf(self_->waited - 1).inGroomOrder(self_->rest, self_->buffers, self_->rigidHair);
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
