// Implements info_command.h. What is looked at stands in measure/groom_inspection.h, what --fix does in
// groom/treat_groom.h.
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
#include "program/cli/keys_help.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "program/cli/written_groom.h"
#include "program/measure/info_report.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_scalp.h"
#include "ringlet/groom/coarse_curls.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/treat_groom.h"
#include "ringlet/measure/groom_inspection.h"
#include "ringlet/measure/rest_crossings.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/groom_writer.h"

namespace ringlet::program {
namespace {

constexpr const char* kInfoExample =
    "Examples:\n"
    "  ringlet info groom.usd                         how many strands, how long, how curled, what is wrong\n"
    "  ringlet info groom.obj --unit 1                the same, in metres\n"
    "  ringlet info groom.ply --fix groom.hair        without repeated particles and broken strands\n"
    "  ringlet info scan.ply --scalp head.obj         how far roots are from the head's mesh\n"
    "  ringlet info groom.usd --fix groom.obj --particles 64\n"
    "\n"
    "A head's hair is 3 cm to 1 m long on average: units in which the groom would be as long are listed.\n"
    "Up is likely the axis against which the strands hang.\n"
    "\n"
    "Strands that cannot be read, or hold numbers that are not finite, are left out with a warning; a file\n"
    "without any other fails with the reason.\n"
    "\n"
    "--fix takes out particles that are strays or thrown off, merges repeated ones, drops strands in one "
    "place,\n"
    "duplicates, twins and strands far away or far too long, turns strands round that run from tip to root, "
    "moves\n"
    "strands whose roots are off the scalp, and leaves the other faults alone. It says what was wrong before "
    "and is\n"
    "afterwards. --root-end last turns all strands round before that. The scalp is what the roots span, or "
    "--scalp.\n"
    "With --particles each strand has that many, at equal distances along its edges; four a turn keep a "
    "curl. It\n"
    "writes in the file's unit, which .hair, .obj and .ply do not hold: a warning says what --unit and --up a\n"
    "groom needs from then on.\n"
    "\n";
constexpr const char* kInfoExitHelp =
    "\n"
    "Exit status: 0 done, with faults or without, 2 wrong usage, 4 a file that cannot be read, 5 one that "
    "cannot\n"
    "be written, 1 other failures.";

// The command line as typed.
struct TypedInfo {
  std::filesystem::path input, output, scalp;
  std::optional<double> metresPerUnit;
  std::optional<std::string> up;
  TypedKeys groom;
  std::optional<int> particles;
  bool json = false;
};

Result<std::shared_ptr<const ScalpSurface>> scalpOf(const TypedInfo& typed, double metresPerUnit) {
  if (typed.scalp.empty()) return std::shared_ptr<const ScalpSurface>();
  const auto mesh = readObjMesh(typed.scalp, metresPerUnit);
  if (!mesh) return mesh.error();
  return makeMeshScalp(*mesh);
}

Result<FixedGroom> fix(const TypedInfo& typed, const LoadedGroom& loaded, const GroomInspection& found,
                       const ScalpSurface* scalp) {
  FixedGroom fixed{
      treatGroom(loaded.groom,
                 {.particleCount = static_cast<std::size_t>(typed.particles.value_or(0)), .scalp = scalp}),
      {},
      {}};
  if (fixed.mended.groom.strandCount() == 0) {
    return Error{fmt::format("{}: all its strands are in one place, so that nothing is left to write",
                             typed.input.string())};
  }
  fixed.after = inspectGroom(fixed.mended.groom, scalp);
  if (fixed.after.floatingRoots.count + fixed.after.sunkRoots.count > fixed.after.strandCount / 2) {
    fixed.warnings.push_back(fmt::format(
        "{} of {} roots are off the scalp, so that no strand was moved: the groom has another unit or place "
        "than the scalp",
        fixed.after.floatingRoots.count + fixed.after.sunkRoots.count, fixed.after.strandCount));
  }
  if (typed.particles && *typed.particles < kParticlesPerTurn * found.turns.max) {
    fixed.warnings.push_back(fmt::format(
        "{} particles are fewer than four a turn of the most curled strand, which has {:.1f} turns; it will "
        "lose its shape",
        *typed.particles, found.turns.max));
  }
  if (Status written = writeGroom(typed.output, fixed.mended.groom, {.up = upOf(typed.up, loaded)}); !written)
    return written.error();
  for (std::string& lost : lostIn(typed.output, loaded.groom.metresPerUnit, typed.up == "Z"))
    fixed.warnings.push_back(std::move(lost));
  return fixed;
}

// Of a groom whose curves move, or nothing; of other animations an Error that says who reads them.
Result<std::optional<InfoMotion>> motionOf(const std::filesystem::path& path) {
  if (!isGroomFile(path) || isSequence(path)) {
    if (!holdsAnimation(path)) return std::optional<InfoMotion>{};
    return Error{fmt::format("{} is an animation; `ringlet convert {} --info` says what is in it",
                             path.string(), path.string()),
                 Fault::input};
  }
  if (!holdsForeignFrames(path)) return std::optional<InfoMotion>{};
  const auto frames = openForeignFrames(path, {});
  if (!frames) return frames.error();
  return std::optional(InfoMotion{(*frames)->frameCount(), (*frames)->framesPerSecond()});
}

int run(const TypedInfo& typed) {
  if (typed.particles && typed.output.empty())
    throw CLI::ValidationError("--particles", "only --fix writes strands; name its file");
  const auto motion = motionOf(typed.input);
  if (!motion) return fail("info", motion.error());
  auto loaded = readGroom(typed.input, readingOf(typed.groom, typed.up == "Z"));
  if (!loaded) return fail("info", loaded.error());
  if (typed.metresPerUnit) loaded->groom.metresPerUnit = *typed.metresPerUnit;
  const auto scalp = scalpOf(typed, loaded->groom.metresPerUnit);
  if (!scalp) return fail("info", scalp.error());
  const GroomInspection found = inspectGroom(loaded->groom, scalp->get());
  const std::optional<RestCrossings> crossings = restCrossings(loaded->groom);
  std::optional<FixedGroom> fixed;
  if (!typed.output.empty()) {
    auto done = fix(typed, *loaded, found, scalp->get());
    if (!done) return fail("info", done.error());
    fixed = std::move(*done);
  }
  const InfoReport report{typed.input,
                          typed.output,
                          typed.metresPerUnit  ? "option"
                          : loaded->statesUnit ? "file"
                                               : "default",
                          *loaded,
                          found,
                          crossings,
                          fixed ? &*fixed : nullptr,
                          *motion};
  if (typed.json) {
    printJson(infoJson(report));
    return kExitFine;
  }
  for (const std::string& warning : loaded->warnings) say("ringlet info: warning: {}\n", warning);
  print("{}", infoText(report));
  if (!fixed) return kExitFine;
  for (const std::string& warning : fixed->warnings) say("ringlet info: warning: {}\n", warning);
  print("{}", fixedText(report));
  return kExitFine;
}

}  // namespace

void addInfoCommand(CLI::App& app, int& exitCode) {
  auto typed = std::make_shared<TypedInfo>();
  CLI::App* command = app.add_subcommand("info", "Says what is in a groom's file, and mends it");
  command->footer(kInfoExample + keysHelp(infoKeys()) + kInfoExitHelp);
  command
      ->add_option("FILE", typed->input,
                   "A groom: .hair, .obj, .usda, .usdc, .usd, .usdz, .abc, .tfx, .ply, .data or .bin")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--unit", typed->metresPerUnit,
                   "Metres per unit of the file (default: what the file states, else 0.01: centimetres)")
      ->check(between(1e-6, 1000))
      ->type_name("METRES");
  command
      ->add_option(
          "--up", typed->up,
          "The axis that is to point up, to which a file that states another is turned, Y or Z (default Y)")
      ->check(oneOf({"Y", "Z"}))
      ->type_name("AXIS");
  command
      ->add_option("--scalp", typed->scalp,
                   "A closed mesh in the groom's unit and place, an .obj, that roots are on (default: what "
                   "the roots span)")
      ->check(endsIn({".obj"}))
      ->type_name("FILE");
  addOptionsOfKeys(*command, typed->groom, {"groom.root_end", "groom.points_per_strand"});
  command->add_option("--fix", typed->output, "File to write a mended groom to: " + writtenGroomEndings("or"))
      ->check(endsIn(writtenGroomEndings()))
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
