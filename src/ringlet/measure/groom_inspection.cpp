// Implements measure/groom_inspection.h.
#include "ringlet/measure/groom_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "ringlet/base/median.h"
#include "ringlet/groom/coarse_curls.h"
#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/strand_faults.h"
#include "ringlet/groom/strand_length.h"
#include "ringlet/groom/stray_points.h"
#include "ringlet/groom/thrown_points.h"

namespace ringlet {
namespace {

constexpr std::array<LikelyUnit, 4> kUnits{
    {{"m", 1, 0}, {"cm", 0.01, 0}, {"mm", 0.001, 0}, {"inch", 0.0254, 0}}};
constexpr double kUpShare = 2;  // the total vector of all strands is this much larger downward than along
                                // both other axes

// The axis along which all strands together hang.
char upOf(Vec3d way) {
  const double down = std::max(-way.y, -way.z);
  if (!(down > 0)) return 0;
  const bool isZ = -way.z > -way.y;
  const double across = std::max(std::abs(way.x), std::abs(isZ ? way.y : way.z));
  if (down < kUpShare * across) return 0;
  return isZ ? 'Z' : 'Y';
}

// Faults of the edges of each strand, and strands without length.
void findEdgeFaults(const Groom& groom, std::span<const double> lengths, GroomInspection& found) {
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::span<const Vec3f> strand = groom.strand(s);
    if (!(lengths[s] > 0)) {
      found.pointStrands.add(s);
      continue;
    }
    const double longest = kLongEdge * medianEdge(strand), nothing = noEdgeLength(strand);
    const double shortest = kShortEdgeShare * lengths[s] / static_cast<double>(strand.size() - 1);
    for (std::size_t i = 1; i < strand.size(); ++i) {
      const double edge = length(Vec3d(strand[i]) - Vec3d(strand[i - 1]));
      found.longEdges.add(s, edge > longest);
      found.repeatedParticles.add(s, edge <= nothing);
      found.shortEdges.add(s, edge > nothing && edge < shortest);
    }
  }
}

void addTo(GroomFault& fault, const std::vector<bool>& which) {
  for (std::size_t s = 0; s < which.size(); ++s) {
    if (which[s]) fault.add(s);
  }
}

void addStrandFaults(const Groom& groom, const ScalpSurface* scalp, GroomInspection& found) {
  const StrandFaults faults = findStrandFaults(groom, scalp);
  addTo(found.duplicates, faults.isDuplicate);
  addTo(found.twins, faults.isTwin);
  addTo(found.tooShort, faults.strays.isTooShort);
  addTo(found.tooLong, faults.strays.isTooLong);
  addTo(found.farAway, faults.strays.isFarAway);
  addTo(found.reversedStrands, faults.isTurned);
  addTo(found.floatingRoots, faults.roots.isFloating);
  addTo(found.sunkRoots, faults.roots.isSunk);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::vector<Vec3d> strand(groom.strand(s).begin(), groom.strand(s).end());
    if (isCoarseCurl(strand)) found.coarseCurls.add(s);
  }
}

// Particles in the same place as others, far from all or off their strand.
void findPlaceFaults(const Groom& groom, GroomInspection& found) {
  const std::vector<bool> isShared = sharedPlaces(groom, duplicatesIn(groom));
  const std::vector<bool> isStray = strayPoints(groom), isThrown = thrownPoints(groom);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
      if (isThrown[i]) found.thrownParticles.add(s);
      if (isStray[i]) {
        found.strayParticles.add(s);
      } else if (isShared[i]) {
        found.sharedParticles.add(s);
      }
    }
  }
}

std::vector<double> lengthsOf(const Groom& groom) {
  std::vector<double> lengths;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) lengths.push_back(lengthAlong(groom.strand(s)));
  return lengths;
}

}  // namespace

Middle middleOf(std::vector<double> values) {
  if (values.empty()) return {};
  double sum = 0;
  for (const double value : values) sum += value;
  const auto [min, max] = std::ranges::minmax(values);
  return {min, medianOf(values), sum / static_cast<double>(values.size()), max};
}

std::vector<LikelyUnit> likelyUnits(double meanLength) {
  std::vector<LikelyUnit> likely;
  for (LikelyUnit unit : kUnits) {
    unit.meanLength = meanLength * unit.metresPerUnit;
    if (unit.meanLength >= kShortestHair && unit.meanLength <= kLongestHair) likely.push_back(unit);
  }
  return likely;
}

char likelyUpOf(const Groom& groom) {
  const StrandEnds ends = strandEnds(groom);
  Vec3d way;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) way += ends.last[s] - ends.first[s];
  return upOf(way);
}

GroomShape inspectShape(const Groom& groom) {
  GroomShape found;
  found.strandCount = groom.strandCount();
  found.particleCount = groom.points.size();
  if (groom.points.empty()) return found;
  found.box = boundsOf(groom.points);
  const std::vector<double> lengths = lengthsOf(groom);
  std::vector<double> counts, shares, turns, radii;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::vector<Vec3d> strand(groom.strand(s).begin(), groom.strand(s).end());
    counts.push_back(static_cast<double>(strand.size()));
    if (!(lengths[s] > 0)) continue;
    const double chord = length(strand.back() - strand.front());
    if (chord > kNoEdgeShare * lengths[s]) shares.push_back(lengths[s] / chord);
    const CurlShape shape = measureCurl(strand);
    if (shape.turns > 0) {
      ++found.curledCount;
      turns.push_back(shape.turns);
      radii.push_back(shape.radius);
    }
  }
  found.particles = middleOf(counts);
  found.length = middleOf(lengths);
  found.arcOverChord = middleOf(shares);
  found.turns = middleOf(turns);
  found.radius = middleOf(radii);
  found.likelyUp = likelyUpOf(groom);
  found.units = likelyUnits(found.length.mean);
  return found;
}

GroomInspection inspectGroom(const Groom& groom, const ScalpSurface* scalp) {
  GroomInspection found;
  static_cast<GroomShape&>(found) = inspectShape(groom);
  if (groom.points.empty()) return found;
  const std::vector<double> lengths = lengthsOf(groom);
  findEdgeFaults(groom, lengths, found);
  addStrandFaults(groom, scalp, found);
  findPlaceFaults(groom, found);
  return found;
}

}  // namespace ringlet
