// What was measured, told: as JSON, and as tables. `ringlet scene` tells its curls by the same keys and
// digits.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "program/measure/measure_series.h"
#include "ringlet/measure/motion_measure.h"
#include "ringlet/measure/shape_distance.h"
#include "ringlet/measure/tip_ways.h"

namespace ringlet::program {

/// A motion beside another of the same groom, that of --against.
struct MotionBeside {
  std::vector<TipWays> frames;   // those that both have
  TipWays mean;                  // of these
  std::optional<double> kept{};  // of the overlap beyond rest that --against prevents in the worst frame of
                                 // --without, the share that this motion prevents
};

/// A groom alone, another pose of it, or a motion. Only the last has frames.
struct Measured {
  GroomRuler ruler;
  std::vector<StrandMeasure> strands;    // of the pose, or of the last frame
  std::vector<StrandMotion> motions;     // one a strand, or none
  std::vector<ShapeDistance> distances;  // from --against, one a strand, or none
  std::string against;                   // that pose's file
  CurlNumbers numbers;
  std::optional<MotionBeside> beside = {};  // of a motion, if that of --against is one
  std::optional<MotionSeries> series = {};  // of a motion that is to be plotted
  double seconds = 0, freeSeconds = 0;
  bool isPose = false;        // against another pose or a motion
  bool isUnfinished = false;  // an animation that was not finished
};

/// Adds the keys that stand for a whole groom, from droop_mm to worst. What each stands for: CurlNumbers.
void addCurlKeys(nlohmann::ordered_json& json, const CurlNumbers& numbers);

/// A number as tables show it, with so many digits and never "-0.00"; "-" for none.
std::string shown(std::optional<double> value, int digits);
/// " (below 0: the tip rose)" behind such a droop; nothing behind others.
std::string riseNote(double droop);

/// The object of `ringlet measure --json`.
nlohmann::ordered_json measuredJson(const Measured& measured, bool withStrands);
/// Its keys, in its order.
std::vector<ReportKey> measureKeys();

/// The summary, and a line a strand below it.
std::string measuredText(const Measured& measured);
std::string strandsText(const Measured& measured);

}  // namespace ringlet::program
