// Implements measure_report.h.
#include "program/measure/measure_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "ringlet/run/report_rows.h"

namespace ringlet::program {
namespace {

using Json = ReportJson;

constexpr ReportRow<CurlNumbers> kCountRows[] = {
    {{"strands", "", "Strands."}, [](const CurlNumbers& f) -> Json { return f.strandCount; }},
    {{"particles", "", "Particles."}, [](const CurlNumbers& f) -> Json { return f.particleCount; }},
    {{"frames", "", "Frames of the animation; 0 of a groom."},
     [](const CurlNumbers& f) -> Json { return f.frameCount; }},
};

constexpr ReportRow<CurlNumbers> kWorstRows[] = {
    {{"droop_mm", "mm", "The droop of most magnitude, below 0 where the tip rose."},
     [](const CurlNumbers& f) -> Json { return 1000 * f.worstDroop; }},
    {{"core_elongation", "1", "The largest core elongation."},
     [](const CurlNumbers& f) -> Json { return f.worstCoreElongation; }},
    {{"tip_rotation_deg", "deg", "The tip rotation of most magnitude."},
     [](const CurlNumbers& f) -> Json { return f.worstTipRotation; }},
};

constexpr ReportRow<CurlNumbers> kCurlRows[] = {
    {{"droop_mm", "mm",
      "How far the tip is below its place at rest, below 0 where it rose; mean over strands, last frame."},
     [](const CurlNumbers& f) -> Json { return 1000 * f.droop; }},
    {{"core_elongation", "1", "Length of the curl's core over that at rest; mean over strands, last frame."},
     [](const CurlNumbers& f) -> Json { return f.coreElongation; }},
    {{"turns", "", "Turns; mean over strands that are curled at rest, last frame."},
     [](const CurlNumbers& f) -> Json { return f.turns; }},
    {{"mean_radius_mm", "mm", "Radius of the curl; mean over the same."},
     [](const CurlNumbers& f) -> Json { return 1000 * f.meanRadius; }},
    {{"handedness_kept", "", "Whether every curl keeps its hand, last frame."},
     [](const CurlNumbers& f) -> Json { return f.handednessKept; }},
    {{"arc_drift", "1",
      "Relative change of a strand's length, with its sign; of most magnitude over strands and frames."},
     [](const CurlNumbers& f) -> Json { return f.arcDrift; }},
    {{"max_edge_stretch", "1",
      "Longest edge over its length in the groom, over strands and frames (`ringlet scene`: over all steps)."},
     [](const CurlNumbers& f) -> Json { return f.maxEdgeStretch; }},
    {{"tip_rotation_deg", "deg",
      "Rotation of a tip about its core, full turns included; of the strand that turned most, last frame."},
     [](const CurlNumbers& f) -> Json { return f.tipRotation; }},
    {{"bounce_hz", "Hz",
      "Frequency of the core's length after the head last drove the hair; mean over strands that bounce, null "
      "where none does."},
     [](const CurlNumbers& f) -> Json { return orNull(f.bounceHz); }},
    {{"sway_hz", "Hz", "The same of the tip's sideways motion."},
     [](const CurlNumbers& f) -> Json { return orNull(f.swayHz); }},
    {{"settle_s", "s", "Time from then until the last strand rests; null where one does not."},
     [](const CurlNumbers& f) -> Json { return orNull(f.settleSeconds); }},
    {{"energy_ratio", "1",
      "Kinetic energy of the last second over its peak; 0 where nothing moved, null without motion."},
     [](const CurlNumbers& f) -> Json { return orNull(f.energyRatio); }},
    {{"worst", "", "Over strands and frames.", keysOf<kWorstRows>}, objectOf<kWorstRows>},
};

// How tables show it.
struct TableColumn {
  const char* label;
  const char* heading;  // over a line a strand
  double scale;
  int digits;
  bool onlyInPoses = false;  // says nothing about a groom alone
};

// A line of the table and of the JSON's spread: one value of every strand, in the unit shown.
template <class Strand>
struct StrandRow {
  ReportKey key;
  TableColumn column;
  double Strand::*member;
};
constexpr StrandRow<StrandMeasure> kRows[] = {
    {{"droop_mm", "mm", "How far the tip is below its place at rest."},
     {"droop [mm]", "droop mm", 1000, 3, true},
     &StrandMeasure::droop},
    {{"relative_droop", "1", "That as a share of the strand's length."},
     {"  of length [%]", "%", 100, 3, true},
     &StrandMeasure::relativeDroop},
    {{"core_elongation", "1", "Length of the core over that at rest."},
     {"core elongation", "core x", 1, 4, true},
     &StrandMeasure::coreElongation},
    {{"chord_elongation", "1", "The same of the chord, from root to tip."},
     {"chord elongation", "chord x", 1, 4, true},
     &StrandMeasure::chordElongation},
    {{"core_length_mm", "mm", "Length of the core."},
     {"core [mm]", "core mm", 1000, 2},
     &StrandMeasure::coreLength},
    {{"chord_mm", "mm", "Length of the chord."}, {"chord [mm]", "chord mm", 1000, 2}, &StrandMeasure::chord},
    {{"turns", "", "Turns about the core, counted as they wind at rest."},
     {"turns", "turns", 1, 3},
     &StrandMeasure::turns},
    {{"winding", "", "Turns, right-handed ones less left-handed ones."},
     {"winding [turns]", "winding", 1, 3},
     &StrandMeasure::winding},
    {{"mean_radius_mm", "mm", "Mean distance from the core."},
     {"radius [mm]", "radius mm", 1000, 3},
     &StrandMeasure::meanRadius},
    {{"handedness_share", "1", "Share of the curled length whose hand is that at rest."},
     {"hand kept [%]", "hand %", 100, 1, true},
     &StrandMeasure::handednessKept},
    {{"arc_drift", "1", "Relative change of the strand's length."},
     {"arc drift [%]", "drift %", 100, 4, true},
     &StrandMeasure::arcDrift},
    {{"max_edge_stretch", "1", "Longest edge over its length in the groom."},
     {"longest edge [x]", "edge x", 1, 4, true},
     &StrandMeasure::maxEdgeStretch},
    {{"tip_rotation_deg", "deg", "Rotation of the tip about the core, full turns included."},
     {"tip rotation [deg]", "tip deg", 1, 2, true},
     &StrandMeasure::tipRotation},
};

// Of the distances from --against.
constexpr StrandRow<ShapeDistance> kDistanceRows[] = {
    {{"particles", "1", "Between particles, root mean square, as a share of the strand's length."},
     {"particles [% length]", "apart %", 100, 4},
     &ShapeDistance::particles},
    {{"tip", "1", "Between the tips, likewise a share."},
     {"tip [% length]", "tip %", 100, 4},
     &ShapeDistance::tip},
    {{"core", "1", "Between the cores, as of particles."},
     {"core [% length]", "core %", 100, 4},
     &ShapeDistance::core},
    {{"direction_deg", "deg", "Angle between the cores' chords."},
     {"direction [deg]", "dir deg", 1, 2},
     &ShapeDistance::direction},
    {{"turns", "1", "By how much turns are more, as a share of those at rest."},
     {"turns [%]", "turns %", 100, 3},
     &ShapeDistance::turns},
    {{"radius", "1", "The same of the mean radius."},
     {"radius [%]", "radius %", 100, 3},
     &ShapeDistance::radius},
};

constexpr ReportRow<TipWays> kWayRows[] = {
    {{"way_mm", "mm", "How far tips are from where they are at rest, seen from the head."},
     [](const TipWays& f) -> Json { return 1000 * f.way; }},
    {{"against_way_mm", "mm", "The same in the other run."},
     [](const TipWays& f) -> Json { return 1000 * f.other; }},
    {{"tips", "1", "How far tips are from those of the other run, as a share of their way there."},
     [](const TipWays& f) -> Json { return orNull(f.apartShare()); }},
};

// A number a frame of each.
Json eachWay(const MotionBeside& beside) {
  Json json;
  for (const auto& row : kWayRows)
    for (const TipWays& frame : beside.frames) json[row.key.key].push_back(row.value(frame));
  return json;
}

constexpr ReportRow<MotionBeside> kBesideRows[] = {
    {{"frames", "", "Frames that both runs have; the numbers are means over these."},
     [](const MotionBeside& f) -> Json { return f.frames.size(); }},
    {kWayRows[0].key, [](const MotionBeside& f) { return kWayRows[0].value(f.mean); }},
    {kWayRows[1].key, [](const MotionBeside& f) { return kWayRows[1].value(f.mean); }},
    {{"way", "1", "The first as a share of the second."},
     [](const MotionBeside& f) -> Json { return orNull(f.mean.wayShare()); }},
    {kWayRows[2].key, [](const MotionBeside& f) { return kWayRows[2].value(f.mean); }},
    {{"kept", "1",
      "Of the overlap beyond rest that --against prevents in the worst frame of --without, the share that "
      "OTHER prevents; null without that."},
     [](const MotionBeside& f) -> Json { return orNull(f.kept); }},
    {{"each", "", "A number a frame.", keysOf<kWayRows>},
     eachWay,
     [](const MotionBeside& f) { return !f.frames.empty(); }},
};

// JSON has shares where the table has per cent.
double jsonScale(const TableColumn& column) { return column.scale == 100 ? 1 : column.scale; }

template <class Strand>
std::vector<double> valuesOf(const std::vector<Strand>& strands, const StrandRow<Strand>& row, double scale) {
  std::vector<double> values;
  for (const Strand& strand : strands) values.push_back(strand.*row.member * scale);
  return values;
}

std::string count(std::size_t number, const char* noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
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

// [mean, least, largest] of each row.
template <const auto& rows, class Strand>
Json spreadJson(const std::vector<Strand>& strands) {
  Json json;
  for (const auto& row : rows) {
    const Spread spread = spreadOf(valuesOf(strands, row, jsonScale(row.column)));
    json[row.key.key] = {spread.mean, spread.min, spread.max};
  }
  return json;
}

// A strand of those measured.
struct StrandSource {
  const Measured& measured;
  std::size_t strand;

  const StrandMotion& motion() const { return measured.motions[strand]; }
};
bool hasMotion(const StrandSource& from) { return !from.measured.motions.empty(); }

Json distanceJson(const StrandSource& from) {
  Json json;
  for (const auto& row : kDistanceRows)
    json[row.key.key] = from.measured.distances[from.strand].*row.member * jsonScale(row.column);
  return json;
}

constexpr ReportRow<StrandSource> kStrandCountRows[] = {
    {{"particles", "", "Its particles."},
     [](const StrandSource& f) -> Json { return f.measured.ruler.strand(f.strand).particleCount(); }},
};
constexpr ReportRow<StrandSource> kStrandRows[] = {
    {{"turns_at_rest", "", "Turns at rest."},
     [](const StrandSource& f) -> Json { return f.measured.ruler.strand(f.strand).rest().turns; }},
    {{"handedness", "", "Of the winding: 1 right, -1 left, 0 straight or as much one as the other."},
     [](const StrandSource& f) -> Json { return f.measured.strands[f.strand].handedness; }},
    {{"handedness_kept", "", "Whether it keeps its hand."},
     [](const StrandSource& f) -> Json {
       return f.measured.strands[f.strand].handednessKept >= kHandKeptShare;
     }},
    {{"bounce_hz", "Hz", "Frequency of the core's length, of a motion, as those that follow."},
     [](const StrandSource& f) -> Json { return orNull(f.motion().bounceHz); },
     hasMotion},
    {{"sway_hz", "Hz", "The same of the tip's sideways motion."},
     [](const StrandSource& f) -> Json { return orNull(f.motion().swayHz); },
     hasMotion},
    {{"settle_s", "s", "Time until it rests; null where it does not."},
     [](const StrandSource& f) -> Json { return orNull(f.motion().settleSeconds); },
     hasMotion},
    {{"energy_ratio", "1", "Kinetic energy of the last second over its peak."},
     [](const StrandSource& f) -> Json { return f.motion().energyRatio; },
     hasMotion},
    {{"against", "", "With --against, how far it is apart.", keysOf<kDistanceRows>},
     distanceJson,
     [](const StrandSource& f) { return !f.measured.distances.empty(); }},
};

Json strandJson(const StrandSource& from) {
  Json json = objectOf<kStrandCountRows>(from);
  for (const auto& row : kRows)
    json[row.key.key] = from.measured.strands[from.strand].*row.member * jsonScale(row.column);
  addRows<kStrandRows>(json, from);
  return json;
}

std::vector<ReportKey> strandKeys() {
  std::vector<ReportKey> keys = keysOf<kStrandRows>();
  keys.insert(keys.begin(), kStrandCountRows[0].key);
  return keys;
}

// What is told beside the numbers of the whole groom.
struct MeasuredSource {
  const Measured& measured;
  bool withStrands;
};

constexpr ReportRow<MeasuredSource> kMeasuredRows[] = {
    {{"limited_share", "", "Null: only a run knows it (`ringlet simulate --json`, `ringlet scene --json`)."},
     [](const MeasuredSource&) { return Json(); }},
    {{"velocity_residual", "", "Null likewise."}, [](const MeasuredSource&) { return Json(); }},
    {{"spread", "", "Of the last frame, over strands: [mean, least, largest].", keysOf<kRows>},
     [](const MeasuredSource& f) { return spreadJson<kRows>(f.measured.strands); }},
    {{"against", "", "With --against, how far the poses are apart: [mean, least, largest] over strands.",
      keysOf<kDistanceRows>},
     [](const MeasuredSource& f) { return spreadJson<kDistanceRows>(f.measured.distances); },
     [](const MeasuredSource& f) { return !f.measured.distances.empty(); }},
    {{"against_motion", "", "With --against, of two animations.", keysOf<kBesideRows>},
     [](const MeasuredSource& f) { return objectOf<kBesideRows>(*f.measured.beside); },
     [](const MeasuredSource& f) { return f.measured.beside.has_value(); }},
    {{"series", "", "With --plot: a number a frame.", seriesKeys},
     [](const MeasuredSource& f) { return seriesJson(*f.measured.series); },
     [](const MeasuredSource& f) { return f.measured.series.has_value(); }},
    {{"per_strand", "",
      "With --strands, every strand: numbers by the keys of spread, and beside them:", strandKeys},
     [](const MeasuredSource& f) {
       Json strands = Json::array();
       for (std::size_t s = 0; s < f.measured.strands.size(); ++s)
         strands.push_back(strandJson({f.measured, s}));
       return strands;
     },
     [](const MeasuredSource& f) { return f.withStrands; }},
};

}  // namespace

std::string shown(std::optional<double> value, int digits) {
  if (!value) return "-";
  const double unit = std::pow(10, -digits);
  return fmt::format("{:.{}f}", std::abs(*value) < unit / 2 ? 0.0 : *value, digits);
}

void addCurlKeys(nlohmann::ordered_json& json, const CurlNumbers& numbers) {
  addRows<kCurlRows>(json, numbers);
}

nlohmann::ordered_json measuredJson(const Measured& measured, bool withStrands) {
  nlohmann::ordered_json json = objectOf<kCountRows>(measured.numbers);
  addCurlKeys(json, measured.numbers);
  addRows<kMeasuredRows>(json, MeasuredSource{measured, withStrands});
  return json;
}

std::vector<ReportKey> measureKeys() {
  std::vector<ReportKey> keys = keysOf<kCountRows>();
  for (const auto& more : {keysOf<kCurlRows>(), keysOf<kMeasuredRows>()})
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
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
  for (const auto& row : kRows) {
    if (row.column.onlyInPoses && !measured.isPose) continue;
    const Spread spread = spreadOf(valuesOf(measured.strands, row, row.column.scale));
    line(row.column.label, spread, row.column.digits,
         row.member == &StrandMeasure::droop ? riseNote(spread.min) : "");
    if (!measured.isPose) continue;
    if (row.member == &StrandMeasure::turns) line("  at rest", groom.turnsAtRest, row.column.digits);
    if (row.member == &StrandMeasure::meanRadius) {
      const Spread& rest = groom.meanRadiusAtRest;
      line("  at rest [mm]", {1000 * rest.mean, 1000 * rest.min, 1000 * rest.max}, row.column.digits);
    }
  }
  if (!measured.distances.empty()) {
    text += fmt::format("\n  against {}\n", measured.against);
    for (const auto& row : kDistanceRows)
      line(row.column.label, spreadOf(valuesOf(measured.distances, row, row.column.scale)),
           row.column.digits);
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
  for (const auto& row : kRows)
    if (!row.column.onlyInPoses || measured.isPose) text += fmt::format("{:>10}", row.column.heading);
  if (!measured.motions.empty())
    text += fmt::format("{:>10}{:>10}{:>10}{:>10}", "bounce Hz", "sway Hz", "settle s", "energy");
  if (!measured.distances.empty()) {
    for (const auto& row : kDistanceRows) text += fmt::format("{:>10}", row.column.heading);
  }
  text += "\n";
  for (std::size_t s = 0; s < measured.strands.size(); ++s) {
    text += fmt::format("{:>7}{:>10}", s, measured.ruler.strand(s).particleCount());
    for (const auto& row : kRows) {
      if (!row.column.onlyInPoses || measured.isPose)
        text += fmt::format("{:>10}",
                            shown(measured.strands[s].*row.member * row.column.scale, row.column.digits));
    }
    if (!measured.motions.empty()) {
      const StrandMotion& motion = measured.motions[s];
      text += fmt::format("{:>10}{:>10}{:>10}{:>10.2g}", shown(motion.bounceHz, 3), shown(motion.swayHz, 3),
                          shown(motion.settleSeconds, 2), motion.energyRatio);
    }
    if (!measured.distances.empty()) {
      for (const auto& row : kDistanceRows)
        text += fmt::format("{:>10}",
                            shown(measured.distances[s].*row.member * row.column.scale, row.column.digits));
    }
    text += "\n";
  }
  return text;
}

}  // namespace ringlet::program
