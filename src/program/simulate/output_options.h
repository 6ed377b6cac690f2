// The options for the output files of `ringlet simulate`.
#pragma once

#include <string>
#include <vector>

#include "program/cli/cli_fwd.h"
#include "program/cli/key_options.h"
#include "ringlet/run/run_options.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// Options as typed; keys of [output] are typed elsewhere.
struct OutputChoice {
  std::string sheet = "drawn";    // or rendered
  std::vector<std::string> also;  // further animations
  bool usdc = false, noUsd = false, noLast = false, noSheet = false;
};

/// Adds the group of options "Output". `choice` and `keys` must outlive the command.
void addOutputOptions(CLI::App& command, OutputChoice& choice, TypedKeys& keys);

/// Applies what was typed to the scene's output.
void applyOutputOptions(const OutputChoice& choice, SceneOutput& output);

/// Throws CLI11's error for outputs that exclude each other.
void checkOutputs(const SceneOutput& output);

}  // namespace ringlet::program
