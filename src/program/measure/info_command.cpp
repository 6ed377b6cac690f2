// Implements info_command.h. What is looked at stands in measure/groom_inspection.h, what --fix does in
// groom/mend_groom.h.
#include "program/measure/info_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/cli/written_groom.h"
#include "program/simulate/run_report.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/measure/groom_inspection.h"

namespace ringlet::program {
namespace {

constexpr double kParticlesPerTurn = 4;  // with which a curl keeps its shape

constexpr const char* kInfoExample =
    "Examples:\n"
    "  ringlet info groom.usd                         how many strands, how long, how curled, what is wrong\n"
    "  ringlet info groom.obj --unit 1                the same, in metres\n"
    "  ringlet info groom.ply --fix groom.hair        without repeated particles and broken strands\n"
    "  ringlet info groom.usd --fix groom.obj --particles 64\n"
    "\n"
    "A head's hair is 3 cm to 1 m long on average: units in which the groom would be as long are listed.\n"
    "Up is likely the axis against which the strands hang.\n"
    "\n"
    "Faults: repeated particles (in the place of the one before), short edges (below a thousandth of their\n"
    "strand's mean) and long ones (above 6 times the median), stray particles (in a place of several strands "
    "or at\n"
    "the origin, each edge to them above 4 times the median) and others in the place of another strand's, "
    "strands\n"
    "that end on the head where others begin (where one end of most strands is on a ball), strands all in "
    "one\n"
    "place, duplicates (the very particles of a strand before), strands 20 times shorter or longer than the\n"
    "median or 6 times as far from the middle of all. Strands that cannot be read, or hold numbers that are "
    "not\n"
    "finite, are left out with a warning; a file without any other fails with the reason.\n"
    "\n"
    "--fix takes out stray particles, merges repeated ones, drops strands in one place and duplicates, and "
    "leaves\n"
    "the other faults alone. --root-end last turns all strands round, --root-end head those that end on the "
    "head.\n"
    "With --particles each strand has that many, at equal distances along its edges; four a turn keep a "
    "curl. It\n"
    "writes in the file's unit, which its formats do not hold: a warning says what --unit and --up a groom "
    "needs\n"
    "from then on.\n"
    "\n"
    "--json keys: strands particles particles_per_strand length length_mm turns radius_mm arc_over_chord "
    "(each\n"
    "{min median mean max}; turns and radius_mm of curled strands) curled box {low high size} (in units)\n"
    "metres_per_unit unit_from (file, option, default) likely_units [{name metres_per_unit mean_length_mm}]\n"
    "up_from (file, or null) likely_up (Y, Z or null) faults {repeated_particles short_edges long_edges\n"
    "stray_particles shared_particles reversed_strands point_strands duplicates too_short too_long "
    "far_away}, each\n"
    "{count first_strand} (null without) warnings; with --fix also fixed {strands particles merged strays\n"
    "dropped_points dropped_duplicates output}.\n"
    "\n"
    "Exit status: 0 done, with faults or without, 2 wrong usage, 4 a file that cannot be read, 5 one that "
    "cannot\n"
    "be written, 1 other failures.";

// The command line as typed.
struct TypedInfo {
  std::filesystem::path input, output;
  std::optional<double> metresPerUnit;
  std::optional<std::string> up;
  TypedKeys groom;
  std::optional<int> particles;
  bool json = false;
};

struct InfoRow {
  const char* key;
  const char* sentence;  // with a place for the count
  GroomFault GroomInspection::*fault;
};
constexpr InfoRow kFaults[] = {
    {"repeated_particles", "repeated particles: {}", &GroomInspection::repeatedParticles},
    {"short_edges", "edges below a thousandth of their strand's mean: {}", &GroomInspection::shortEdges},
    {"long_edges", "edges 6 times longer than their strand's median: {}", &GroomInspection::longEdges},
    {"stray_particles", "particles far off where no hair is: {}", &GroomInspection::strayParticles},
    {"shared_particles", "particles in the very place of another strand's: {}",
     &GroomInspection::sharedParticles},
    {"reversed_strands", "strands that end on the head and begin away from it: {}",
     &GroomInspection::reversedStrands},
    {"point_strands", "strands all in one place: {}", &GroomInspection::pointStrands},
    {"duplicates", "strands that are there twice: {}", &GroomInspection::duplicates},
    {"too_short", "strands 20 times shorter than the median: {}", &GroomInspection::tooShort},
    {"too_long", "strands 20 times longer than the median: {}", &GroomInspection::tooLong},
    {"far_away", "strands far away from all others: {}", &GroomInspection::farAway},
};

// What --fix did.
struct Fixed {
  MendedGroom mended;
  std::vector<std::string> warnings;
};

nlohmann::ordered_json jsonOf(const Middle& middle, double scale = 1) {
  return {{"min", middle.min * scale},
          {"median", middle.median * scale},
          {"mean", middle.mean * scale},
          {"max", middle.max * scale}};
}
nlohmann::ordered_json jsonOf(Vec3d v) { return {v.x, v.y, v.z}; }

const char* unitFrom(const TypedInfo& typed, const LoadedGroom& loaded) {
  return typed.metresPerUnit ? "option" : loaded.statesUnit ? "file" : "default";
}

nlohmann::ordered_json infoJson(const TypedInfo& typed, const LoadedGroom& loaded,
                                const GroomInspection& found, const std::optional<Fixed>& fixed) {
  const double unit = loaded.groom.metresPerUnit;
  nlohmann::ordered_json json;
  json["strands"] = found.strandCount;
  json["particles"] = found.particleCount;
  json["particles_per_strand"] = jsonOf(found.particles);
  json["length"] = jsonOf(found.length);
  json["length_mm"] = jsonOf(found.length, 1000 * unit);
  json["curled"] = found.curledCount;
  json["turns"] = jsonOf(found.turns);
  json["radius_mm"] = jsonOf(found.radius, 1000 * unit);
  json["arc_over_chord"] = jsonOf(found.arcOverChord);
  json["box"] = {{"low", jsonOf(found.box.low)},
                 {"high", jsonOf(found.box.high)},
                 {"size", jsonOf(found.box.high - found.box.low)}};
  json["metres_per_unit"] = unit;
  json["unit_from"] = unitFrom(typed, loaded);
  json["likely_units"] = nlohmann::json::array();
  for (const LikelyUnit& likely : found.units) {
    json["likely_units"].push_back({{"name", likely.name},
                                    {"metres_per_unit", likely.metresPerUnit},
                                    {"mean_length_mm", 1000 * likely.meanLength}});
  }
  json["up_from"] = loaded.statesUp ? nlohmann::json("file") : nlohmann::json(nullptr);
  json["likely_up"] =
      found.likelyUp ? nlohmann::json(std::string(1, found.likelyUp)) : nlohmann::json(nullptr);
  for (const InfoRow& row : kFaults) {
    const GroomFault& fault = found.*row.fault;
    json["faults"][row.key] = {
        {"count", fault.count},
        {"first_strand", fault.count > 0 ? nlohmann::json(fault.firstStrand) : nlohmann::json(nullptr)}};
  }
  std::vector<std::string> warnings = loaded.warnings;
  if (fixed) {
    warnings.insert(warnings.end(), fixed->warnings.begin(), fixed->warnings.end());
    const MendedGroom& mended = fixed->mended;
    json["fixed"] = {{"strands", mended.groom.strandCount()},
                     {"particles", mended.groom.points.size()},
                     {"merged", mended.repeatedCount},
                     {"strays", mended.strayCount},
                     {"dropped_points", mended.pointStrandCount},
                     {"dropped_duplicates", mended.duplicateCount},
                     {"output", typed.output.string()}};
  }
  json["warnings"] = warnings;
  return json;
}

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1000 * metres); }

std::string unitText(const TypedInfo& typed, const LoadedGroom& loaded, const GroomInspection& found) {
  const std::string from = unitFrom(typed, loaded);
  std::string text = fmt::format("{} m, ", loaded.groom.metresPerUnit);
  text += from == "file"     ? "as the file states"
          : from == "option" ? "as typed"
                             : "the usual one; the file states none";
  if (found.units.empty()) return text + "; hair of a head would fit none of m, cm, mm and inch";
  text += "; hair of a head would fit ";
  for (std::size_t i = 0; i < found.units.size(); ++i) {
    text += fmt::format("{}{} (--unit {}, mean {})", i > 0 ? ", " : "", found.units[i].name,
                        found.units[i].metresPerUnit, millimetres(found.units[i].meanLength));
  }
  return text;
}

void printInfo(const TypedInfo& typed, const LoadedGroom& loaded, const GroomInspection& found) {
  const double unit = loaded.groom.metresPerUnit;
  print("{}: {} strand{}, {} particles\n", typed.input.string(), found.strandCount,
        found.strandCount == 1 ? "" : "s", found.particleCount);
  print("  particles     {} to {} a strand, median {}\n", found.particles.min, found.particles.max,
        found.particles.median);
  print("  length        {:.4g} to {:.4g} units, median {:.4g}: {} to {}, median {}\n", found.length.min,
        found.length.max, found.length.median, millimetres(found.length.min * unit),
        millimetres(found.length.max * unit), millimetres(found.length.median * unit));
  print("  unit          {}\n", unitText(typed, loaded, found));
  print("  up            {}; {}\n", loaded.statesUp ? "stated by the file" : "not stated by the file",
        found.likelyUp ? fmt::format("the strands hang along -{}", found.likelyUp)
                       : std::string("the strands hang along no axis"));
  print("  curl          {} of {} strands", found.curledCount, found.strandCount);
  if (found.curledCount > 0) {
    print(": {:.3g} to {:.3g} turns, median {:.3g}; radius {}", found.turns.min, found.turns.max,
          found.turns.median, millimetres(found.radius.median * unit));
  }
  print("\n  arc           {:.4g} to {:.4g} times the chord, median {:.4g}\n", found.arcOverChord.min,
        found.arcOverChord.max, found.arcOverChord.median);
  const Vec3d size = found.box.high - found.box.low;
  print(
      "  box           ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) units, {:.4g} x {:.4g} x "
      "{:.4g}\n",
      found.box.low.x, found.box.low.y, found.box.low.z, found.box.high.x, found.box.high.y, found.box.high.z,
      size.x, size.y, size.z);
  if (found.isFaultless()) print("  faults        none\n");
  for (const InfoRow& row : kFaults) {
    const GroomFault& fault = found.*row.fault;
    if (fault.count > 0) {
      print("  fault         {} (the first in strand {})\n",
            fmt::format(fmt::runtime(row.sentence), fault.count), fault.firstStrand);
    }
  }
}

Result<Fixed> fix(const TypedInfo& typed, const LoadedGroom& loaded, const GroomInspection& found) {
  Fixed fixed{mendGroom(loaded.groom, static_cast<std::size_t>(typed.particles.value_or(0))), {}};
  if (fixed.mended.groom.strandCount() == 0) {
    return Error{fmt::format("{}: all its strands are in one place, so that nothing is left to write",
                             typed.input.string())};
  }
  if (typed.particles && *typed.particles < kParticlesPerTurn * found.turns.max) {
    fixed.warnings.push_back(fmt::format(
        "{} particles are fewer than four a turn of the most curled strand, which has {:.1f} turns; it will "
        "lose its shape",
        *typed.particles, found.turns.max));
  }
  if (Status written = writeGroom(typed.output, fixed.mended.groom); !written) return written.error();
  for (std::string& lost : lostIn(typed.output, loaded.groom.metresPerUnit, typed.up == "Z"))
    fixed.warnings.push_back(std::move(lost));
  return fixed;
}

void printFixed(const TypedInfo& typed, const Fixed& fixed) {
  const MendedGroom& mended = fixed.mended;
  print(
      "\n{}: {} strands, {} particles, in units of {} m; {} particles merged and {} strays taken out, {} "
      "strands in one place and {} duplicates dropped\n",
      typed.output.string(), mended.groom.strandCount(), mended.groom.points.size(),
      mended.groom.metresPerUnit, mended.repeatedCount, mended.strayCount, mended.pointStrandCount,
      mended.duplicateCount);
}

int run(const TypedInfo& typed) {
  if (typed.particles && typed.output.empty())
    throw CLI::ValidationError("--particles", "only --fix writes strands; name its file");
  auto loaded = readGroom(typed.input, readingOf(typed.groom, typed.up == "Z"));
  if (!loaded) return fail("info", loaded.error());
  if (typed.metresPerUnit) loaded->groom.metresPerUnit = *typed.metresPerUnit;
  const GroomInspection found = inspectGroom(loaded->groom);
  std::optional<Fixed> fixed;
  if (!typed.output.empty()) {
    auto done = fix(typed, *loaded, found);
    if (!done) return fail("info", done.error());
    fixed = std::move(*done);
  }
  if (typed.json) {
    printJson(infoJson(typed, *loaded, found, fixed));
    return kExitFine;
  }
  for (const std::string& warning : loaded->warnings) say("ringlet info: warning: {}\n", warning);
  printInfo(typed, *loaded, found);
  if (!fixed) return kExitFine;
  for (const std::string& warning : fixed->warnings) say("ringlet info: warning: {}\n", warning);
  printFixed(typed, *fixed);
  return kExitFine;
}

}  // namespace

void addInfoCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedInfo>();
  CLI::App* command = app.add_subcommand("info", "Says what is in a groom's file, and mends it");
  command->footer(kInfoExample);
  command
      ->add_option("FILE", typed->input,
                   "A groom: .hair, .obj, .usda, .usdc, .usd, .usdz, .tfx, .ply, .data or .bin")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--unit", typed->metresPerUnit,
                   "Metres per unit of the file (default: what a USD file states, else 0.01: centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command
      ->add_option("--up", typed->up,
                   "The axis that is to point up, to which a USD file is turned, Y or Z (default Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS");
  addOptionsOfKeys(*command, typed->groom, {"groom.root_end", "groom.points_per_strand"});
  command->add_option("--fix", typed->output, "File to write a mended groom to: .hair, .obj or .ply")
      ->check(endsIn({".obj", ".hair", ".ply"}))
      ->type_name("OUT");
  command
      ->add_option("--particles", typed->particles,
                   "With --fix: particles of each strand (default: as they are)")
      ->check(wholeBetween(2, 65536))
      ->type_name("N");
  command->add_flag("--json", typed->json, "Print one JSON object instead of the summary");
  command->callback([typed, &exitCode] { exitCode = run(*typed); });
}

}  // namespace ringlet::program
