// Hair of a run that several ranks (ranks.h) have a part of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/part_link.h"

namespace ringlet::mpi {

/// Makes a rank's part; `link`: where strands meet, else none.
using PartMaker = std::function<Result<std::unique_ptr<SceneHair>>(
    const SceneHairInput& input, std::size_t rank, std::span<const std::uint32_t> strands, PartLink* link)>;

/// Of rank 0: all of the hair. Errors: those of any rank's part; more ranks than strands.
Result<std::unique_ptr<SceneHair>> makeRankHair(const SceneHairInput& input, const PartMaker& makePart);

/// Of another rank: does with its part what rank 0 tells it to, until that tells it to leave. What goes wrong
/// is said by rank 0.
void serveRanks(const SceneHairInput& input, const PartMaker& makePart);

}  // namespace ringlet::mpi
