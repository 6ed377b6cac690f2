// The options by which `ringlet simulate` chooses what it writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/cli/cli_fwd.h"
#include "ringlet/pictures/hair_look.h"
#include "ringlet/run/run_options.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// Outputs as typed; what is left out is the scene's.
struct OutputChoice {
  std::string cache;  // a precision of hair.rgc
  std::optional<double> width, tipWidth;
  std::optional<std::string> head, prims;
  std::optional<int> clips, hairs;
  HairLook look;  // of these hairs
  std::vector<std::string> values;
  std::string sheet = "drawn";    // or rendered
  std::vector<std::string> also;  // further animations
  bool usdc = false, noUsd = false, noLast = false, noSheet = false;
};

/// Adds the group of options "Output". `choice` must outlive the command.
void addOutputOptions(CLI::App* command, OutputChoice& choice);

/// What was typed in place of what the scene says.
void applyOutputOptions(const OutputChoice& choice, SceneOutput& output);

/// Throws CLI11's error for what makes no sense together.
void checkOutputs(const SceneOutput& output);

}  // namespace ringlet::program
