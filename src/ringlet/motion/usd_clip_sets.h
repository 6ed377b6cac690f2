// The clip sets of a USD prim: what its metadata `clips` and `clipSets` say, as schedules.
#pragma once

#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/motion/usd_clip_files.h"
#include "ringlet/motion/usd_clip_schedule.h"
#include "ringlet/motion/usd_prims.h"

namespace ringlet {

/// The sets of a prim, that which counts most first. Errors, with the prim's path: what is missing or of
/// another kind; indices of no clip; times that do not rise; a template without files. Asks `files` which of
/// a template are there. Cost: linear in the entries, and in the numbers a template counts through, 100,000
/// at most.
Result<std::vector<UsdClipSchedule>> clipSchedulesOf(const UsdPrims& prims, std::uint32_t prim,
                                                     const UsdClipFiles& files);

}  // namespace ringlet
