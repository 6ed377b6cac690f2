// Implements the frames of divided hair (divided_hair.h). A frame is several submissions, each recorded when
// it is due; between them the parts exchange what they need of each other. A part steps its border first:
// while the rows of that are on their way, the device steps the other strands.
#include <algorithm>
#include <array>

#include "layout/contacts.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {
namespace {

// What parts exchange after a pass: it ends a step, or begins the first; or another iteration follows.
DividedHair::Rows rowsAfter(const SolvePass& pass) {
  return pass.withContacts && !pass.moves ? DividedHair::Rows::solve : DividedHair::Rows::step;
}

}  // namespace

// Records a submission and hands it to the device.
template <class Work>
Status Simulation::Implementation::startPart(FrameRecording& frame, gpu::Recorder& recorder,
                                             const Work& work) {
  if (Status status = recorder.begin(); !status) return status;
  frame.pace.beginRecording();
  if (Status status = work(); !status) return status;
  recorder.barrier();
  buffers.recordControl(recorder);
  if (volume) volume->recordControl(recorder);
  return recorder.submit();
}

// Waits for it.
Status Simulation::Implementation::endPart(gpu::Recorder& recorder) {
  if (Status status = recorder.wait(); !status) return status;
  addTimes(recorder);
  if (contacts) contacts->readControl();
  return buffers.control().isHalted == layout::kHaltedByTurns ? Status{Error{kTooManyNear}} : Status{};
}

template <class Work>
Status Simulation::Implementation::submitPart(FrameRecording& frame, gpu::Recorder& recorder,
                                              const Work& work) {
  if (Status status = startPart(frame, recorder, work); !status) return status;
  return endPart(recorder);
}

void Simulation::Implementation::recordRowsOut(FrameRecording& frame, DividedHair::Rows rows) const {
  frame.pace.beginStage(frame.list, "part_pack");
  divided->recordOut(frame.list, rows);
  frame.list.endStage();
}
void Simulation::Implementation::recordRowsIn(FrameRecording& frame, DividedHair::Rows rows) const {
  frame.pace.beginStage(frame.list, "part_unpack");
  divided->recordIn(frame.list, rows);
  frame.list.barrier();
  frame.list.endStage();
}

// What of a pass other parts wait for. Without rows that is the whole pass.
Status Simulation::Implementation::recordBorder(FrameRecording& frame, const SolvePass& pass) const {
  if (!contacts) {
    if (Status status = recordPass(frame, pass); !status) return status;
    recordMeasures(frame, pass);
    return {};
  }
  if (Status status = recordPass(frame, pass, Of::border); !status) return status;
  recordRowsOut(frame, rowsAfter(pass));
  return {};
}

// The rest of a pass, while rows are exchanged.
Status Simulation::Implementation::stepInner(FrameRecording& frame, gpu::Recorder& recorder,
                                             const SolvePass& pass) {
  if (!contacts) return {};
  const auto record = [&]() -> Status {
    if (Status status = recordPass(frame, pass, Of::inner); !status) return status;
    recordMeasures(frame, pass);
    return {};
  };
  if (Status status = startPart(frame, recorder, record); !status) return status;
  const Status exchanged = divided->exchange(rowsAfter(pass));
  const Status ended = endPart(recorder);
  return exchanged ? ended : exchanged;
}

// What can be measured after a pass without the other parts.
void Simulation::Implementation::recordMeasures(FrameRecording& frame, const SolvePass& pass) const {
  const bool beginsStep = rowsAfter(pass) == DividedHair::Rows::step;
  const std::uint32_t step = pass.goesOn ? pass.step + 1 : pass.step;
  recordBrought(frame, step, beginsStep);
  if (!beginsStep) recordSums(frame, step, false);
  if (beginsStep && contacts) contacts->recordMotion(frame.list, frame.pace, step, layout::kOfHere);
}

Status Simulation::Implementation::exchangeStart() {
  ContactStage::Largest motion{};
  std::array<std::int32_t, 6> reach{};
  if (contacts) motion = contacts->largest();
  if (volume) reach = volume->reach();
  std::array<std::int32_t, 8> all{};
  std::ranges::copy(reach, std::ranges::copy(motion, all.begin()).out);
  if (Status status = divided->link().largest(all); !status) return status;
  std::copy_n(all.begin(), motion.size(), motion.begin());
  std::copy_n(all.begin() + motion.size(), reach.size(), reach.begin());
  if (volume) volume->setReach(reach);
  return contacts ? contacts->setLargest(motion) : Status{};
}

Status Simulation::Implementation::exchangeSums(std::uint32_t step, bool isFirst) {
  if (!volume) return {};
  if (Status status = divided->link().sum(volume->sums()); !status) return status;
  return isFirst && volume->sorts(step) ? divided->link().sum(volume->densities()) : Status{};
}

// A step up to the first iteration of its solve, without the volume's means. If this part's lists find no
// room, the part repeats this; it has all data of the other parts by then.
template <class Solve>
Status Simulation::Implementation::meetFirst(FrameRecording& frame, gpu::Recorder& recorder,
                                             std::uint32_t step, const Solve& solve) {
  const ContactStage::Largest largest = contacts ? contacts->largest() : ContactStage::Largest{};
  std::optional<ContactStage::Sample> sample;  // of all parts
  for (std::uint32_t whose = layout::kOfElsewhere;; whose = layout::kOfAll) {
    const bool asks = contacts && contacts->samples();
    const auto findOthers = [&]() -> Status {
      if (contacts) recordRowsIn(frame, DividedHair::Rows::step);
      recordGrid(frame, step, whose);
      return {};
    };
    if (asks) {
      if (Status status = submitPart(frame, recorder, findOthers); !status) return status;
      if (!sample) {
        std::array<std::uint32_t, 2> sums{contacts->sample().sampled, contacts->sample().missed};
        if (Status status = divided->link().sum(sums); !status) return status;
        sample = {sums[0], sums[1]};
      }
      if (Status status = contacts->setSample(*sample); !status) return status;
    }
    const auto meet = [&]() -> Status {
      if (!asks) {
        if (Status status = findOthers(); !status) return status;
      }
      if (volume) {
        volume->recordReach(recorder);
        recorder.barrier();
      }
      recordFirstContacts(frame, step);
      recordSums(frame, step, true);
      return solve();
    };
    if (Status status = submitPart(frame, recorder, meet); !status) return status;
    if (!contacts || !contacts->isHalted()) return {};
    if (Status status = contacts->makeRoom(); !status) return status;
    if (Status status = contacts->setLargest(largest); !status) return status;
  }
}

Status Simulation::Implementation::runParts(std::size_t slot) {
  gpu::Recorder& recorder = slots[slot].recorder;
  slots[slot].recorded = FrameSlot::Recorded::nothing;
  FrameRecording frame{recorder, pace, slot};
  const SolvePass firstPass{.step = 0};
  const auto begin = [&]() -> Status {
    beginFrame(frame);
    return recordBorder(frame, firstPass);
  };
  if (Status status = submitPart(frame, recorder, begin); !status) return status;
  if (Status status = stepInner(frame, recorder, firstPass); !status) return status;
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  const int iterations = settings.contacts.iterationCount(contacts.has_value());
  for (std::uint32_t step = 0; step < steps; ++step) {
    if (Status status = exchangeStart(); !status) return status;
    for (int iteration = 1; iteration <= iterations; ++iteration) {
      const bool isFirst = iteration == 1, isLast = iteration == iterations,
                 ends = isLast && step + 1 == steps;
      const SolvePass pass{step, true, isLast, isLast && !ends};
      const auto solve = [&]() -> Status {
        recordMeans(frame, step);
        if (!ends) return recordBorder(frame, pass);
        if (Status status = recordPass(frame, pass); !status) return status;
        slots[slot].recordPositions(recorder);
        return {};
      };
      const auto nothing = []() -> Status { return {}; };
      const auto meetNext = [&]() -> Status {
        if (contacts) recordRowsIn(frame, DividedHair::Rows::solve);
        recordNextContacts(frame);
        return solve();
      };
      Status status;
      if (!isFirst) {
        status = submitPart(frame, recorder, meetNext);
      } else if (volume) {
        // The volume's means need the sums of all parts.
        status = meetFirst(frame, recorder, step, nothing);
        if (status) status = exchangeSums(step, true);
        if (status) status = submitPart(frame, recorder, solve);
      } else {
        status = meetFirst(frame, recorder, step, solve);
      }
      if (status && !ends) status = stepInner(frame, recorder, pass);
      if (status && !isLast) status = exchangeSums(step, false);
      if (!status) return status;
    }
  }
  return {};
}

}  // namespace ringlet
