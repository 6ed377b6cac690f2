// What `ringlet convert` wrote, and with --info what a file holds, told: as JSON, and as lines of text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/run/run_report.h"

namespace ringlet::program {

struct ConvertReport {
  const Groom& groom;                          // as it was written
  std::vector<std::filesystem::path> outputs;  // of a sequence the first and the last
  std::uint64_t byteCount = 0;
  std::vector<std::string> warnings;
  int frameCount = 1;
  std::optional<double> errorBound{};  // of an animation [m]; none: a groom
};

/// The object of `ringlet convert --json`, and its keys in its order.
nlohmann::ordered_json convertJson(const ConvertReport& report);
std::vector<ReportKey> convertKeys();
std::string convertText(const ConvertReport& report);

/// The same with --info.
nlohmann::ordered_json animationJson(const AnimationReader& source);
std::vector<ReportKey> animationKeys();
std::string animationText(const std::filesystem::path& input, const AnimationReader& source);

}  // namespace ringlet::program
