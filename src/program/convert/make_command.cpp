// Implements make_command.h: options are keys of a scene's groom, which is generated as a scene's is.
#include "program/convert/make_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_error.h"
#include "program/cli/standard_output.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet::program {
namespace {

// The command line as typed.
struct TypedMake {
  std::string kind;  // a generator
  TypedKeys keys{};
  std::filesystem::path file{};
  bool quiet = false;
};

Result<LoadedGroom> generate(const TypedMake& typed) {
  const auto scene =
      parseTyped(fmt::format("[groom]\ngenerate = \"{}\"\n", typed.kind), typed.kind, typed.keys);
  if (!scene) return scene.error();
  return loadGroom(scene->groom);
}

int run(const TypedMake& typed) {
  const std::string command = "ringlet make " + typed.kind;
  const auto made = generate(typed);
  if (!made) {
    say("{}: {}\n", command, made.error().message);
    return kExitUsage;
  }
  const Groom& groom = made->groom;
  if (Status written = writeGroom(typed.file, groom, {.up = UpAxis::y}); !written) {
    say("{}: {}\n", command, written.error().message);
    return exitCodeOf(written.error());
  }
  for (const std::string& warning : made->warnings) say("{}: warning: {}\n", command, warning);
  if (!typed.quiet) {
    print("{} strand{}, {} particles: {}\n", groom.strandCount(), groom.strandCount() == 1 ? "" : "s",
          groom.points.size(), typed.file.string());
  }
  return kExitFine;
}

// What all kinds have.
CLI::App& addKind(CLI::App& make, const std::shared_ptr<TypedMake>& typed, const char* summary,
                  int& exitCode) {
  CLI::App& command = *make.add_subcommand(typed->kind, summary);
  command.add_option("-o,--output", typed->file, "File to write: " + writtenGroomEndings("or"))
      ->required()
      ->check(endsIn(writtenGroomEndings()))
      ->type_name("FILE");
  addOptionsOfKeys(command, typed->keys,
                   {"groom.radius", "groom.turns", "groom.length", "groom.particles", "groom.phase",
                    "groom.hand", "groom.unit"});
  command.add_flag("--quiet", typed->quiet, "Print nothing");
  command.callback([typed, &exitCode] { exitCode = run(*typed); });
  return command;
}

void addVariationOptions(CLI::App& command, TypedKeys& keys) {
  addOptionsOfKeys(
      command, keys,
      {"groom.vary_radius", "groom.vary_length", "groom.vary_phase", "groom.other_hand", "groom.seed"},
      "Differences between strands");
}

}  // namespace

void addMakeCommand(CLI::App& app, int& exitCode) {
  CLI::App* make = app.add_subcommand("make", "Makes a groom: a curl, a swatch of curls or a head of them");
  make->require_subcommand(1);
  make->footer("Example:\n  ringlet make head --strands 2000 -o head.hair");

  auto curl = std::make_shared<TypedMake>(TypedMake{.kind = "curl"});
  addKind(*make, curl, "One curl, hanging along -Y from the origin", exitCode)
      .footer("Example:\n  ringlet make curl --radius 0.01 --turns 8 --length 0.25 -o curl.obj");

  auto swatch = std::make_shared<TypedMake>(TypedMake{.kind = "swatch"});
  CLI::App& swatchCommand =
      addKind(*make, swatch, "Curls side by side, hanging along -Y, columns along X", exitCode);
  addOptionsOfKeys(swatchCommand, swatch->keys, {"groom.columns", "groom.rows", "groom.spacing"});
  addVariationOptions(swatchCommand, swatch->keys);
  swatchCommand.footer("Example:\n  ringlet make swatch --columns 12 --rows 4 --turns 10 -o swatch.obj");

  auto head = std::make_shared<TypedMake>(TypedMake{.kind = "head"});
  CLI::App& headCommand =
      addKind(*make, head, "A head of curls about the origin, Y up, looking along +Z", exitCode);
  addOptionsOfKeys(headCommand, head->keys,
                   {"groom.style", "groom.strands", "groom.locks", "groom.scalp_radius", "groom.scalp"});
  addVariationOptions(headCommand, head->keys);
  addKeyOptions(headCommand, head->keys, "groom.cut", "Cut");
  headCommand.footer(
      "Examples:\n  ringlet make head --strands 2000 --turns 10 --seed 7 -o head.hair\n"
      "  ringlet make head --style bob --parting right -o bob.obj");
}

}  // namespace ringlet::program
