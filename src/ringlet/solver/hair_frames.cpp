// Implements solver/hair_frames.h: each head records its frame into a part of one list.
#include "ringlet/solver/hair_frames.h"

#include <algorithm>
#include <set>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {

// For whoever records frames of several heads.
class HairFrames {
 public:
  static gpu::Device& device(std::span<const HairFrame> frames) { return of(frames.front()).device.gpu(); }
  static Status record(std::span<const HairFrame> frames, gpu::CommandList& list);
  static bool areFree(std::span<const HairFrame> frames) {
    return std::ranges::all_of(frames, [](const HairFrame& f) { return of(f).submitted == of(f).finished; });
  }
  static void lose(std::span<const HairFrame> frames, const Error& why) {
    for (const HairFrame& frame : frames) of(frame).lostFrame = why;
  }

 private:
  static Simulation::Implementation& of(const HairFrame& frame) { return *frame.hair->self_; }
};

Status HairFrames::record(std::span<const HairFrame> frames, gpu::CommandList& list) {
  std::set<const Simulation*> heads;
  for (const HairFrame& frame : frames) heads.insert(frame.hair);
  RINGLET_ASSERT(heads.size() == frames.size(), "a head stands twice in one recording");
  for (const HairFrame& frame : frames) {
    RINGLET_ASSERT(&of(frame).device.gpu() == &device(frames), "heads of several devices in one recording");
    if (Status status = of(frame).checkFree(frame); !status) return status;
  }
  for (const HairFrame& frame : frames) {
    if (Status status = of(frame).recordBeside(frame, list); !status) {
      lose(frames, status.error());
      return status;
    }
  }
  return {};
}

// Whether a frame can be recorded now.
Status Simulation::Implementation::checkFree(const HairFrame& frame) const {
  if (lostFrame) return *lostFrame;
  if (divided)
    return Error{"a frame of hair that other devices share is several submissions: step it by itself"};
  if (!fallen.empty()) return Error{"a frame of hair that was cut is several submissions: step it by itself"};
  const std::uint64_t open = submitted - finished;
  const bool isAlone = contacts || isJump(frame.stepPoses);
  if (open == 0 || (!isAlone && open < kFramesInFlight)) return {};
  return Error{isAlone ? "hair with contacts, or of a head that jumps, is recorded when its frame before is "
                         "over: wait for that, and call frameIsOver"
                       : "as many frames of this hair are under way as there may be: wait for the oldest, "
                         "and call frameIsOver"};
}

// Beside what the list has of other heads. The submission's length is the host's.
Status Simulation::Implementation::recordBeside(const HairFrame& frame, gpu::CommandList& list) {
  const auto works = prepareFrame(frame.stepPoses, frame.bodyPoses, frame.rootPoses);
  if (!works) return works.error();
  const std::size_t slot = submitted++ % kFramesInFlight;
  if (*works) {
    SubmissionPace unbounded(0);
    FrameRecording recording{list, unbounded, slot};
    list.beside();
    if (Status status = recordFrame(recording); !status) return status;
    slots[slot].isHosts = true;
  } else {
    waited = ++finished;
  }
  return {};
}

Status Simulation::frameIsOver() {
  Implementation& self = *self_;
  if (self.lostFrame) return *self.lostFrame;
  const auto isHosts = [&](std::uint64_t frame) { return self.slotOf(frame).isHosts; };
  std::uint64_t oldest = self.finished;
  while (oldest < self.submitted && !isHosts(oldest)) ++oldest;
  if (oldest == self.submitted) return {};
  if (Status status = self.finishFrames(oldest); !status) return status;
  if (Status status = self.runToEnd(oldest % kFramesInFlight); !status) {
    self.lostFrame = status.error();
    return status;
  }
  self.waited = ++self.finished;
  return {};
}

Status stepFrames(std::span<const HairFrame> frames) {
  if (frames.empty()) return {};
  RINGLET_ASSERT(HairFrames::areFree(frames), "stepFrames while frames are in flight");
  auto recorder = gpu::Recorder::create(HairFrames::device(frames), "frames of several heads");
  if (!recorder) return recorder.error();
  if (Status status = recorder->begin(); !status) return status;
  if (Status status = HairFrames::record(frames, *recorder); !status) return status;
  if (Status status = recorder->submitAndWait(); !status) {
    HairFrames::lose(frames, status.error());
    return status;
  }
  for (const HairFrame& frame : frames) {
    if (Status status = frame.hair->frameIsOver(); !status) {
      HairFrames::lose(frames, status.error());
      return status;
    }
  }
  return {};
}

Status recordFrames(std::span<const HairFrame> frames, void* commandBuffer) {
  if (frames.empty()) return {};
  gpu::CommandList list;
  if (Status status = HairFrames::record(frames, list); !status) return status;
  list.recordInto(HairFrames::device(frames), static_cast<VkCommandBuffer>(commandBuffer));
  return {};
}

}  // namespace ringlet
