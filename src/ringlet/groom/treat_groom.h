// treatGroom: all that `ringlet info --fix` mends. mendGroom with what is wrong with whole strands.
#pragma once

#include <cstddef>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/groom/scalp_surface.h"

namespace ringlet {

struct GroomTreatment {
  std::size_t particleCount = 0;        // of each strand, as for mendGroom
  const ScalpSurface* scalp = nullptr;  // what roots are on [m]; null: what they span
};

struct TreatedGroom : MendedGroom {
  std::size_t thrownCount = 0;       // particles thrown off their strand, taken out (thrown_points.h)
  std::size_t twinCount = 0;         // strands that were nearly another, dropped (twin_strands.h)
  std::size_t strayStrandCount = 0;  // strands too long or far away, dropped (stray_strands.h)
  std::size_t turnedCount = 0;       // strands turned round (turned_strands.h)
  std::size_t movedCount = 0;        // strands moved as they are, until their root is on the scalp
};

/// Mends until there is nothing more to mend. Strands and particles that are right keep their bits and their
/// order. Roots are left where they are where most of them are off: the scalp has another place or unit.
/// Curls that are cut too coarsely, short strands and hair that overlaps at rest stay: what is lost is in no
/// file, and hair that is moved apart is another groom. Cost: that of findStrandFaults, a few times.
TreatedGroom treatGroom(const Groom& groom, const GroomTreatment& treatment = {});

/// Whether more than half of the strands have roots off the scalp, so that treatGroom moves none.
bool areMostRootsOff(const std::vector<bool>& isFloating, const std::vector<bool>& isSunk);

}  // namespace ringlet
