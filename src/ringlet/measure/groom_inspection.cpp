// Implements measure/groom_inspection.h.
#include "ringlet/measure/groom_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ringlet/groom/curl_shape.h"
#include "ringlet/groom/mend_groom.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/groom/stray_points.h"

namespace ringlet {
namespace {

constexpr std::array<LikelyUnit, 4> kUnits{
    {{"m", 1, 0}, {"cm", 0.01, 0}, {"mm", 0.001, 0}, {"inch", 0.0254, 0}}};
constexpr double kUpShare = 2;  // the way down is this much larger than both ways across

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The axis that the strands hang along, all together.
char upOf(Vec3d way) {
  const double down = std::max(-way.y, -way.z);
  if (!(down > 0)) return 0;
  const bool isZ = -way.z > -way.y;
  const double across = std::max(std::abs(way.x), std::abs(isZ ? way.y : way.z));
  if (down < kUpShare * across) return 0;
  return isZ ? 'Z' : 'Y';
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

GroomInspection inspectGroom(const Groom& groom) {
  GroomInspection found;
  found.strandCount = groom.strandCount();
  found.particleCount = groom.points.size();
  if (groom.points.empty()) return found;
  found.low = found.high = Vec3d(groom.points.front());

  std::vector<double> counts, lengths, shares, turns, radii;
  std::vector<Vec3d> centres;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    std::vector<Vec3d> strand;
    Vec3d sum;
    for (const Vec3f p : groom.strand(s)) {
      strand.push_back(Vec3d(p));
      sum += strand.back();
      found.low = {std::min(found.low.x, strand.back().x), std::min(found.low.y, strand.back().y),
                   std::min(found.low.z, strand.back().z)};
      found.high = {std::max(found.high.x, strand.back().x), std::max(found.high.y, strand.back().y),
                    std::max(found.high.z, strand.back().z)};
    }
    std::vector<double> edges;
    double whole = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) {
      edges.push_back(length(strand[i] - strand[i - 1]));
      whole += edges.back();
    }
    const double chord = length(strand.back() - strand.front());
    counts.push_back(static_cast<double>(strand.size()));
    lengths.push_back(whole);
    centres.push_back(sum / static_cast<double>(strand.size()));
    if (!(whole > 0)) {
      found.pointStrands.add(s);
      continue;
    }
    if (chord > kNoEdgeShare * whole) shares.push_back(whole / chord);
    std::size_t none = 0, few = 0, many = 0;
    const double longest = kLongEdge * medianEdge(groom.strand(s)), nothing = noEdgeLength(groom.strand(s));
    for (const double edge : edges) {
      many += edge > longest;
      if (edge <= nothing) {
        ++none;
      } else if (edge < kShortEdgeShare * whole / static_cast<double>(edges.size())) {
        ++few;
      }
    }
    found.repeatedParticles.add(s, none);
    found.shortEdges.add(s, few);
    found.longEdges.add(s, many);
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

  // Strays, against the middle of all strands.
  std::array<std::vector<double>, 3> places;
  for (const Vec3d& centre : centres) {
    places[0].push_back(centre.x);
    places[1].push_back(centre.y);
    places[2].push_back(centre.z);
  }
  const Vec3d middle{medianOf(places[0]), medianOf(places[1]), medianOf(places[2])};
  std::vector<double> distances;
  for (const Vec3d& centre : centres) distances.push_back(length(centre - middle));
  // A groom of one strand, or all in a row, is not away from itself: its own length counts as near.
  const double near = std::max(middleOf(distances).median, found.length.median);
  for (std::size_t s = 0; s < lengths.size(); ++s) {
    if (lengths[s] > 0 && lengths[s] * kStrayLength < found.length.median) found.tooShort.add(s);
    if (lengths[s] > kStrayLength * found.length.median && found.length.median > 0) found.tooLong.add(s);
    if (distances[s] > kStrayDistance * near) found.farAway.add(s);
  }
  const std::vector<bool> isDuplicate = duplicatesIn(groom), isReversed = findRootEnds(groom).isReversed;
  const std::vector<bool> isShared = sharedPlaces(groom, isDuplicate), isStray = strayPoints(groom, isShared);
  for (std::size_t s = 0; s < isDuplicate.size(); ++s) {
    if (isDuplicate[s]) found.duplicates.add(s);
    if (isReversed[s]) found.reversedStrands.add(s);
    for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
      if (isStray[i]) {
        found.strayParticles.add(s);
      } else if (isShared[i]) {
        found.sharedParticles.add(s);
      }
    }
  }
  return found;
}

}  // namespace ringlet
