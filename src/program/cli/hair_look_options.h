// The options by which commands choose how hairs that follow strands look.
#pragma once

#include <string>

#include "program/cli/cli_fwd.h"
#include "ringlet/pictures/hair_look.h"

namespace ringlet::program {

/// Adds --frizz, --clump, --blend and --hair-scalp. `look` must outlive the command.
void addHairLookOptions(CLI::App& command, HairLook& look, const std::string& group = "Options");

}  // namespace ringlet::program
