// `ringlet measure`: what became of the curl, in numbers.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "ringlet/measure/motion_measure.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addMeasureCommand(CLI::App& app, int& exitCode);

/// Adds the keys that stand for a whole groom: droop_mm core_elongation turns mean_radius_mm handedness_kept
/// arc_drift max_edge_stretch tip_rotation_deg bounce_hz sway_hz settle_s energy_ratio, null where there is
/// nothing to measure, and worst {droop_mm core_elongation tip_rotation_deg}. What each stands for:
/// CurlNumbers.
void addCurlKeys(nlohmann::ordered_json& json, const CurlNumbers& numbers);

/// A number as tables show it, with so many digits and never "-0.00"; "-" for none.
std::string shown(std::optional<double> value, int digits);

}  // namespace ringlet::program
