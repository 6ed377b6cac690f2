// RemoteHair: a part of divided hair on another rank; and that rank's side of it. Every rank has read the
// scene, so that a frame is its number.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::mpi {

/// submit comes back at once; every other call waits for the rank. `strands` are the part's: positions of
/// others are 0. Fails where the rank could not make its part.
Result<std::unique_ptr<SceneHair>> makeRemoteHair(int rank, const Groom& groom,
                                                  std::span<const std::uint32_t> strands);

/// Of a rank but 0: says whether it has hair, and does what rank 0 tells it to until that tells it to leave.
void serve(Result<std::unique_ptr<SceneHair>> hair, const SceneFrames& frames, const Groom& groom,
           std::span<const std::uint32_t> strands);

}  // namespace ringlet::mpi
