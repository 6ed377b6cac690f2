// Implements output_options.h.
#include "program/simulate/output_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

#include "program/cli/command_line.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/scene/setting_field.h"

namespace ringlet::program {
namespace {

bool holds(const std::vector<std::string>& names, const char* name) {
  return std::ranges::find(names, name) != names.end();
}

// Animations without a flag of their own: "hair.usdc, hair.pc2".
std::string furtherFiles() {
  std::string files;
  for (const AnimationFormat& format : animationFormats())
    if (!format.hasPrecisions && format.extension != std::string_view(".usda"))
      files += fmt::format("{}hair{}", files.empty() ? "" : ", ", format.extension);
  return files;
}

}  // namespace

void addOutputOptions(CLI::App& command, OutputChoice& choice, TypedKeys& keys) {
  const char* group = "Output";
  command
      .add_flag("--usdc", choice.usdc, "Write hair.usdc too, binary USD: a third of the bytes of hair.usda")
      ->group(group);
  command
      .add_option("--also", choice.also,
                  "Further animations to write, separated by commas: " + furtherFiles())
      ->delimiter(',')
      ->check(oneOf(namesIn(furtherFiles())))
      ->type_name("LIST")
      ->group(group);
  command.add_flag("--no-usd", choice.noUsd, "Leave out hair.usda")->group(group);
  command.add_flag("--no-last", choice.noLast, "Leave out last.obj")->group(group);
  auto* noSheet = command.add_flag("--no-sheet", choice.noSheet, "Leave out sheet.png")->group(group);
  command
      .add_option("--sheet", choice.sheet,
                  "How sheet.png is drawn: drawn, in half a second; rendered as full hair, in five")
      ->check(oneOf({"drawn", "rendered"}))
      ->capture_default_str()
      ->excludes(noSheet)
      ->type_name("HOW")
      ->group(group);
  addKeyOptions(command, keys, "output", group);
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
}

void checkOutputs(const SceneOutput& output) {
  if (holds(output.values, "velocities") && !holds(output.files, "hair.usdc") &&
      !holds(output.files, "hair.abc") && !output.clipFrames)
    throw CLI::ValidationError("--usd-values",
                               "velocities are written into hair.usdc, hair.abc and clips only; add --usdc");
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
