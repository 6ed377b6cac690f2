// HairLook: how hairs that follow strands differ from them, as commands that make such hairs ask.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "program/cli_fwd.h"
#include "ringlet/follow/follow_hairs.h"

namespace ringlet::program {

struct HairLook {
  std::optional<double> frizz, clump, blend;
  std::filesystem::path
      scalp;  // an OBJ file of the mesh that their roots are on, in the groom's axes and unit

  bool isAsked() const { return frizz || clump || blend || !scalp.empty(); }
  FollowOptions of(FollowOptions options) const {
    options.frizz = frizz.value_or(options.frizz);
    options.gather = clump.value_or(options.gather);
    options.blend = blend.value_or(options.blend);
    return options;
  }
};

/// Adds --frizz, --clump, --blend and --hair-scalp. `look` must outlive the command.
void addHairLookOptions(CLI::App& command, HairLook& look, const std::string& group = "Options");

}  // namespace ringlet::program
