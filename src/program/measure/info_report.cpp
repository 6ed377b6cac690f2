// Implements info_report.h.
#include "program/measure/info_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

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

struct FaultRow;

// A fault with what is said of it.
struct ToldFault {
  const GroomFault& fault;
  const FaultRow& row;
};

struct FaultRow {
  ReportKey key;
  const char* sentence;  // with a place for the count
  GroomFault GroomInspection::*fault;
  const char* means;  // for a simulation
  const char* fix;    // what --fix does
};

constexpr std::size_t kMostListed = 20;  // strands

Json listedOf(const GroomFault& fault) {
  Json json = Json::array();
  for (std::size_t k = 0; k < std::min(kMostListed, fault.strands.size()); ++k)
    json.push_back(fault.strands[k]);
  return json;
}

constexpr ReportRow<ToldFault> kFaultParts[] = {
    {{"count", "", "Their number."}, [](const ToldFault& f) -> Json { return f.fault.count; }},
    {{"first_strand", "", "The first strand that has one; null without."},
     [](const ToldFault& f) { return f.fault.count > 0 ? Json(f.fault.firstStrand) : Json(); }},
    {{"strands", "", "The first twenty strands that have one."},
     [](const ToldFault& f) { return listedOf(f.fault); }},
    {{"means", "", "What it means for a simulation, a sentence."},
     [](const ToldFault& f) -> Json { return f.row.means; }},
    {{"fix", "", "What --fix does, a sentence."}, [](const ToldFault& f) -> Json { return f.row.fix; }},
};

constexpr FaultRow kFaults[] = {
    {{"repeated_particles", "", "Particles in the place of the one before.", keysOf<kFaultParts>},
     "repeated particles: {}",
     &GroomInspection::repeatedParticles,
     "An edge without length has no direction; the strand is carried rigidly or needs more steps.",
     "--fix takes them out."},
    {{"short_edges", "", "Edges below a thousandth of their strand's mean.", keysOf<kFaultParts>},
     "edges below a thousandth of their strand's mean: {}",
     &GroomInspection::shortEdges,
     "Short edges are stiff, and the whole groom needs more steps a frame.",
     "--fix leaves them; --particles spaces all particles evenly."},
    {{"long_edges", "", "Edges above 6 times their strand's median.", keysOf<kFaultParts>},
     "edges 6 times longer than their strand's median: {}",
     &GroomInspection::longEdges,
     "The strand swings on them as on a rod; a particle may be out of its place.",
     "--fix takes out the strays and the particles thrown off at their ends, and leaves the others."},
    {{"stray_particles", "",
      "Particles in a place of several strands or at the origin, each edge to them above 4 times the median.",
      keysOf<kFaultParts>},
     "particles far off where no hair is: {}",
     &GroomInspection::strayParticles,
     "Their strands are far too long and whip across the head.",
     "--fix takes them out."},
    {{"thrown_particles", "",
      "Other particles alone off their strand: both edges above 6 times the median, or the one of an end above "
      "20 times.",
      keysOf<kFaultParts>},
     "particles thrown off their strand: {}",
     &GroomInspection::thrownParticles,
     "The strand is at rest with a spike in it, which it keeps.",
     "--fix takes them out."},
    {{"shared_particles", "", "Other particles in the place of another strand's.", keysOf<kFaultParts>},
     "particles in the very place of another strand's: {}",
     &GroomInspection::sharedParticles,
     "Strands of one root or tip are fine; contacts do not part what is in one place.",
     "--fix leaves them."},
    {{"reversed_strands", "",
      "Strands from tip to root: they end on the head, a ball, or where there is none among the roots of "
      "others.",
      keysOf<kFaultParts>},
     "strands that run from tip to root: {}",
     &GroomInspection::reversedStrands,
     "The head holds their tips, and their roots hang in the air.",
     "--fix turns them round."},
    {{"floating_roots", "", "Strands whose root is above the scalp.", keysOf<kFaultParts>},
     "roots above the scalp: {}",
     &GroomInspection::floatingRoots,
     "Hair grows out of the air beside the head.",
     "--fix moves the strands until their roots are on the scalp, unless most roots are off it."},
    {{"sunk_roots", "", "Strands whose root is below the scalp.", keysOf<kFaultParts>},
     "roots below the scalp: {}",
     &GroomInspection::sunkRoots,
     "Hair starts inside the head, which pushes it out and stretches it.",
     "--fix moves the strands until their roots are on the scalp, unless most roots are off it."},
    {{"point_strands", "", "Strands all in one place.", keysOf<kFaultParts>},
     "strands all in one place: {}",
     &GroomInspection::pointStrands,
     "They have no shape and are left out.",
     "--fix drops them."},
    {{"duplicates", "", "Strands of the very particles of one before.", keysOf<kFaultParts>},
     "strands that are there twice: {}",
     &GroomInspection::duplicates,
     "They cost time twice and do not touch each other.",
     "--fix drops all but the first."},
    {{"twins", "", "Strands nearly those of one before, from either end, to a ten-thousandth of the length.",
      keysOf<kFaultParts>},
     "strands nearly equal to another: {}",
     &GroomInspection::twins,
     "They cost time twice, and contacts push them apart in directions that rounding chose.",
     "--fix drops all but the first."},
    {{"too_short", "", "Strands 20 times shorter than the median.", keysOf<kFaultParts>},
     "strands 20 times shorter than the median: {}",
     &GroomInspection::tooShort,
     "Short strands are stiff, and the whole groom needs more steps a frame.",
     "--fix leaves them: they may be stubble."},
    {{"too_long", "", "Strands 20 times longer than the median, or 3 times longer than nine of ten.",
      keysOf<kFaultParts>},
     "strands much longer than all others: {}",
     &GroomInspection::tooLong,
     "They hang and swing apart from the rest and decide about steps and sizes.",
     "--fix drops them."},
    {{"far_away", "", "Strands 6 times as far from the middle of all as the median.", keysOf<kFaultParts>},
     "strands far away from all others: {}",
     &GroomInspection::farAway,
     "They are no hair of this head, and the box about all hair is theirs.",
     "--fix drops them."},
    {{"coarse_curls", "", "Strands of curls with fewer than four particles a turn.", keysOf<kFaultParts>},
     "curls with fewer than four particles a turn: {}",
     &GroomInspection::coarseCurls,
     "Their rest shape is a zigzag, and their curl opens, tightens or turns over.",
     "--fix leaves them: the shape between the particles is in no file; export the groom with more."},
};

Json faultsOf(const GroomInspection& found) {
  Json json;
  for (const FaultRow& row : kFaults)
    json[row.key.key] = objectOf<kFaultParts>(ToldFault{found.*row.fault, row});
  return json;
}

Json faultsJson(const Info& from) { return faultsOf(from.found); }
Json faultsAfterJson(const Info& from) { return faultsOf(from.fixed->after); }

constexpr ReportRow<Info> kRestRows[] = {
    {{"width", "", "Of a strand, in units: the mean distance of a root to the nearest root."},
     [](const Info& f) -> Json { return f.crossings->width; }},
    {{"overlapping_pairs", "", "Pairs of strands nearer than that, away from their roots."},
     [](const Info& f) -> Json { return f.crossings->overlappingPairs; }},
    {{"crossing_pairs", "", "Those nearer than a tenth of it: they go through each other."},
     [](const Info& f) -> Json { return f.crossings->pairs; }},
    {{"crossing_strands", "", "Strands that go through another."},
     [](const Info& f) -> Json { return f.crossings->strands; }},
    {{"first_strand", "", "The first of these; null without."},
     [](const Info& f) { return f.crossings->strands > 0 ? Json(f.crossings->firstStrand) : Json(); }},
};

Json restJson(const Info& from) { return from.crossings ? objectOf<kRestRows>(from) : Json(); }

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
    {{"thrown", "", "Particles off their strand taken out."},
     [](const Info& f) -> Json { return f.fixed->mended.thrownCount; }},
    {{"dropped_twins", "", "Twins dropped."},
     [](const Info& f) -> Json { return f.fixed->mended.twinCount; }},
    {{"dropped_strays", "", "Strands too long or far away, dropped."},
     [](const Info& f) -> Json { return f.fixed->mended.strayStrandCount; }},
    {{"turned", "", "Strands turned round."},
     [](const Info& f) -> Json { return f.fixed->mended.turnedCount; }},
    {{"moved", "", "Strands moved until their roots are on the scalp."},
     [](const Info& f) -> Json { return f.fixed->mended.movedCount; }},
    {{"faults", "", "What is left wrong, by kind.", keysOf<kFaults>}, faultsAfterJson},
    {{"output", "", "The file written."}, [](const Info& f) -> Json { return f.output.string(); }},
};

constexpr ReportRow<InfoMotion> kMotionRows[] = {
    {{"frames", "", "Frames."}, [](const InfoMotion& m) -> Json { return m.frameCount; }},
    {{"frames_per_second", "1/s", "Their rate."},
     [](const InfoMotion& m) -> Json { return m.framesPerSecond; }},
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
    {{"motion", "", "How its curves move; null where none does.", keysOf<kMotionRows>},
     [](const Info& f) { return f.motion ? objectOf<kMotionRows>(*f.motion) : Json(); }},
    {{"faults", "", "What is wrong, by kind.", keysOf<kFaults>}, faultsJson},
    {{"at_rest", "",
      "How hair lies in itself; null where roots have no distance or hair is too dense to count.",
      keysOf<kRestRows>},
     restJson},
    {{"fixed", "", "With --fix: what is written.", keysOf<kFixedRows>},
     objectOf<kFixedRows>,
     [](const Info& f) { return f.fixed != nullptr; }},
    {{"warnings", "", "Sentences for a person."}, warningsJson},
};

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1000 * metres); }

// Grown hair overlaps: a figure, and no fault.
std::string restText(const Info& from) {
  if (!from.crossings)
    return "pairs that overlap were not counted: roots have no distance, or hair is too dense";
  const RestCrossings& found = *from.crossings;
  return fmt::format(
      "{} pairs of strands are nearer than their width, {}, and {} of them go through each other{}; contacts "
      "keep what overlaps at rest as it is, and --fix leaves it",
      found.overlappingPairs, millimetres(found.width * from.unit()), found.pairs,
      found.strands > 0 ? fmt::format(" (in {} strands, the first is {})", found.strands, found.firstStrand)
                        : std::string());
}

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
  if (report.motion)
    text += fmt::format("  moves         {} frames, {:.6g} a second\n", report.motion->frameCount,
                        report.motion->framesPerSecond);
  text += fmt::format("  at rest       {}\n", restText(report));
  if (found.isFaultless()) text += "  faults        none\n";
  for (const FaultRow& row : kFaults) {
    const GroomFault& fault = found.*row.fault;
    if (fault.count > 0) {
      text += fmt::format(
          "  fault         {} (the first in strand {})\n                {}\n                {}\n",
          fmt::format(fmt::runtime(row.sentence), fault.count), fault.firstStrand, row.means, row.fix);
    }
  }
  return text;
}

std::string fixedText(const InfoReport& report) {
  const TreatedGroom& mended = report.fixed->mended;
  std::string text = fmt::format(
      "\n{}: {} strands, {} particles, in units of {} m; {} particles merged, {} strays and {} thrown off "
      "taken out, {} strands in one place, {} duplicates, {} twins and {} stray strands dropped, {} turned "
      "round, {} moved to the scalp\n",
      report.output.string(), mended.groom.strandCount(), mended.groom.points.size(),
      mended.groom.metresPerUnit, mended.repeatedCount, mended.strayCount, mended.thrownCount,
      mended.pointStrandCount, mended.duplicateCount, mended.twinCount, mended.strayStrandCount,
      mended.turnedCount, mended.movedCount);
  for (const FaultRow& row : kFaults) {
    const std::size_t before = (report.found.*row.fault).count,
                      after = (report.fixed->after.*row.fault).count;
    if (before + after > 0)
      text += fmt::format("  {}, then {}\n", fmt::format(fmt::runtime(row.sentence), before), after);
  }
  return text;
}

}  // namespace ringlet::program
