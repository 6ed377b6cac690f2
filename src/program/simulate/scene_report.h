// What `ringlet scene` ran, listed or wrote, told: as JSON, and what it measured as lines of text.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "program/simulate/run_report.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/scenes/builtin_scene.h"

namespace ringlet::program {

/// What a scene measures beside the run's own numbers.
struct SceneNumbers {
  CurlNumbers curl;
  std::optional<double> residual;   // of the velocity solve
  std::optional<double> frameTurn;  // the largest in one step [degrees]
};

struct SceneReport {
  const RunNames& names;
  bool hasCore;          // the core spring
  std::string framesOn;  // smoothed or raw
  const BuiltinScene& scene;
  const RunOutcome& outcome;
  const SceneNumbers& numbers;
};

/// The object of `ringlet scene NAME --json`: the keys of a run, of curls, and its own.
nlohmann::ordered_json sceneJson(const SceneReport& report);

/// A line a subject, below the lines of the run.
std::string sceneMeasureText(const SceneNumbers& numbers, const Settings& settings);

/// With --list, --keys and --write.
nlohmann::ordered_json sceneListJson();
nlohmann::ordered_json sceneKeysJson();

struct WrittenScene {
  std::string scene;
  std::vector<std::filesystem::path> files;
};
nlohmann::ordered_json writtenJson(const WrittenScene& written);

/// What the keys of all of these mean, but those of a run and of curls.
std::string sceneReportsHelp();

}  // namespace ringlet::program
