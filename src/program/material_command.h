// `ringlet material`: what hair can be made of, number by number; and the options by which other commands
// choose it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_file.h"
#include "ringlet/scene/settings.h"

namespace ringlet::program {

/// Adds the subcommand; `exitCode` receives what the program is to return once it has run.
void addMaterialCommand(CLI::App& app, int& exitCode);

/// The material as asked for on a command line.
struct MaterialChoice {
  std::string name;                      // a preset or a file; empty: Material{}
  std::optional<LoadedMaterial> loaded;  // already, from a scene file; counts where there is no name
  std::optional<double> hold, bounce, springBack, curlKeep;  // each instead of the file's own dial
  std::optional<double> maxStretch;                          // instead of the file's bounce
};

/// Adds --material, --hold, --bounce, --spring-back, --curl-keep and --max-stretch. `choice` must outlive the
/// command.
void addMaterialOptions(CLI::App* command, MaterialChoice& choice, const std::string& group);

/// Throws CLI11's error for what makes no sense together, or with Integrator::paper.
void checkMaterialOptions(const MaterialChoice& choice, Integrator integrator);

/// Reads the material and works the dials into it; sets maxStretch. What the user should know goes to
/// `warnings`.
Result<Material> chooseMaterial(const MaterialChoice& choice, Settings& settings,
                                std::vector<std::string>& warnings);

}  // namespace ringlet::program
