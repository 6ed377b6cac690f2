// SweepPlan: which runs a sweep has, a scene each.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// A key of the scene and the values it takes, as --vary has them.
struct SweepAxis {
  std::string key;
  std::vector<std::string> values;  // at least one
};

struct SweepRun {
  int number = 0;                    // from 1
  std::vector<SceneChange> changes;  // one an axis, in their order
  SceneFile scene;                   // its paths are absolute; no folder
};

inline constexpr std::size_t kMostRuns = 10'000;  // of a sweep

/// "KEY=a:b:n", n values evenly from a to b, or "KEY=v1,v2,v3". Commas in brackets or quotes part nothing.
Result<SweepAxis> parseAxis(std::string_view typed);

/// Every combination of values, the last axis changing fastest. Errors: too many, a key twice, a scene that
/// cannot be read, and what its reader says of a change, with the run's values.
Result<std::vector<SweepRun>> planRuns(const std::filesystem::path& scene, std::span<const SweepAxis> axes,
                                       SceneReach reach = SceneReach::anywhere);

/// "hold = 2, gravity = 5": of the axes with more than one value, or of all where no axis has.
std::string valuesText(const SweepRun& run, std::span<const SweepAxis> axes);

/// What an axis is called in tables and pictures: its key without the tables, where no other axis has that.
std::string shortName(const SweepAxis& axis, std::span<const SweepAxis> axes);

}  // namespace ringlet::program
