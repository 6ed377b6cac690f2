// Implements the frames of divided hair (divided_hair.h). A frame is several submissions, each recorded when
// it is due; between them the parts exchange the rows of their strands.
#include <utility>

#include "layout/contacts.h"
#include "ringlet/solver/simulation_implementation.h"

namespace ringlet {

// Records and runs one submission: the other parts' rows are uploaded, `work` is done, the own rows are
// downloaded.
template <class Work>
Status Simulation::Implementation::submitPart(FrameRecording& frame, gpu::Recorder& recorder,
                                              std::optional<DividedHair::Rows> in,
                                              std::optional<DividedHair::Rows> out, const Work& work) {
  if (Status status = recorder.begin(); !status) return status;
  frame.pace.beginRecording();
  if (in) {
    divided->recordIn(recorder, *in);
    recorder.barrier();
  }
  if (Status status = work(); !status) return status;
  recorder.barrier();
  if (out) divided->recordOut(recorder, *out);
  buffers.recordControl(recorder);
  if (Status status = recorder.submitAndWait(); !status) return status;
  for (const auto& [stage, milliseconds] : recorder.stageMilliseconds())
    stageMilliseconds[stage] += milliseconds;
  if (contacts) contacts->readControl();
  return buffers.control().isHalted == layout::kHaltedByTurns ? Status{Error{kTooManyNear}} : Status{};
}

// A step up to the first iteration of its solve. If this part's lists find no room, the part repeats this; it
// has all data of the other parts by then.
template <class Solve>
Status Simulation::Implementation::meetFirst(FrameRecording& frame, gpu::Recorder& recorder,
                                             std::uint32_t step, const Solve& solve,
                                             std::optional<DividedHair::Rows> out) {
  std::optional<ContactStage::Sample> sample;  // of all parts
  for (;;) {
    std::optional in = DividedHair::Rows::step;
    const bool asks = contacts && contacts->samples();
    const auto findOthers = [&]() -> Status {
      recordGrid(frame, step);
      return {};
    };
    if (asks) {
      const auto none = std::optional<DividedHair::Rows>{};
      if (Status status = submitPart(frame, recorder, std::exchange(in, none), none, findOthers); !status)
        return status;
      if (!sample) {
        const auto sum = divided->sum(contacts->sample());
        if (!sum) return sum.error();
        sample = *sum;
      }
      if (Status status = contacts->setSample(*sample); !status) return status;
    }
    const auto meetAndSolve = [&]() -> Status {
      if (!asks) recordGrid(frame, step);
      recordFirstMeeting(frame, step);
      return solve();
    };
    if (Status status = submitPart(frame, recorder, in, out, meetAndSolve); !status) return status;
    if (!contacts || !contacts->isHalted()) return {};
    if (Status status = contacts->makeRoom(); !status) return status;
  }
}

Status Simulation::Implementation::runParts(std::size_t slot) {
  using Rows = DividedHair::Rows;
  gpu::Recorder& recorder = slots[slot].recorder;
  slots[slot].recorded = FrameSlot::Recorded::nothing;
  FrameRecording frame{recorder, pace, slot};
  const auto begin = [&]() -> Status {
    beginFrame(frame);
    if (Status status = recordPass(frame, {.step = 0}); !status) return status;
    if (volume) recordBrought(frame, 0, true);
    return {};
  };
  if (Status status = submitPart(frame, recorder, {}, Rows::step, begin); !status) return status;
  const std::uint32_t steps = static_cast<std::uint32_t>(settings.stepsPerFrame);
  const int iterations = settings.contacts.iterationCount(contacts.has_value());
  for (std::uint32_t step = 0; step < steps; ++step) {
    if (Status status = divided->exchange(Rows::step); !status) return status;
    for (int iteration = 1; iteration <= iterations; ++iteration) {
      const bool isLast = iteration == iterations;
      const SolvePass pass{step, true, isLast, isLast && step + 1 < steps};
      const bool ends = isLast && step + 1 == steps;
      const std::optional out = ends ? std::optional<Rows>{} : isLast ? Rows::step : Rows::solve;
      const auto solve = [&]() -> Status {
        if (Status status = recordPass(frame, pass); !status) return status;
        if (volume && !ends) recordBrought(frame, isLast ? step + 1 : step, isLast);
        if (ends) slots[slot].recordPositions(recorder, buffers);
        return {};
      };
      if (iteration == 1) {
        if (Status status = meetFirst(frame, recorder, step, solve, out); !status) return status;
      } else {
        const auto meetAndSolve = [&]() -> Status {
          recordNextMeeting(frame, step);
          return solve();
        };
        if (Status status = submitPart(frame, recorder, Rows::solve, out, meetAndSolve); !status)
          return status;
      }
      if (isLast) continue;
      if (Status status = divided->exchange(Rows::solve); !status) return status;
    }
  }
  return {};
}

}  // namespace ringlet
