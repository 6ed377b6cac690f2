// Implements groom/strand_faults.h.
#include "ringlet/groom/strand_faults.h"

#include <cstddef>

#include "ringlet/groom/mend_groom.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/strand_length.h"
#include "ringlet/groom/stray_points.h"
#include "ringlet/groom/thrown_points.h"
#include "ringlet/groom/turned_strands.h"
#include "ringlet/groom/twin_strands.h"

namespace ringlet {
namespace {

Groom withoutNoise(const Groom& groom) {
  std::vector<bool> which = strayPoints(groom);
  const std::vector<bool> isThrown = thrownPoints(groom);
  for (std::size_t i = 0; i < which.size(); ++i) which[i] = which[i] || isThrown[i];
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    std::size_t left = 0;
    for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) left += which[i] ? 0 : 1;
    for (std::size_t i = groom.firstPoint[s]; left < 2 && i < groom.firstPoint[s + 1]; ++i) {
      if (which[i]) which[i] = false, ++left;
    }
  }
  return withoutPoints(groom, which);
}

}  // namespace

StrandFaults findStrandFaults(const Groom& groom, const ScalpSurface* scalp) {
  StrandFaults found;
  Groom clean = withoutNoise(groom);
  const std::size_t strands = clean.strandCount();
  found.isDuplicate = duplicatesIn(groom);
  std::vector<bool> isLeftOut = found.isDuplicate;
  for (std::size_t s = 0; s < strands; ++s)
    isLeftOut[s] = isLeftOut[s] || !(lengthAlong(clean.strand(s)) > 0);
  found.isTwin = twinStrands(clean, isLeftOut);
  found.strays = strayStrands(clean);
  for (std::size_t s = 0; s < strands; ++s) {
    if (found.isTwin[s]) found.strays.isTooLong[s] = found.strays.isFarAway[s] = false;
    isLeftOut[s] = isLeftOut[s] || found.isTwin[s] || found.strays.isTooLong[s] || found.strays.isFarAway[s];
  }
  found.isTurned = turnedStrands(clean, isLeftOut);
  turnRound(found.isTurned, clean);
  found.roots = rootHeights(clean, isLeftOut, scalp);
  return found;
}

}  // namespace ringlet
