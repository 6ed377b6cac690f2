// RemoteBackend: a part of divided hair on another rank, behind backend.h; and that rank's side of it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "program/backend.h"
#include "ringlet/base/result.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/scenes/scene_keys.h"

namespace ringlet::program {

/// submitFrame comes back at once; every other call waits for the rank. `strands` are the part's: positions
/// of others are 0. Fails where the rank could not make its part.
Result<std::unique_ptr<Backend>> makeRemoteBackend(int rank, const Groom& groom,
                                                   std::span<const std::uint32_t> strands);

/// Of these strands, in the groom.
std::vector<std::uint32_t> pointsOf(const Groom& groom, std::span<const std::uint32_t> strands);

/// What this rank knows of the run besides, as rank 0 does.
struct RankScene {
  std::function<Result<SceneNumbers>(double seconds)> numbersAt;  // as keys give them
  std::span<const ForceField> fields{};                           // whose grids those of a frame have
  std::vector<std::uint32_t> points{};                            // of the part, in the groom
  std::size_t pointCount = 0;                                     // of the groom
};

/// Of a rank but 0: says whether it has hair, and does what rank 0 tells it to until that tells it to leave.
void serve(Result<std::unique_ptr<Backend>> hair, const RankScene& scene);

}  // namespace ringlet::program
