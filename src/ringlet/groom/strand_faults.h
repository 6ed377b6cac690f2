// What is wrong with the strands of a groom as a whole: each is named for one thing, the first of them in
// this order, so that a strand far away is not one with a floating root as well.
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/root_heights.h"
#include "ringlet/groom/scalp_surface.h"
#include "ringlet/groom/stray_strands.h"

namespace ringlet {

/// A word for each strand.
struct StrandFaults {
  std::vector<bool> isDuplicate{};  // of the very particles of one before (mend_groom.h)
  std::vector<bool> isTwin{};       // nearly one before (twin_strands.h)
  StrayStrands strays{};            // stray_strands.h
  std::vector<bool> isTurned{};     // from tip to root (turned_strands.h)
  RootHeights roots{};              // root_heights.h, of the strands as they are once they are turned round
};

/// Of a groom as readers return it; particles that are strays or thrown off do not count. `scalp` is what
/// roots are on [m], if that is known. Cost: n log n in the particles.
StrandFaults findStrandFaults(const Groom& groom, const ScalpSurface* scalp = nullptr);

}  // namespace ringlet
