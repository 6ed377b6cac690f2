// Implements measure_report.h.
#include "program/measure/measure_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

namespace ringlet::program {
namespace {

nlohmann::json orNull(std::optional<double> value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

// A line of the table and of the JSON's spread: one value of every strand, in the unit shown.
struct ReportRow {
  const char* label;
  const char* key;
  double StrandMeasure::*member;
  double scale;
  int digits;
  bool onlyInPoses;  // says nothing about a groom alone
};
constexpr ReportRow kRows[] = {
    {"droop [mm]", "droop_mm", &StrandMeasure::droop, 1000, 3, true},
    {"  of length [%]", "relative_droop", &StrandMeasure::relativeDroop, 100, 3, true},
    {"core elongation", "core_elongation", &StrandMeasure::coreElongation, 1, 4, true},
    {"chord elongation", "chord_elongation", &StrandMeasure::chordElongation, 1, 4, true},
    {"core [mm]", "core_length_mm", &StrandMeasure::coreLength, 1000, 2, false},
    {"chord [mm]", "chord_mm", &StrandMeasure::chord, 1000, 2, false},
    {"turns", "turns", &StrandMeasure::turns, 1, 3, false},
    {"winding [turns]", "winding", &StrandMeasure::winding, 1, 3, false},
    {"radius [mm]", "mean_radius_mm", &StrandMeasure::meanRadius, 1000, 3, false},
    {"hand kept [%]", "handedness_share", &StrandMeasure::handednessKept, 100, 1, true},
    {"arc drift [%]", "arc_drift", &StrandMeasure::arcDrift, 100, 4, true},
    {"longest edge [x]", "max_edge_stretch", &StrandMeasure::maxEdgeStretch, 1, 4, true},
    {"tip rotation [deg]", "tip_rotation_deg", &StrandMeasure::tipRotation, 1, 2, true},
};

// The same of the distances from --against.
struct DistanceRow {
  const char* label;
  const char* heading;  // of a column
  const char* key;
  double ShapeDistance::*member;
  double scale;
  int digits;
};
constexpr DistanceRow kDistanceRows[] = {
    {"particles [% length]", "apart %", "particles", &ShapeDistance::particles, 100, 4},
    {"tip [% length]", "tip %", "tip", &ShapeDistance::tip, 100, 4},
    {"core [% length]", "core %", "core", &ShapeDistance::core, 100, 4},
    {"direction [deg]", "dir deg", "direction_deg", &ShapeDistance::direction, 1, 2},
    {"turns [%]", "turns %", "turns", &ShapeDistance::turns, 100, 3},
    {"radius [%]", "radius %", "radius", &ShapeDistance::radius, 100, 3},
};

// JSON has shares where the table has per cent.
template <class AnyRow>
double jsonScale(const AnyRow& row) {
  return row.scale == 100 ? 1 : row.scale;
}

template <class Strand, class AnyRow>
std::vector<double> valuesOf(const std::vector<Strand>& strands, const AnyRow& row, double scale) {
  std::vector<double> values;
  for (const Strand& strand : strands) values.push_back(strand.*row.member * scale);
  return values;
}

std::string count(std::size_t number, const char* noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

nlohmann::ordered_json besideJson(const MotionBeside& beside) {
  nlohmann::ordered_json json;
  json["frames"] = beside.frames.size();
  json["way_mm"] = 1000 * beside.mean.way;
  json["against_way_mm"] = 1000 * beside.mean.other;
  json["way"] = orNull(beside.mean.wayShare());
  json["tips"] = orNull(beside.mean.apartShare());
  json["kept"] = orNull(beside.kept);
  for (const TipWays& frame : beside.frames) {
    json["each"]["way_mm"].push_back(1000 * frame.way);
    json["each"]["against_way_mm"].push_back(1000 * frame.other);
    json["each"]["tips"].emplace_back(orNull(frame.apartShare()));
  }
  return json;
}

std::string besideText(const MotionBeside& beside) {
  std::string text = fmt::format(
      "  way           tips move {} mm from rest, seen from the head, and {} mm there: {} of it\n",
      shown(1000 * beside.mean.way, 2), shown(1000 * beside.mean.other, 2), shown(beside.mean.wayShare(), 3));
  text += fmt::format("  tips          are {} of that way apart, on the mean of {}\n",
                      shown(beside.mean.apartShare(), 3), count(beside.frames.size(), "frame"));
  if (beside.kept)
    text += fmt::format("  kept          {} of what is kept apart there\n", shown(beside.kept, 3));
  return text;
}

}  // namespace

std::string shown(std::optional<double> value, int digits) {
  if (!value) return "-";
  const double unit = std::pow(10, -digits);
  return fmt::format("{:.{}f}", std::abs(*value) < unit / 2 ? 0.0 : *value, digits);
}

void addCurlKeys(nlohmann::ordered_json& json, const CurlNumbers& numbers) {
  json["droop_mm"] = 1000 * numbers.droop;
  json["core_elongation"] = numbers.coreElongation;
  json["turns"] = numbers.turns;
  json["mean_radius_mm"] = 1000 * numbers.meanRadius;
  json["handedness_kept"] = numbers.handednessKept;
  json["arc_drift"] = numbers.arcDrift;
  json["max_edge_stretch"] = numbers.maxEdgeStretch;
  json["tip_rotation_deg"] = numbers.tipRotation;
  json["bounce_hz"] = orNull(numbers.bounceHz);
  json["sway_hz"] = orNull(numbers.swayHz);
  json["settle_s"] = orNull(numbers.settleSeconds);
  json["energy_ratio"] = orNull(numbers.energyRatio);
  json["worst"] = {{"droop_mm", 1000 * numbers.worstDroop},
                   {"core_elongation", numbers.worstCoreElongation},
                   {"tip_rotation_deg", numbers.worstTipRotation}};
}

nlohmann::ordered_json measuredJson(const Measured& measured, bool withStrands) {
  nlohmann::ordered_json json;
  json["strands"] = measured.numbers.strandCount;
  json["particles"] = measured.numbers.particleCount;
  json["frames"] = measured.numbers.frameCount;
  addCurlKeys(json, measured.numbers);
  for (const char* key : {"limited_share", "velocity_residual"}) json[key] = nullptr;  // of a run's steps
  for (const ReportRow& row : kRows) {
    const Spread spread = spreadOf(valuesOf(measured.strands, row, jsonScale(row)));
    json["spread"][row.key] = {spread.mean, spread.min, spread.max};
  }
  if (!measured.distances.empty()) {
    for (const DistanceRow& row : kDistanceRows) {
      const Spread spread = spreadOf(valuesOf(measured.distances, row, jsonScale(row)));
      json["against"][row.key] = {spread.mean, spread.min, spread.max};
    }
  }
  if (measured.beside) json["against_motion"] = besideJson(*measured.beside);
  if (measured.series) json["series"] = seriesJson(*measured.series);
  if (!withStrands) return json;

  json["per_strand"] = nlohmann::json::array();
  for (std::size_t s = 0; s < measured.strands.size(); ++s) {
    const StrandMeasure& strand = measured.strands[s];
    nlohmann::ordered_json entry;
    entry["particles"] = measured.ruler.strand(s).particleCount();
    for (const ReportRow& row : kRows) entry[row.key] = strand.*row.member * jsonScale(row);
    entry["turns_at_rest"] = measured.ruler.strand(s).rest().turns;
    entry["handedness"] = strand.handedness;
    entry["handedness_kept"] = strand.handednessKept >= kHandKeptShare;
    if (!measured.motions.empty()) {
      const StrandMotion& motion = measured.motions[s];
      entry["bounce_hz"] = orNull(motion.bounceHz);
      entry["sway_hz"] = orNull(motion.swayHz);
      entry["settle_s"] = orNull(motion.settleSeconds);
      entry["energy_ratio"] = motion.energyRatio;
    }
    if (!measured.distances.empty()) {
      for (const DistanceRow& row : kDistanceRows)
        entry["against"][row.key] = measured.distances[s].*row.member * jsonScale(row);
    }
    json["per_strand"].push_back(std::move(entry));
  }
  return json;
}

std::string riseNote(double droop) { return droop < 0 ? " (below 0: the tip rose)" : ""; }

std::string measuredText(const Measured& measured) {
  const GroomMeasure groom = measured.ruler.summarize(measured.strands);
  const CurlNumbers& numbers = measured.numbers;
  const std::size_t bothHands = groom.curledCount - groom.rightHandedCount - groom.leftHandedCount;
  std::string text = fmt::format(
      "{}, {} particles: {} curled ({} right-handed, {} left-handed{}), {} straight\n",
      count(groom.strandCount, "strand"), groom.particleCount, groom.curledCount, groom.rightHandedCount,
      groom.leftHandedCount, bothHands > 0 ? fmt::format(", {} of both hands", bothHands) : "",
      groom.strandCount - groom.curledCount);
  if (!measured.motions.empty()) {
    text += fmt::format("{}, {:.2f} s{}; the table shows the last\n", count(numbers.frameCount, "frame"),
                        measured.seconds, measured.isUnfinished ? " (not finished)" : "");
  }
  text += fmt::format("\n  {:<20}{:>12}{:>12}{:>12}\n", "", "mean", "min", "max");
  auto line = [&](const char* label, const Spread& spread, int digits, const std::string& note = "") {
    text += fmt::format("  {:<20}{:>12}{:>12}{:>12}{}\n", label, shown(spread.mean, digits),
                        shown(spread.min, digits), shown(spread.max, digits), note);
  };
  for (const ReportRow& row : kRows) {
    if (row.onlyInPoses && !measured.isPose) continue;
    const Spread spread = spreadOf(valuesOf(measured.strands, row, row.scale));
    line(row.label, spread, row.digits, row.member == &StrandMeasure::droop ? riseNote(spread.min) : "");
    if (!measured.isPose) continue;
    if (row.member == &StrandMeasure::turns) line("  at rest", groom.turnsAtRest, row.digits);
    if (row.member == &StrandMeasure::meanRadius) {
      const Spread& rest = groom.meanRadiusAtRest;
      line("  at rest [mm]", {1000 * rest.mean, 1000 * rest.min, 1000 * rest.max}, row.digits);
    }
  }
  if (!measured.distances.empty()) {
    text += fmt::format("\n  against {}\n", measured.against);
    for (const DistanceRow& row : kDistanceRows)
      line(row.label, spreadOf(valuesOf(measured.distances, row, row.scale)), row.digits);
    if (measured.beside) text += besideText(*measured.beside);
  }
  if (measured.isPose)
    text +=
        fmt::format("\n  handedness    {}\n", numbers.handednessKept ? "kept by every strand" : "not kept");
  if (measured.motions.empty()) return text;

  // What only a motion has.
  text += fmt::format(
      "  at the worst  droop {} mm{}, core elongation {}, longest edge {} x, tip rotation {} degrees\n",
      shown(1000 * numbers.worstDroop, 3), riseNote(numbers.worstDroop),
      shown(numbers.worstCoreElongation, 4), shown(numbers.maxEdgeStretch, 4),
      shown(numbers.worstTipRotation, 2));
  text += fmt::format("  bounce        {}{}, sway {}{}\n", shown(numbers.bounceHz, 3),
                      numbers.bounceHz ? " Hz" : "", shown(numbers.swayHz, 3), numbers.swayHz ? " Hz" : "");
  text += fmt::format("  settled       {}\n", numbers.settleSeconds
                                                  ? fmt::format("after {} s", shown(numbers.settleSeconds, 2))
                                                  : "not yet");
  text += numbers.energyRatio ? fmt::format("  energy        {:.3g} of its peak left\n", *numbers.energyRatio)
                              : "";
  if (measured.freeSeconds >= measured.seconds) {
    text += "  the head drove the hair to the last frame; bounce and settling show after it stops\n";
  } else if (measured.freeSeconds > 0) {
    text += fmt::format("  bounce and settling are those after the head last drove the hair, at {:.2f} s\n",
                        measured.freeSeconds);
  }
  return text;
}

std::string strandsText(const Measured& measured) {
  std::string text = fmt::format("\n{:>7}{:>10}", "strand", "particles");
  const char* headings[] = {"droop mm", "%",         "core x", "chord x", "core mm", "chord mm", "turns",
                            "winding",  "radius mm", "hand %", "drift %", "edge x",  "tip deg"};
  static_assert(std::size(headings) == std::size(kRows));
  for (std::size_t k = 0; k < std::size(kRows); ++k) {
    if (!kRows[k].onlyInPoses || measured.isPose) text += fmt::format("{:>10}", headings[k]);
  }
  if (!measured.motions.empty())
    text += fmt::format("{:>10}{:>10}{:>10}{:>10}", "bounce Hz", "sway Hz", "settle s", "energy");
  if (!measured.distances.empty()) {
    for (const DistanceRow& row : kDistanceRows) text += fmt::format("{:>10}", row.heading);
  }
  text += "\n";
  for (std::size_t s = 0; s < measured.strands.size(); ++s) {
    text += fmt::format("{:>7}{:>10}", s, measured.ruler.strand(s).particleCount());
    for (const ReportRow& row : kRows) {
      if (!row.onlyInPoses || measured.isPose)
        text += fmt::format("{:>10}", shown(measured.strands[s].*row.member * row.scale, row.digits));
    }
    if (!measured.motions.empty()) {
      const StrandMotion& motion = measured.motions[s];
      text += fmt::format("{:>10}{:>10}{:>10}{:>10.2g}", shown(motion.bounceHz, 3), shown(motion.swayHz, 3),
                          shown(motion.settleSeconds, 2), motion.energyRatio);
    }
    if (!measured.distances.empty()) {
      for (const DistanceRow& row : kDistanceRows)
        text += fmt::format("{:>10}", shown(measured.distances[s].*row.member * row.scale, row.digits));
    }
    text += "\n";
  }
  return text;
}

}  // namespace ringlet::program
