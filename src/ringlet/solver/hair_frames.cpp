// Implements solver/hair_frames.h: each head records its frame into a part of one list.
#include "ringlet/solver/hair_frames.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {

// Access to simulations for the functions that record frames of several heads.
class HairFrames {
 public:
  static gpu::Device& device(std::span<const HairFrame> frames) { return of(frames.front()).device().gpu(); }
  static Status record(std::span<const HairFrame> frames, gpu::CommandList& list);
  static bool areFree(std::span<const HairFrame> frames) {
    return std::ranges::all_of(
        frames, [](const HairFrame& f) { return of(f).frames.submitted == of(f).frames.finished; });
  }
  static void lose(std::span<const HairFrame> frames, const Error& why) {
    for (const HairFrame& frame : frames) of(frame).frames.lost = why;
  }

  static Status isOver(Simulation& hair);

 private:
  static std::vector<HairFrame> inRows(std::span<const HairFrame> frames);
  static Status recordAll(std::span<const HairFrame> frames, gpu::CommandList& list);
  static Simulation::Implementation& of(const Simulation& hair) { return *hair.self_; }
  static Simulation::Implementation& of(const HairFrame& frame) { return of(*frame.hair); }
};

// Sorts heads of one row by their place in it, so that one dispatch can step several.
std::vector<HairFrame> HairFrames::inRows(std::span<const HairFrame> frames) {
  std::vector<HairFrame> ordered(frames.begin(), frames.end());
  const auto placeOf = [](const HairFrame& frame) {
    const std::optional<HeadPlace>& place = of(frame).buffers.place;
    return place ? std::pair(&place->row(), place->number()) : std::pair<const HeadRow*, std::uint32_t>();
  };
  std::ranges::stable_sort(ordered, std::less{}, placeOf);
  return ordered;
}

Status HairFrames::record(std::span<const HairFrame> frames, gpu::CommandList& list) {
  std::set<const Simulation*> heads;
  for (const HairFrame& frame : frames) heads.insert(frame.hair);
  RINGLET_ASSERT(heads.size() == frames.size(), "a head stands twice in one recording");
  for (const HairFrame& frame : frames) {
    RINGLET_ASSERT(&of(frame).device().gpu() == &device(frames), "heads of several devices in one recording");
    if (Status status = of(frame).checkFree(frame); !status) return status;
    if (Status status = of(frame).prepare({.roots = !frame.rootPoses.empty()}); !status) return status;
  }
  Status recorded = recordAll(inRows(frames), list);
  if (!recorded) lose(frames, recorded.error());
  return recorded;
}

Status HairFrames::recordAll(std::span<const HairFrame> frames, gpu::CommandList& list) {
  std::vector<bool> works;
  for (const HairFrame& frame : frames) {
    const auto prepared =
        of(frame).prepareFrame(frame.stepPoses, frame.bodyPoses, frame.rootPoses, frame.bodyPoints);
    if (!prepared) return prepared.error();
    works.push_back(*prepared);
  }
  for (std::size_t begin = 0, end = 0; begin < frames.size(); begin = end) {
    const std::size_t most = of(frames[begin]).mostHeadsOfDispatch();
    end = begin + 1;
    while (end < frames.size() && end - begin < most && works[begin] && works[end] &&
           of(frames[end]).goesWith(of(frames[end - 1])))
      ++end;
    for (std::size_t k = begin; k < end; ++k) {
      const auto stepped = static_cast<std::uint32_t>(k == begin ? end - begin : 0);
      if (Status status = of(frames[k]).recordBeside(list, works[k], stepped); !status) return status;
    }
  }
  return {};
}

// Whether a frame can be recorded now.
Status Simulation::Implementation::checkFree(const HairFrame& frame) const {
  if (frames.lost) return *frames.lost;
  if (Status status = device().checkProcess(); !status) return status;
  if (contacts.isInParts())
    return Error{
        "a frame of hair that other devices share, or that is kept from going through hair, is several "
        "submissions: step it by itself"};
  const std::uint64_t open = frames.submitted - frames.finished;
  const bool isAlone = contacts.pairs || isJump(frame.stepPoses);
  if (open == 0 || (!isAlone && open < kFramesInFlight)) return {};
  return Error{
      isAlone
          ? "hair with contacts, or of a head that jumps, is recorded when its frame before is over: wait "
            "for that, and say that the frame is over"
          : "as many frames of this hair are under way as there may be: wait for the oldest, and say that "
            "the frame is over"};
}

std::size_t Simulation::Implementation::mostHeadsOfDispatch() const {
  std::uint32_t groups = 1;
  for (const StrandRange& range : featurePlan->ranges) {
    const PlannedDispatch whole{.strandBegin = range.begin, .strandEnd = range.end};
    groups = std::max(groups, groupCountOf(whole, range.shape, featurePlan->groupSize));
  }
  return std::max(1u, asset->limits.maxGroupCount / groups);
}

// Whether this head can join the dispatches of the head just before it in the same row, as one head more.
bool Simulation::Implementation::goesWith(const Implementation& before) const {
  const auto isOfRow = [](const Implementation& one) {
    return one.kernels.strands.areOfHeads && one.buffers.sharesConstants() && !one.stillness.sleeps();
  };
  if (asset != before.asset || !isOfRow(*this) || !isOfRow(before)) return false;
  const HeadPlace &here = *buffers.place, &there = *before.buffers.place;
  if (&here.row() != &there.row() || here.number() != there.number() + 1) return false;
  const layout::HairNumbers own = numbers(), others = before.numbers();
  return std::ranges::equal(std::as_bytes(std::span(&own, 1)), std::as_bytes(std::span(&others, 1)));
}

// Records the frame beside those of other heads in the list. The caller decides the length of the submission.
// `heads`: see FrameRecording.
Status Simulation::Implementation::recordBeside(gpu::CommandList& list, bool works, std::uint32_t heads) {
  const std::size_t slot = frames.slotNumber(frames.submitted++);
  if (!works) {
    frames.waited = ++frames.finished;
    return {};
  }
  SubmissionPace unbounded(0);
  FrameRecording recording{list, unbounded, slot, heads};
  if (Status status = bindHeads(heads); !status) return status;
  list.beside();
  if (Status status = recordFrame(recording); !status) return status;
  frames.slots[slot].isHosts = true;
  return {};
}

Status HairFrames::isOver(Simulation& hair) {
  Simulation::Implementation& self = of(hair);
  if (self.frames.lost) return *self.frames.lost;
  const auto isHosts = [&](std::uint64_t frame) { return self.frames.slotOf(frame).isHosts; };
  std::uint64_t oldest = self.frames.finished;
  while (oldest < self.frames.submitted && !isHosts(oldest)) ++oldest;
  if (oldest == self.frames.submitted) return {};
  if (Status status = self.finishFrames(oldest); !status) return status;
  if (Status status = self.runToEnd(self.frames.slotNumber(oldest)); !status) {
    self.frames.lost = status.error();
    return status;
  }
  self.frames.waited = ++self.frames.finished;
  return {};
}

Status frameIsOver(Simulation& hair) { return HairFrames::isOver(hair); }

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
    if (Status status = frameIsOver(*frame.hair); !status) {
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
