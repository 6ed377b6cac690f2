// Implements info_report.h.
#include "program/measure/info_report.h"

#include <fmt/format.h>

#include "ringlet/run/report_rows.h"

namespace ringlet::program {
namespace {

using Json = ReportJson;
using Info = InfoReport;

constexpr ReportRow<Middle> kMiddleRows[] = {
    {{"min", "", "The least."}, [](const Middle& f) -> Json { return f.min; }},
    {{"median", "", "The median."}, [](const Middle& f) -> Json { return f.median; }},
    {{"mean", "", "The mean."}, [](const Middle& f) -> Json { return f.mean; }},
    {{"max", "", "The largest."}, [](const Middle& f) -> Json { return f.max; }},
};

Json millimetresOf(const Middle& middle, const Info& from) {
  const double scale = 1000 * from.unit();
  return objectOf<kMiddleRows>(
      Middle{middle.min * scale, middle.median * scale, middle.mean * scale, middle.max * scale});
}

Json vectorOf(Vec3d v) { return {v.x, v.y, v.z}; }

constexpr ReportRow<Bounds> kBoxRows[] = {
    {{"low", "", "Its lower corner, [x, y, z]."}, [](const Bounds& f) { return vectorOf(f.low); }},
    {{"high", "", "Its upper corner."}, [](const Bounds& f) { return vectorOf(f.high); }},
    {{"size", "", "The way from one to the other."},
     [](const Bounds& f) { return vectorOf(f.high - f.low); }},
};

constexpr ReportRow<LikelyUnit> kUnitRows[] = {
    {{"name", "", "m, cm, mm or inch."}, [](const LikelyUnit& f) -> Json { return f.name; }},
    {{"metres_per_unit", "m", "What --unit would say."},
     [](const LikelyUnit& f) -> Json { return f.metresPerUnit; }},
    {{"mean_length_mm", "mm", "How long strands would be on average."},
     [](const LikelyUnit& f) -> Json { return 1000 * f.meanLength; }},
};

constexpr ReportRow<GroomFault> kFaultParts[] = {
    {{"count", "", "Their number."}, [](const GroomFault& f) -> Json { return f.count; }},
    {{"first_strand", "", "The first strand that has one; null without."},
     [](const GroomFault& f) { return f.count > 0 ? Json(f.firstStrand) : Json(); }},
};

struct FaultRow {
  ReportKey key;
  const char* sentence;  // with a place for the count
  GroomFault GroomInspection::*fault;
};
constexpr FaultRow kFaults[] = {
    {{"repeated_particles", "", "Particles in the place of the one before.", keysOf<kFaultParts>},
     "repeated particles: {}",
     &GroomInspection::repeatedParticles},
    {{"short_edges", "", "Edges below a thousandth of their strand's mean.", keysOf<kFaultParts>},
     "edges below a thousandth of their strand's mean: {}",
     &GroomInspection::shortEdges},
    {{"long_edges", "", "Edges above 6 times their strand's median.", keysOf<kFaultParts>},
     "edges 6 times longer than their strand's median: {}",
     &GroomInspection::longEdges},
    {{"stray_particles", "",
      "Particles in a place of several strands or at the origin, each edge to them above 4 times the median.",
      keysOf<kFaultParts>},
     "particles far off where no hair is: {}",
     &GroomInspection::strayParticles},
    {{"shared_particles", "", "Other particles in the place of another strand's.", keysOf<kFaultParts>},
     "particles in the very place of another strand's: {}",
     &GroomInspection::sharedParticles},
    {{"reversed_strands", "",
      "Strands that end on the head where others begin, where one end of most strands is on a ball.",
      keysOf<kFaultParts>},
     "strands that end on the head and begin away from it: {}",
     &GroomInspection::reversedStrands},
    {{"point_strands", "", "Strands all in one place.", keysOf<kFaultParts>},
     "strands all in one place: {}",
     &GroomInspection::pointStrands},
    {{"duplicates", "", "Strands of the very particles of one before.", keysOf<kFaultParts>},
     "strands that are there twice: {}",
     &GroomInspection::duplicates},
    {{"too_short", "", "Strands 20 times shorter than the median.", keysOf<kFaultParts>},
     "strands 20 times shorter than the median: {}",
     &GroomInspection::tooShort},
    {{"too_long", "", "Strands 20 times longer than the median.", keysOf<kFaultParts>},
     "strands 20 times longer than the median: {}",
     &GroomInspection::tooLong},
    {{"far_away", "", "Strands 6 times as far from the middle of all as the median.", keysOf<kFaultParts>},
     "strands far away from all others: {}",
     &GroomInspection::farAway},
};

Json faultsJson(const Info& from) {
  Json json;
  for (const FaultRow& row : kFaults) json[row.key.key] = objectOf<kFaultParts>(from.found.*row.fault);
  return json;
}

Json unitsJson(const Info& from) {
  Json json = Json::array();
  for (const LikelyUnit& likely : from.found.units) json.push_back(objectOf<kUnitRows>(likely));
  return json;
}

Json warningsJson(const Info& from) {
  std::vector<std::string> warnings = from.loaded.warnings;
  if (from.fixed) warnings.insert(warnings.end(), from.fixed->warnings.begin(), from.fixed->warnings.end());
  return warnings;
}

constexpr ReportRow<Info> kFixedRows[] = {
    {{"strands", "", "Strands that are left."},
     [](const Info& f) -> Json { return f.fixed->mended.groom.strandCount(); }},
    {{"particles", "", "Particles that are left."},
     [](const Info& f) -> Json { return f.fixed->mended.groom.points.size(); }},
    {{"merged", "", "Repeated particles taken out."},
     [](const Info& f) -> Json { return f.fixed->mended.repeatedCount; }},
    {{"strays", "", "Stray particles taken out."},
     [](const Info& f) -> Json { return f.fixed->mended.strayCount; }},
    {{"dropped_points", "", "Strands all in one place, dropped."},
     [](const Info& f) -> Json { return f.fixed->mended.pointStrandCount; }},
    {{"dropped_duplicates", "", "Duplicates dropped."},
     [](const Info& f) -> Json { return f.fixed->mended.duplicateCount; }},
    {{"output", "", "The file written."}, [](const Info& f) -> Json { return f.output.string(); }},
};

constexpr ReportRow<Info> kInfoRows[] = {
    {{"strands", "", "Strands."}, [](const Info& f) -> Json { return f.found.strandCount; }},
    {{"particles", "", "Particles."}, [](const Info& f) -> Json { return f.found.particleCount; }},
    {{"particles_per_strand", "", "Particles of a strand.", keysOf<kMiddleRows>},
     [](const Info& f) { return objectOf<kMiddleRows>(f.found.particles); }},
    {{"length", "", "Of a strand along its edges, in units.", keysOf<kMiddleRows>},
     [](const Info& f) { return objectOf<kMiddleRows>(f.found.length); }},
    {{"length_mm", "mm", "The same.", keysOf<kMiddleRows>},
     [](const Info& f) { return millimetresOf(f.found.length, f); }},
    {{"curled", "", "Strands that are curled."}, [](const Info& f) -> Json { return f.found.curledCount; }},
    {{"turns", "", "Of curled strands.", keysOf<kMiddleRows>},
     [](const Info& f) { return objectOf<kMiddleRows>(f.found.turns); }},
    {{"radius_mm", "mm", "Of curled strands.", keysOf<kMiddleRows>},
     [](const Info& f) { return millimetresOf(f.found.radius, f); }},
    {{"arc_over_chord", "1", "Length over the distance of root and tip, where these are apart.",
      keysOf<kMiddleRows>},
     [](const Info& f) { return objectOf<kMiddleRows>(f.found.arcOverChord); }},
    {{"box", "", "Around all particles, in units.", keysOf<kBoxRows>},
     [](const Info& f) { return objectOf<kBoxRows>(f.found.box); }},
    {{"metres_per_unit", "m", "The unit."}, [](const Info& f) -> Json { return f.unit(); }},
    {{"unit_from", "", "What says it: file, option or default."},
     [](const Info& f) -> Json { return f.unitFrom; }},
    {{"likely_units", "", "Those in which strands are on average as long as a head's hair.",
      keysOf<kUnitRows>},
     unitsJson},
    {{"up_from", "", "file where the file states its up axis, else null."},
     [](const Info& f) { return f.loaded.statesUp ? Json("file") : Json(); }},
    {{"likely_up", "", "Y or Z, against which the strands hang; null where they hang along neither."},
     [](const Info& f) { return f.found.likelyUp ? Json(std::string(1, f.found.likelyUp)) : Json(); }},
    {{"faults", "", "What is wrong, by kind.", keysOf<kFaults>}, faultsJson},
    {{"fixed", "", "With --fix: what is written.", keysOf<kFixedRows>},
     objectOf<kFixedRows>,
     [](const Info& f) { return f.fixed != nullptr; }},
    {{"warnings", "", "Sentences for a person."}, warningsJson},
};

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1000 * metres); }

std::string unitText(const Info& from) {
  const GroomInspection& found = from.found;
  std::string text = fmt::format("{} m, ", from.unit());
  text += from.unitFrom == "file"     ? "as the file states"
          : from.unitFrom == "option" ? "as typed"
                                      : "the usual one; the file states none";
  if (found.units.empty()) return text + "; hair of a head would fit none of m, cm, mm and inch";
  text += "; hair of a head would fit ";
  for (std::size_t i = 0; i < found.units.size(); ++i) {
    text += fmt::format("{}{} (--unit {}, mean {})", i > 0 ? ", " : "", found.units[i].name,
                        found.units[i].metresPerUnit, millimetres(found.units[i].meanLength));
  }
  return text;
}

}  // namespace

nlohmann::ordered_json infoJson(const InfoReport& report) { return objectOf<kInfoRows>(report); }

std::vector<ReportKey> infoKeys() { return keysOf<kInfoRows>(); }

std::string infoText(const InfoReport& report) {
  const GroomInspection& found = report.found;
  const double unit = report.unit();
  std::string text;
  text += fmt::format("{}: {} strand{}, {} particles\n", report.input.string(), found.strandCount,
                      found.strandCount == 1 ? "" : "s", found.particleCount);
  text += fmt::format("  particles     {} to {} a strand, median {}\n", found.particles.min,
                      found.particles.max, found.particles.median);
  text += fmt::format("  length        {:.4g} to {:.4g} units, median {:.4g}: {} to {}, median {}\n",
                      found.length.min, found.length.max, found.length.median,
                      millimetres(found.length.min * unit), millimetres(found.length.max * unit),
                      millimetres(found.length.median * unit));
  text += fmt::format("  unit          {}\n", unitText(report));
  text += fmt::format("  up            {}; {}\n",
                      report.loaded.statesUp ? "stated by the file" : "not stated by the file",
                      found.likelyUp ? fmt::format("the strands hang along -{}", found.likelyUp)
                                     : std::string("the strands hang along no axis"));
  text += fmt::format("  curl          {} of {} strands", found.curledCount, found.strandCount);
  if (found.curledCount > 0) {
    text += fmt::format(": {:.3g} to {:.3g} turns, median {:.3g}; radius {}", found.turns.min,
                        found.turns.max, found.turns.median, millimetres(found.radius.median * unit));
  }
  text += fmt::format("\n  arc           {:.4g} to {:.4g} times the chord, median {:.4g}\n",
                      found.arcOverChord.min, found.arcOverChord.max, found.arcOverChord.median);
  const Vec3d size = found.box.high - found.box.low;
  text += fmt::format(
      "  box           ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) units, {:.4g} x {:.4g} x "
      "{:.4g}\n",
      found.box.low.x, found.box.low.y, found.box.low.z, found.box.high.x, found.box.high.y, found.box.high.z,
      size.x, size.y, size.z);
  if (found.isFaultless()) text += "  faults        none\n";
  for (const FaultRow& row : kFaults) {
    const GroomFault& fault = found.*row.fault;
    if (fault.count > 0) {
      text += fmt::format("  fault         {} (the first in strand {})\n",
                          fmt::format(fmt::runtime(row.sentence), fault.count), fault.firstStrand);
    }
  }
  return text;
}

std::string fixedText(const InfoReport& report) {
  const MendedGroom& mended = report.fixed->mended;
  return fmt::format(
      "\n{}: {} strands, {} particles, in units of {} m; {} particles merged and {} strays taken out, {} "
      "strands in one place and {} duplicates dropped\n",
      report.output.string(), mended.groom.strandCount(), mended.groom.points.size(),
      mended.groom.metresPerUnit, mended.repeatedCount, mended.strayCount, mended.pointStrandCount,
      mended.duplicateCount);
}

}  // namespace ringlet::program
