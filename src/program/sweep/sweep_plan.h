// SweepPlan: the runs of a sweep, each with its scene.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// A key of the scene and its values, as given by --vary.
struct SweepAxis {
  std::string key;
  std::vector<std::string> values;  // at least one
};

struct SweepRun {
  int number = 0;                    // from 1
  std::vector<SceneChange> changes;  // one per axis, in the order of the axes
  SceneFile scene;                   // with absolute paths and without a folder
};

inline constexpr std::size_t kMostRuns = 10'000;  // of a sweep

/// "KEY=a:b:n": n values evenly from a to b; or "KEY=v1,v2,v3". Commas in brackets or quotes do not separate.
Result<SweepAxis> parseAxis(std::string_view typed);

/// Every combination of values, the last axis changing fastest. Errors: too many; a key twice; a scene that
/// cannot be read or that refuses a change, with the run's values.
Result<std::vector<SweepRun>> planRuns(const std::filesystem::path& scene, std::span<const SweepAxis> axes,
                                       SceneReach reach = SceneReach::anywhere);

/// "hold = 2, gravity = 5": the axes with more than one value, or all axes if none has.
std::string valuesText(const SweepRun& run, std::span<const SweepAxis> axes);

/// The name of an axis in tables and pictures: its key without the table, if that is unambiguous.
std::string shortName(const SweepAxis& axis, std::span<const SweepAxis> axes);

}  // namespace ringlet::program
