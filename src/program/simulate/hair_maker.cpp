// Implements hair_maker.h.
#include "program/simulate/hair_maker.h"

#include <utility>

#include "mpi/rank_hair.h"
#include "mpi/ranks.h"
#include "program/cli/exit_codes.h"
#include "program/cli/interruption.h"
#include "program/device/gpu_hair.h"
#include "program/simulate/reference_hair.h"
#include "ringlet/run/split_hair.h"
#include "ringlet/scenes/frames/scene_frames.h"

namespace ringlet::program {
namespace {

// Makes a rank's part of the hair, with ranks taking the run's devices in turn.
mpi::PartMaker partMaker(const SimulateOptions& options) {
  return [&options](const SceneHairInput& input, std::size_t rank, std::span<const std::uint32_t> strands,
                    PartLink* link) -> Result<std::unique_ptr<SceneHair>> {
    const std::string& device =
        options.devices.empty() ? options.device : options.devices[rank % options.devices.size()];
    const auto gpu = GpuChoice::make(input, options, device, options.showProgress);
    if (!gpu) return gpu.error();
    return makeHairPart(input, (*gpu)->choice(), strands, link);
  };
}

}  // namespace

Result<std::unique_ptr<SceneHair>> makeHair(const SceneHairInput& input, const SimulateOptions& options) {
  if (options.onReference) return makeReferenceHair(input);
  if (options.onRanks) return mpi::makeRankHair(input, partMaker(options));
  return makeGpuHair(input, options, options.showProgress);
}

bool isOneOfRanks() { return mpi::ranks().count > 1; }

std::optional<int> joinRun(const LoadedScene& scene, SimulateOptions& options) {
  options.onRanks = isOneOfRanks();
  if (mpi::ranks().own == 0) return std::nullopt;
  catchInterruption();  // rank 0 decides when this one ends
  const SceneFrames frames(scene);
  mpi::serveRanks(hairInputOf(scene, frames, options), partMaker(options));
  return kExitFine;
}

}  // namespace ringlet::program
