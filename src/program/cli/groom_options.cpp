// Implements groom_options.h.
#include "program/cli/groom_options.h"

#include <CLI/CLI.hpp>

#include "program/cli/command_line.h"
#include "ringlet/scenes/load/scene_parts.h"

namespace ringlet::program {

void addGroomOptions(CLI::App& command, GroomChoice& choice, const std::string& group) {
  CLI::Option* end =
      command
          .add_option(
              "--root-end", choice.rootEnd,
              "Which end of each strand of the file is its root: first (default) or last point, or of each "
              "the one on the head, a ball on which most strands have an end")
          ->check(oneOf({"first", "last", "head"}))
          ->type_name("END");
  if (!group.empty()) end->group(group);
  addPointsOption(command, choice, group);
}

void addPointsOption(CLI::App& command, GroomChoice& choice, const std::string& group) {
  CLI::Option* points = command
                            .add_option("--points-per-strand", choice.pointsPerStrand,
                                        "Points of each strand, of a file that holds points and nothing else")
                            ->check(wholeBetween(2, kMostPointsPerStrand))
                            ->type_name("N");
  if (!group.empty()) points->group(group);
}

GroomReading readingOf(const GroomChoice& choice, bool upIsZ) {
  SceneGroom groom;
  groom.up = upIsZ ? "Z" : "Y";
  applyGroomOptions(choice, groom);
  return ringlet::readingOf(groom);
}

void applyGroomOptions(const GroomChoice& choice, SceneGroom& groom) {
  if (choice.isMade() && !groom.generate.empty()) {
    throw CLI::ValidationError(choice.rootEnd ? "--root-end" : "--points-per-strand",
                               "is of a groom from a file; this one is generated");
  }
  if (choice.rootEnd) groom.rootEnd = *choice.rootEnd;
  if (choice.pointsPerStrand) groom.pointsPerStrand = *choice.pointsPerStrand;
}

}  // namespace ringlet::program
