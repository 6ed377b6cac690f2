// `ringlet material`: what hair can be made of, number by number; and the options by which other commands
// choose it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/cli/cli_fwd.h"
#include "ringlet/base/result.h"
#include "ringlet/rest/material_dials.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

/// Adds the subcommand; when it runs, `exitCode` receives the exit status of the program.
void addMaterialCommand(CLI::App& app, int& exitCode);

/// Dials as turned on a command line, in the order of dialParameters(); nothing where one is not.
using DialChoice = std::vector<std::optional<double>>;

/// The material as asked for on a command line.
struct MaterialChoice {
  std::string name;  // a preset or a file; empty: the scene's
  DialChoice dials;  // each instead of the scene's own
};

/// Adds an option for every dial: --hold, --bounce and so on. `choice` must outlive the command.
void addDialOptions(CLI::App* command, DialChoice& choice, const std::string& group);

/// Adds --material and the dials. `choice` must outlive the command.
void addMaterialOptions(CLI::App* command, MaterialChoice& choice, const std::string& group);

/// The dials, those of the command line turned.
MaterialDials turned(const DialChoice& choice, MaterialDials dials);

/// Throws CLI11's error for a dial that Integrator::paper, with spring constants of its own, does not have.
void checkDialOptions(const DialChoice& choice, Integrator integrator);

/// Reads the material into a scene and turns its dials. Errors: a file that cannot be read.
Status applyMaterialOptions(const MaterialChoice& choice, SceneFile& scene);

}  // namespace ringlet::program
