// HairLook: how hairs that follow strands differ from them, as commands that make such hairs ask.
#pragma once

#include <optional>
#include <string>

#include "program/cli_fwd.h"
#include "ringlet/follow/follow_hairs.h"

namespace ringlet::program {

struct HairLook {
  std::optional<double> frizz, clump;

  bool isAsked() const { return frizz || clump; }
  FollowOptions of(FollowOptions options) const {
    options.frizz = frizz.value_or(options.frizz);
    options.gather = clump.value_or(options.gather);
    return options;
  }
};

/// Adds --frizz and --clump. `look` must outlive the command.
void addHairLookOptions(CLI::App& command, HairLook& look, const std::string& group = "Options");

}  // namespace ringlet::program
