// Implements hair_look_options.h.
#include "program/cli/hair_look_options.h"

#include <CLI/CLI.hpp>

#include "program/cli/command_line.h"

namespace ringlet::program {

void addHairLookOptions(CLI::App& command, HairLook& look, const std::string& group) {
  command
      .add_option(
          "--frizz", look.frizz,
          "How far hairs differ from the strand they follow: a factor, 0 to 10; 0: each curls just as its "
          "strand (default 1)")
      ->check(between(0, 10))
      ->type_name("X")
      ->group(group);
  command
      .add_option(
          "--clump", look.clump,
          "Mean share by which hairs of a strand come together beyond their roots, 0 to 1 (default 0.25)")
      ->check(between(0, 1))
      ->type_name("S")
      ->group(group);
  command
      .add_option(
          "--blend", look.blend,
          "Share, 0 to 1, of what the two nearest strands beside a hair's own have in its course; its curl "
          "stays that of its own. 1 for straight and wavy hair (default 0)")
      ->check(between(0, 1))
      ->type_name("S")
      ->group(group);
  command
      .add_option(
          "--hair-scalp", look.scalp,
          "An OBJ file in the groom's axes and unit: hairs' roots are on this mesh, evenly spread where "
          "strands stand (default: the mesh of the scene's scalp, else around strands' roots)")
      ->type_name("FILE")
      ->group(group);
}

}  // namespace ringlet::program
