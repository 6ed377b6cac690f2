// HairLook: how following hairs differ from their strands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ringlet/follow/follow_hairs.h"

namespace ringlet {

struct HairLook {
  std::optional<double> frizz, clump, blend;
  std::filesystem::path
      scalp;  // an OBJ file of the mesh that their roots are on, in the groom's axes and unit

  FollowOptions of(FollowOptions options) const {
    options.frizz = frizz.value_or(options.frizz);
    options.gather = clump.value_or(options.gather);
    options.blend = blend.value_or(options.blend);
    return options;
  }
};

}  // namespace ringlet
