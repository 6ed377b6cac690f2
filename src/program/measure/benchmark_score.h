// What the neutral benchmark says of a simulator's files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/run/run_report.h"

namespace ringlet::program {

/// Of a case; where something is wrong with its file, `problem` says what and the numbers say nothing.
struct BenchmarkScore {
  std::string name{}, file{}, problem{};
  int frameCount = 0, expectedCount = 0;
  double roots = 0;                   // farthest of a root from where it should be, of all frames [m]
  double stretch = 0;                 // of the longest edge, beyond rest, as a share, of all frames
  double droop = 0;                   // of tips, the last frame, mean [m]
  double turns = 0;                   // of curls, the last frame, as a share of those at rest
  double motion = 0;                  // farthest way of a particle from the frame before the last to it [m]
  std::optional<double> settle{};     // after the head's last motion [s]
  std::optional<double> crossings{};  // passes of hairs through each other, a strand
  std::optional<double> overlap{};    // deepest, beyond rest, as a share of the hairs' width
  std::optional<double> depth{};      // in the body [m]
};

struct BenchmarkScores {
  std::vector<BenchmarkScore> cases{};
  std::optional<double>
      resolution{};  // how far tips of the hanging curl are apart in height, by its points [m]
};

/// Reads of each case FOLDER/NAME/hair.*, an animation of any program. A file of one frame more than the
/// scene has begins with the rest. Errors: a folder without any case, or without files that writeBenchmark()
/// wrote.
Result<BenchmarkScores> scoreBenchmark(const std::filesystem::path& folder);

nlohmann::ordered_json benchmarkJson(const BenchmarkScores& scores);
/// Its keys, in its order.
std::vector<ReportKey> benchmarkKeys();
std::string benchmarkText(const BenchmarkScores& scores);

}  // namespace ringlet::program
