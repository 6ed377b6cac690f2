// Implements output_options.h.
#include "program/simulate/output_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

#include "program/cli/command_line.h"
#include "program/cli/hair_look_options.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/precision_names.h"
#include "ringlet/scene/setting_field.h"
#include "ringlet/scenes/file/scene_fields.h"

namespace ringlet::program {
namespace {

bool holds(const std::vector<std::string>& names, const char* name) {
  return std::ranges::find(names, name) != names.end();
}

// The animations of which a flag or --cache is not: "hair.usdc, hair.pc2".
std::string furtherFiles() {
  std::string files;
  for (const AnimationFormat& format : animationFormats())
    if (!format.hasPrecisions && format.extension != std::string_view(".usda"))
      files += fmt::format("{}hair{}", files.empty() ? "" : ", ", format.extension);
  return files;
}

// As the scene's table says it.
const SceneField<SceneOutput>& fieldOf(const char* key) { return *fieldNamed(outputFields(), key); }

}  // namespace

void addOutputOptions(CLI::App* command, OutputChoice& choice) {
  const char* group = "Output";
  command
      ->add_option("--cache", choice.cache,
                   "Write the animation as hair.rgc too, for `ringlet convert`: float32 (every bit) or 16bit")
      ->check(oneOf(precisionNames()))
      ->type_name("PRECISION")
      ->group(group);
  command
      ->add_flag("--usdc", choice.usdc, "Write hair.usdc too, binary USD: a third of the bytes of hair.usda")
      ->group(group);
  command
      ->add_option("--also", choice.also,
                   "Further animations to write, separated by commas: " + furtherFiles())
      ->delimiter(',')
      ->check(oneOf(namesIn(furtherFiles())))
      ->type_name("LIST")
      ->group(group);
  command->add_flag("--no-usd", choice.noUsd, "Leave out hair.usda")->group(group);
  command->add_flag("--no-last", choice.noLast, "Leave out last.obj")->group(group);
  auto* noSheet = command->add_flag("--no-sheet", choice.noSheet, "Leave out sheet.png")->group(group);
  command
      ->add_option("--sheet", choice.sheet,
                   "How sheet.png is drawn: drawn, in half a second; rendered as full hair, in five")
      ->check(oneOf({"drawn", "rendered"}))
      ->capture_default_str()
      ->excludes(noSheet)
      ->type_name("HOW")
      ->group(group);
  command
      ->add_option("--width", choice.width, "Diameter of strands in what is written, metres (default 0.0005)")
      ->check(between(1e-9, 1))
      ->type_name("METRES")
      ->group(group);
  command->add_option("--tip-width", choice.tipWidth, fieldOf("tip_width").effect)
      ->check(between(1e-9, 1))
      ->type_name("METRES")
      ->group(group);
  command
      ->add_option(
          "--usd-values", choice.values,
          std::string(fieldOf("values").effect) + " Separated by commas: " + fieldOf("values").choices)
      ->delimiter(',')
      ->check(oneOf(namesIn(fieldOf("values").choices)))
      ->type_name("LIST")
      ->group(group);
  command->add_option("--head", choice.head, fieldOf("head").effect)
      ->check(oneOf(namesIn(fieldOf("head").choices)))
      ->type_name("WAY")
      ->group(group);
  command->add_option("--clips", choice.clips, fieldOf("clip_frames").effect)
      ->check(wholeBetween(1, 1'000'000))
      ->type_name("N")
      ->group(group);
  command->add_option("--hairs", choice.hairs, fieldOf("hairs").effect)
      ->check(wholeBetween(1, 10'000'000))
      ->type_name("N")
      ->group(group);
  addHairLookOptions(*command, choice.look, group);
  command->add_option("--usd-prims", choice.prims, fieldOf("prims").effect)
      ->check(oneOf(namesIn(fieldOf("prims").choices)))
      ->type_name("WHOSE")
      ->group(group);
}

void applyOutputOptions(const OutputChoice& choice, SceneOutput& output) {
  const auto leaveOut = [&](bool isLeftOut, const char* file) {
    if (isLeftOut) std::erase(output.files, file);
  };
  leaveOut(choice.noUsd, "hair.usda");
  leaveOut(choice.noLast, "last.obj");
  leaveOut(choice.noSheet, "sheet.png");
  std::vector<std::string> also = choice.also;
  if (choice.usdc) also.emplace_back("hair.usdc");
  for (const std::string& file : also)
    if (!holds(output.files, file.c_str())) output.files.push_back(file);
  if (!choice.cache.empty()) output.cache = choice.cache;
  if (choice.width) output.width = *choice.width;
  if (choice.tipWidth) output.tipWidth = choice.tipWidth;
  if (choice.head) output.head = *choice.head;
  if (choice.clips) output.clipFrames = choice.clips;
  if (choice.hairs) output.hairs = choice.hairs;
  output.frizz = choice.look.frizz.value_or(output.frizz);
  output.clump = choice.look.clump.value_or(output.clump);
  output.blend = choice.look.blend.value_or(output.blend);
  if (!choice.look.scalp.empty()) output.hairScalpFile = choice.look.scalp;
  if (choice.prims) output.prims = *choice.prims;
  if (!choice.values.empty()) output.values = choice.values;
}

void checkOutputs(const SceneOutput& output) {
  if (holds(output.values, "velocities") && !holds(output.files, "hair.usdc") && !output.clipFrames)
    throw CLI::ValidationError("--usd-values",
                               "velocities are written into hair.usdc and clips only; add --usdc");
  if (output.clipFrames && !holds(output.files, "hair.usda"))
    throw CLI::ValidationError("--clips", "only hair.usda has clips; leave out --no-usd");
  if (!output.hairs &&
      (output.frizz != SceneOutput{}.frizz || output.clump != SceneOutput{}.clump ||
       output.blend != SceneOutput{}.blend || !output.hairScalp.empty() || !output.hairScalpFile.empty()))
    throw CLI::ValidationError("--hairs", "only such hairs have frizz, clumps and blends; say how many");
  if (output.hairs && needsOrigin(output))
    throw CLI::ValidationError(
        "--hairs",
        "hairs have no prims and no values in the groom's file; leave --usd-prims groom and --usd-values "
        "groom out");
  if (output.prims != "groom") return;
  if (!holds(output.files, "hair.usdc") || holds(output.files, "hair.usda"))
    throw CLI::ValidationError("--usd-prims",
                               "the groom's own prims are written into hair.usdc only; say --usdc --no-usd");
  if (output.head == "transform")
    throw CLI::ValidationError("--head",
                               "the groom's own prims have their own transforms; choose baked or none");
}

}  // namespace ringlet::program
