// `ringlet material`: what hair can be made of, number by number; and the options by which other commands
// choose it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/cli_fwd.h"
#include "ringlet/base/result.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addMaterialCommand(CLI::App& app, int& exitCode);

/// The material as asked for on a command line.
struct MaterialChoice {
  std::string name;                                          // a preset or a file; empty: the scene's
  std::optional<double> hold, bounce, springBack, curlKeep;  // each instead of the scene's own dial
  std::optional<double> maxStretch;                          // instead of the scene's bounce
};

/// Adds --material, --hold, --bounce, --spring-back, --curl-keep and --max-stretch. `choice` must outlive the
/// command.
void addMaterialOptions(CLI::App* command, MaterialChoice& choice, const std::string& group);

/// Throws CLI11's error for what makes no sense together, or with Integrator::paper.
void checkMaterialOptions(const MaterialChoice& choice, Integrator integrator);

/// Reads the material into a scene and turns its dials. Errors: a file that cannot be read.
Status applyMaterialOptions(const MaterialChoice& choice, SceneFile& scene);

}  // namespace ringlet::program
