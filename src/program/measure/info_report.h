// What is in a groom's file, told: as JSON, and as lines of text.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/treat_groom.h"
#include "ringlet/measure/groom_inspection.h"
#include "ringlet/measure/rest_crossings.h"
#include "ringlet/run/run_report.h"

namespace ringlet::program {

/// What --fix did.
struct FixedGroom {
  TreatedGroom mended;
  GroomInspection after;  // of the groom that is written
  std::vector<std::string> warnings;
};

/// How a file's curves move.
struct InfoMotion {
  int frameCount = 0;
  double framesPerSecond = 0;
};

struct InfoReport {
  std::filesystem::path input, output;
  std::string unitFrom;  // file, option or default
  const LoadedGroom& loaded;
  const GroomInspection& found;
  const std::optional<RestCrossings>& crossings;
  const FixedGroom* fixed;           // null without --fix
  std::optional<InfoMotion> motion;  // none: nothing moves

  double unit() const { return loaded.groom.metresPerUnit; }
};

/// The object of `ringlet info --json`.
nlohmann::ordered_json infoJson(const InfoReport& report);
/// Its keys, in its order.
std::vector<ReportKey> infoKeys();

std::string infoText(const InfoReport& report);
/// Of --fix.
std::string fixedText(const InfoReport& report);

}  // namespace ringlet::program
