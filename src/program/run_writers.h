// The writers of a run: what happens to a frame once it is stepped.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "program/simulate_run.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/sheet.h"
#include "ringlet/output/usd_writer.h"

namespace ringlet::program {

struct Writers {
  std::optional<UsdWriter> usd;
  std::optional<CacheWriter> cache;
  std::optional<Sheet> sheet;
  bool writesLast;
  std::vector<Vec3f> lastPoints;  // [file unit]

  /// Frames in order, 1 is the first; points in the groom's unit and order, finite.
  Status addFrame(int frame, std::vector<Vec3f> points);

  /// Closes the files, after at least one frame, and says which there are.
  Result<std::vector<std::filesystem::path>> finish(const std::filesystem::path& folder, const Groom& groom);
};

/// Makes the folder and the files that frames are added to.
Result<Writers> openWriters(const RunInput& input, const RunOptions& options);

}  // namespace ringlet::program
