// Implements the frames of divided hair (divided_hair.h), and of hair that does not go through hair
// (ringlet/crossings). A frame is several submissions, each recorded when it is due: the plan of the frame
// (plan/frame_plan.h), cut at its exchanges.
#include <algorithm>
#include <array>

#include "layout/contacts.h"
#include "ringlet/base/stopwatch.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {

// Records a submission and submits it.
Status Simulation::Implementation::startPart(FrameRecording& frame, gpu::Recorder& recorder,
                                             std::span<const PlannedStage> stages) {
  if (Status status = recorder.begin(); !status) return status;
  frame.pace.beginRecording();
  if (Status status = record(frame, stages); !status) return status;
  recorder.barrier();
  buffers.recordControl(recorder);
  if (contacts.volume) contacts.volume->recordControl(recorder);
  return recorder.submit();
}

// Waits for the submission and reads its control block.
Status Simulation::Implementation::endPart(gpu::Recorder& recorder) {
  if (Status status = recorder.wait(); !status) return status;
  times.add(recorder);
  if (contacts.pairs) contacts.pairs->readControl();
  return buffers.control().isHalted == layout::kHaltedByTurns ? Status{Error{kTooManyNear}} : Status{};
}

// At the start of a step: the largest motion of contact particles and the volume's reach over all parts.
Status Simulation::Implementation::exchangeStarts(PartStep& now) {
  ContactStage::Largest motion{};
  std::array<std::int32_t, 6> reach{};
  if (contacts.pairs) motion = contacts.pairs->largest();
  if (contacts.volume) reach = contacts.volume->reach();
  std::array<std::int32_t, 8> all{};
  std::ranges::copy(reach, std::ranges::copy(motion, all.begin()).out);
  if (Status status = contacts.divided->link().largest(all); !status) return status;
  std::copy_n(all.begin(), motion.size(), motion.begin());
  std::copy_n(all.begin() + motion.size(), reach.size(), reach.begin());
  if (contacts.volume) contacts.volume->setReach(reach);
  now.largest = motion;
  now.sample.reset();
  return contacts.pairs ? contacts.pairs->setLargest(motion) : Status{};
}

// A part that repeats a step keeps the sample that was summed over all parts before.
Status Simulation::Implementation::exchangeSample(PartStep& now) {
  if (!now.sample) {
    std::array<std::uint32_t, 2> sums{contacts.pairs->sample().sampled, contacts.pairs->sample().missed};
    if (Status status = contacts.divided->link().sum(sums); !status) return status;
    now.sample = {sums[0], sums[1]};
  }
  return contacts.pairs->setSample(*now.sample);
}

Status Simulation::Implementation::exchangeSums(const PlannedStage& stage) {
  if (!contacts.volume) return {};
  if (Status status = contacts.divided->link().sum(contacts.volume->sums()); !status) return status;
  return stage.isFirst && contacts.volume->sorts(stage.step)
             ? contacts.divided->link().sum(contacts.volume->densities())
             : Status{};
}

// Rows are not exchanged here but while the submission after theirs runs (runParts).
Status Simulation::Implementation::exchange(const PlannedStage& stage, PartStep& now) {
  switch (stage.exchange) {
    case Exchange::rows:
      break;
    case Exchange::starts:
      return exchangeStarts(now);
    case Exchange::sample:
      return exchangeSample(now);
    case Exchange::sums:
      return exchangeSums(stage);
    case Exchange::ways:
      return keepApart(stage.step);
  }
  return {};
}

// On the host: no hair through hair.
Status Simulation::Implementation::keepApart(std::uint32_t step) {
  const Stopwatch watch(times.stages["no_crossings"]);
  return contacts.crossings->keepApart(buffers, settings, step);
}

// If this part's lists are too short, it repeats the step alone: by then it has all data of the other parts.
Status Simulation::Implementation::runParts(std::size_t slot) {
  gpu::Recorder& recorder = frames.slots[slot].recorder;
  frames.slots[slot].recorded = FrameSlot::Recorded::nothing;
  FrameRecording frame{recorder, pace, slot};
  const std::vector<PlannedStage> stages = planStages();
  const std::span<const PlannedStage> plan = stages;
  PartStep now;
  const PlannedStage* underWay = nullptr;  // its rows are exchanged while the next submission runs
  if (contacts.crossings) {
    if (Status status = contacts.crossings->begin(buffers); !status) return status;
  }
  for (std::size_t begin = 0, end = 0; begin < plan.size(); begin = end + 1) {
    end = static_cast<std::size_t>(
        std::ranges::find(plan.subspan(begin), FrameStage::exchange, &PlannedStage::stage) - plan.begin());
    if (Status status = startPart(frame, recorder, plan.subspan(begin, end - begin)); !status) return status;
    const Status exchanged = underWay ? contacts.divided->exchange(underWay->rows) : Status{};
    underWay = nullptr;
    const Status ended = endPart(recorder);
    if (!exchanged) return exchanged;
    if (!ended) return ended;
    if (contacts.pairs && contacts.pairs->isHalted()) {
      if (Status status = contacts.pairs->makeRoom(); !status) return status;
      if (contacts.divided) {
        if (Status status = contacts.pairs->setLargest(now.largest); !status) return status;
      }
      frame.repeatsStep = true;
      end = contactsBegin(plan, contacts.pairs->haltedStep()) - 1;
      continue;
    }
    if (end == plan.size()) break;
    if (plan[end].exchange == Exchange::rows) underWay = &plan[end];
    if (plan[end].exchange == Exchange::starts) frame.repeatsStep = false;
    if (Status status = exchange(plan[end], now); !status) return status;
  }
  return {};
}

}  // namespace ringlet
