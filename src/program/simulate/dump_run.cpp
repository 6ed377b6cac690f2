// Implements dump_run.h.
#include "program/simulate/dump_run.h"

#include <fmt/format.h>

#include "program/cli/exit_codes.h"
#include "program/cli/standard_output.h"
#include "program/device/gpu_hair.h"
#include "program/simulate/hair_maker.h"
#include "ringlet/run/step_dump.h"

namespace ringlet::program {

int runDump(const LoadedScene& scene, const SimulateOptions& options, std::uint64_t step) {
  if (isOneOfRanks())
    return fail("simulate", {"--dump writes what one device holds; start it without mpirun", Fault::input});
  const SceneFrames frames(scene);
  const auto choice =
      GpuChoice::make(hairInputOf(scene, frames, options), options, options.device, options.showProgress);
  if (!choice) return fail("simulate", choice.error());
  const auto folder = options.folder / fmt::format("step_{}", step);
  if (Status dumped = dumpStep(scene, (*choice)->choice(), step, folder); !dumped)
    return fail("simulate", dumped.error());
  print("{}: what {} holds after step {}; buffers.txt lists the buffers\n", folder.string(),
        (*choice)->choice().device.name(), step);
  return kExitFine;
}

}  // namespace ringlet::program
