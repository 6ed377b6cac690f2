// The options that say how a groom's file is to be read, the same for every command that takes one.
#pragma once

#include <optional>
#include <string>

#include "program/cli/cli_fwd.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::program {

struct GroomChoice {
  std::optional<std::string> rootEnd;
  std::optional<int> pointsPerStrand;

  bool isMade() const { return rootEnd || pointsPerStrand; }
};

/// --root-end and --points-per-strand. `group`: of the help; empty for the command's own.
void addGroomOptions(CLI::App& command, GroomChoice& choice, const std::string& group = "");

/// --points-per-strand alone, where the root does not matter.
void addPointsOption(CLI::App& command, GroomChoice& choice, const std::string& group = "");

/// Into how a file is read.
GroomReading readingOf(const GroomChoice& choice, bool upIsZ = false);

/// What was typed in place of what a scene says. Throws CLI11's error for a groom that is generated.
void applyGroomOptions(const GroomChoice& choice, SceneGroom& groom);

}  // namespace ringlet::program
