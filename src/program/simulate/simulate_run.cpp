// Implements simulate_run.h.
#include "program/simulate/simulate_run.h"

#include <utility>

#include "program/cli/interruption.h"
#include "program/cli/progress_bar.h"
#include "program/simulate/frame_lines.h"
#include "program/simulate/hair_maker.h"
#include "program/simulate/reference_mover.h"

namespace ringlet::program {

RunWords programWords() {
  return {.overwrite = "--overwrite",
          .resume = "--resume",
          .elsewhere = "another folder with -o",
          .who = "ringlet simulate"};
}

SimulateOptions::SimulateOptions(RunOptions run) : RunOptions(std::move(run)) {
  words = programWords();
  mover = followByReference();
}

Result<RunOutcome> simulate(const LoadedScene& scene, const SimulateOptions& options,
                            const FrameObserver& observer) {
  catchInterruption();
  std::optional<EndsUnheard> unheard;
  std::optional<ProgressBar> bar;
  std::optional<FrameLines> lines;
  RunEvents events{.isStopped = wasInterrupted,
                   .progress = [&](int written) { bar->show(written); },
                   .firstFrame = [&] { unheard.reset(); },
                   .observe = observer};
  if (options.tellsFrames) events.written = [&](int frame) { lines->tell(frame); };
  const auto makeIt = [&](const SceneHairInput& input) {
    // Until the first frame is done, since drivers compile in it too. Not in a sweep, where other threads
    // write, and not among ranks, which must end together.
    if (options.runNumber == 0 && !options.onRanks) unheard.emplace();
    return makeHair(input, options);
  };
  auto run = Run::open(scene, options, makeIt, std::move(events));
  if (!run) return run.error();
  bar.emplace(run->resumedFrom(), scene.frameCount, options.showProgress);
  lines.emplace(run->resumedFrom(), scene.frameCount, options.runNumber);
  for (;;) {
    const auto more = run->next();
    if (!more) return more.error();
    if (!*more) return run->finish();
  }
}

}  // namespace ringlet::program
