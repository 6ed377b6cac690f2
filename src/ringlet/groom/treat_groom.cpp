// Implements groom/treat_groom.h.
#include "ringlet/groom/treat_groom.h"

#include <algorithm>
#include <utility>

#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/strand_faults.h"
#include "ringlet/groom/thrown_points.h"

namespace ringlet {
namespace {

// What is mended may show more, such as a strand whose twin is turned round. No groom of the tests takes
// more than three.
constexpr int kMostRounds = 8;

std::size_t countOf(const std::vector<bool>& which) {
  return static_cast<std::size_t>(std::ranges::count(which, true));
}

void mendParticles(TreatedGroom& treated) {
  MendedGroom mended = mendGroom(treated.groom);
  treated.groom = std::move(mended.groom);
  treated.repeatedCount += mended.repeatedCount;
  treated.pointStrandCount += mended.pointStrandCount;
  treated.duplicateCount += mended.duplicateCount;
  treated.strayCount += mended.strayCount;
}

bool takeOutThrown(TreatedGroom& treated) {
  const std::vector<bool> isThrown = thrownPoints(treated.groom);
  const std::size_t count = countOf(isThrown);
  if (count == 0) return false;
  treated.groom = withoutPoints(treated.groom, isThrown);
  treated.thrownCount += count;
  return true;
}

// Moves each whose root is off the scalp, as a whole.
std::size_t moveToScalp(const RootHeights& roots, Groom& groom) {
  if (areMostRootsOff(roots.isFloating, roots.isSunk)) return 0;
  std::size_t count = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (!roots.isFloating[s] && !roots.isSunk[s]) continue;
    const Vec3d way = roots.outward[s] * -roots.above[s];
    for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i)
      groom.points[i] = Vec3f(Vec3d(groom.points[i]) + way);
    ++count;
  }
  return count;
}

// Says whether it changed anything.
bool mendStrands(const ScalpSurface* scalp, TreatedGroom& treated) {
  const StrandFaults found = findStrandFaults(treated.groom, scalp);
  const std::size_t turned = countOf(found.isTurned);
  turnRound(found.isTurned, treated.groom);
  const std::size_t moved = moveToScalp(found.roots, treated.groom);
  treated.turnedCount += turned;
  treated.movedCount += moved;
  const Groom groom = std::move(treated.groom);
  treated.groom = {};
  treated.groom.metresPerUnit = groom.metresPerUnit;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    if (found.isTwin[s]) {
      ++treated.twinCount;
    } else if (found.strays.isTooLong[s] || found.strays.isFarAway[s]) {
      ++treated.strayStrandCount;
    } else {
      treated.groom.addStrand(groom.strand(s));
    }
  }
  return turned + moved > 0 || treated.groom.strandCount() < groom.strandCount();
}

}  // namespace

bool areMostRootsOff(const std::vector<bool>& isFloating, const std::vector<bool>& isSunk) {
  return countOf(isFloating) + countOf(isSunk) > isFloating.size() / 2;
}

TreatedGroom treatGroom(const Groom& groom, const GroomTreatment& treatment) {
  TreatedGroom treated;
  treated.groom = groom;
  bool isChanged = true;
  for (int round = 0; isChanged && round < kMostRounds; ++round) {
    mendParticles(treated);
    isChanged = takeOutThrown(treated);
    if (treated.groom.strandCount() > 0) isChanged = mendStrands(treatment.scalp, treated) || isChanged;
  }
  if (treatment.particleCount >= 2) treated.groom = mendGroom(treated.groom, treatment.particleCount).groom;
  return treated;
}

}  // namespace ringlet
