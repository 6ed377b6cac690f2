// Implements make_command.h.
#include "program/convert/make_command.h"
#include "program/cli/standard_error.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "program/cli/command_line.h"
#include "program/cli/exit_codes.h"
#include "program/cli/key_options.h"
#include "program/cli/standard_output.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/scenes/file/scene_fields.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::program {
namespace {

// The options of all three kinds: a curl uses the curl only, the others their own and what they share.
struct TypedMake {
  std::filesystem::path file;
  CurlParameters curl;
  Variation variation;
  SwatchParameters swatch;
  HeadParameters head;
  TypedKeys cut;
  std::filesystem::path scalp;
  std::string style, hand = "right";
  bool quiet = false;
};

// On a scalp that is read first, where there is one.
Result<Groom> makeTypedHead(TypedMake& typed) {
  typed.head.curl = typed.curl;
  typed.head.variation = typed.variation;
  const std::string style = typed.style.empty() ? "" : fmt::format("style = \"{}\"\n", typed.style);
  const auto scene = parseTyped("[groom]\ngenerate = \"head\"\n" + style, "the head", typed.cut);
  if (!scene) return scene.error();
  typed.head.cut = scene->groom.cut;
  if (!typed.scalp.empty()) {
    auto scalp = readScalp(typed.scalp, typed.curl.metresPerUnit);
    if (!scalp) return scalp.error();
    typed.head.scalp = std::move(*scalp);
  }
  return makeHead(typed.head);
}

int write(const char* command, const TypedMake& typed, const Result<Groom>& groom) {
  if (!groom) {
    say("{}: {}\n", command, groom.error().message);
    return kExitUsage;
  }
  if (Status written = writeGroom(typed.file, *groom); !written) {
    say("{}: {}\n", command, written.error().message);
    return exitCodeOf(written.error());
  }
  if (const auto warning = coarseCurlWarning(typed.curl)) say("{}: warning: {}\n", command, *warning);
  if (!typed.quiet) {
    print("{} strand{}, {} particles: {}\n", groom->strandCount(), groom->strandCount() == 1 ? "" : "s",
          groom->points.size(), typed.file.string());
  }
  return kExitFine;
}

// Adds a numeric option that shows its default; what is in range, the generator knows and says, of numbers
// that the option can hold. Seeds have 32 bits, as in scene files.
template <class Number>
CLI::Option* addNumber(CLI::App* command, const char* name, Number& value, const char* what,
                       const char* unit) {
  CLI::Option* option =
      command->add_option(name, value, fmt::format("{} (default {})", what, value))->type_name(unit);
  if constexpr (std::is_integral_v<Number>)
    option->check(
        wholeBetween(0, static_cast<std::int64_t>(std::min<std::uint64_t>(
                            std::numeric_limits<Number>::max(), std::numeric_limits<std::uint32_t>::max()))));
  return option;
}

void addCurlOptions(CLI::App* command, TypedMake& typed) {
  command->add_option("-o,--output", typed.file, "File to write: .obj, .hair or .ply")
      ->required()
      ->check(endsIn({".obj", ".hair", ".ply"}))
      ->type_name("FILE");
  addNumber(command, "--radius", typed.curl.radius, "Radius of a curl, metres", "METRES");
  addNumber(command, "--turns", typed.curl.turns, "Turns from root to tip, 0 for straight hair", "N");
  addNumber(command, "--length", typed.curl.length, "Length of a curl, not of its wound strand, metres",
            "METRES");
  addNumber(command, "--particles", typed.curl.particleCount, "Particles a strand", "N");
  addNumber(command, "--phase", typed.curl.phase, "Where about its axis a curl begins, radians", "RADIANS");
  command->add_option("--hand", typed.hand, "Which way curls wind, right or left (default right)")
      ->check(oneOf({"right", "left"}))
      ->type_name("HAND");
  addNumber(command, "--unit", typed.curl.metresPerUnit, "Metres per unit of the file", "METRES");
  command->add_flag("--quiet", typed.quiet, "Print nothing");
}

void addVariationOptions(CLI::App* command, Variation& variation) {
  const char* group = "Differences between strands";
  auto add = [&](const char* name, auto& value, const char* what, const char* unit) {
    addNumber(command, name, value, what, unit)->group(group);
  };
  add("--vary-radius", variation.radius, "Largest relative difference of the radius", "SHARE");
  add("--vary-length", variation.length, "Largest relative difference of the length", "SHARE");
  add("--vary-phase", variation.phase, "Largest difference of the phase, as a share of a turn", "SHARE");
  add("--other-hand", variation.leftHandedShare, "Share of strands that wind the other way", "SHARE");
  add("--seed", variation.seed, "Another seed, another groom", "N");
}

}  // namespace

void addMakeCommand(CLI::App& app, int& exitCode) {
  CLI::App* make = app.add_subcommand("make", "Makes a groom: a curl, a swatch of curls or a head of them");
  make->require_subcommand(1);
  make->footer("Example:\n  ringlet make head --strands 2000 -o head.hair");

  auto curl = std::make_shared<TypedMake>();
  CLI::App* curlCommand = make->add_subcommand("curl", "One curl, hanging along -Y from the origin");
  addCurlOptions(curlCommand, *curl);
  curlCommand->footer("Example:\n  ringlet make curl --radius 0.01 --turns 8 --length 0.25 -o curl.obj");
  curlCommand->callback([curl, &exitCode] {
    curl->curl.handedness = curl->hand == "left" ? -1 : 1;
    exitCode = write("ringlet make curl", *curl, makeCurl(curl->curl));
  });

  auto swatch = std::make_shared<TypedMake>();
  CLI::App* swatchCommand =
      make->add_subcommand("swatch", "Curls side by side, hanging along -Y, columns along X");
  addCurlOptions(swatchCommand, *swatch);
  addNumber(swatchCommand, "--columns", swatch->swatch.columnCount, "Curls along X", "N");
  addNumber(swatchCommand, "--rows", swatch->swatch.rowCount, "Curls along Z", "N");
  addNumber(swatchCommand, "--spacing", swatch->swatch.spacing, "Distance between neighbours, metres",
            "METRES");
  addVariationOptions(swatchCommand, swatch->variation);
  swatchCommand->footer("Example:\n  ringlet make swatch --columns 12 --rows 4 --turns 10 -o swatch.obj");
  swatchCommand->callback([swatch, &exitCode] {
    swatch->curl.handedness = swatch->hand == "left" ? -1 : 1;
    swatch->swatch.curl = swatch->curl;
    swatch->swatch.variation = swatch->variation;
    exitCode = write("ringlet make swatch", *swatch, makeSwatch(swatch->swatch));
  });

  auto head = std::make_shared<TypedMake>();
  CLI::App* headCommand =
      make->add_subcommand("head", "A head of curls about the origin, Y up, looking along +Z");
  // Before the numbers it sets: options are taken in this order.
  headCommand
      ->add_option_function<std::string>(
          "--style",
          [head](const std::string& name) {
            head->style = name;
            head->head = *headOfStyle(name);
            head->curl = head->head.curl;
          },
          fmt::format(
              "Hair style, which sets length, radius, turns, locks and the cut: {}; what stands beside it "
              "goes before (default none)",
              kHairStyles))
      ->check(oneOf(namesIn(kHairStyles)))
      ->type_name("NAME");
  addCurlOptions(headCommand, *head);
  addNumber(headCommand, "--strands", head->head.strandCount, "Strands", "N");
  addNumber(headCommand, "--locks", head->head.lockCount,
            "Locks, of curls that wind alike; 0: every strand is a curl of its own", "N");
  addNumber(headCommand, "--scalp-radius", head->head.scalpRadius, "Radius of the head, metres", "METRES");
  headCommand
      ->add_option(
          "--scalp", head->scalp,
          "Mesh on which hair grows above the hairline, in place of a sphere: .obj in the unit of --unit, "
          "about the origin")
      ->type_name("FILE");
  addVariationOptions(headCommand, head->variation);
  addKeyOptions(*headCommand, head->cut, "groom.cut", "Cut");
  headCommand->footer(
      "Examples:\n  ringlet make head --strands 2000 --turns 10 --seed 7 -o head.hair\n"
      "  ringlet make head --style bob --parting right -o bob.obj");
  headCommand->callback([head, &exitCode] {
    head->curl.handedness = head->hand == "left" ? -1 : 1;
    exitCode = write("ringlet make head", *head, makeTypedHead(*head));
  });
}

}  // namespace ringlet::program
