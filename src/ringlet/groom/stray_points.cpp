// Implements groom/stray_points.h.
#include "ringlet/groom/stray_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "ringlet/base/assert.h"
#include "ringlet/groom/mend_groom.h"

namespace ringlet {
namespace {

double edgeOf(Vec3f a, Vec3f b) { return length(Vec3d(b) - Vec3d(a)); }

std::vector<double> edgesOf(std::span<const Vec3f> strand) {
  std::vector<double> edges;
  for (std::size_t i = 1; i < strand.size(); ++i) edges.push_back(edgeOf(strand[i - 1], strand[i]));
  return edges;
}

// The one that stands `share` of `all` up from the shortest, the lower of two; 0 without any.
double inOrder(std::vector<double>& edges, std::size_t share, std::size_t all) {
  if (edges.empty()) return 0;
  const auto found = edges.begin() + static_cast<std::ptrdiff_t>((edges.size() - 1) * share / all);
  std::ranges::nth_element(edges, found);
  return *found;
}

// Particles of a strand that follow each other in one place.
struct Stop {
  std::size_t first = 0, count = 0;
};

std::vector<Stop> stopsOf(std::span<const Vec3f> strand) {
  std::vector<Stop> stops;
  for (std::size_t i = 0; i < strand.size(); ++i) {
    if (i == 0 || !(strand[i] == strand[i - 1])) stops.push_back({i, 0});
    ++stops.back().count;
  }
  return stops;
}

// A stop whose edges are all longer than kStrayEdge allows (isFar) or kFarEdge (isFarOff).
struct Suspect {
  std::size_t strand = 0;
  Stop stop;
  bool isFar = false, isFarOff = false;
};

std::vector<Suspect> suspectsIn(const Groom& groom) {
  std::vector<Suspect> suspects;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::span<const Vec3f> strand = groom.strand(s);
    const std::vector<Stop> stops = stopsOf(strand);
    if (stops.size() < 3) continue;
    const double far = kStrayEdge * medianEdge(strand);
    const double farOff = stops.size() > 3 ? kFarEdge * upperEdge(strand) : HUGE_VAL;
    for (std::size_t k = 0; k < stops.size(); ++k) {
      const auto [first, count] = stops[k];
      const double before = k == 0 ? HUGE_VAL : edgeOf(strand[first - 1], strand[first]);
      const double after = k + 1 == stops.size() ? HUGE_VAL : edgeOf(strand[first], strand[first + count]);
      const double shorter = std::min(before, after);
      if (shorter > std::min(far, farOff)) suspects.push_back({s, stops[k], shorter > far, shorter > farOff});
    }
  }
  return suspects;
}

auto keyOf(Vec3f place) { return std::tuple(place.x, place.y, place.z); }

// sharedPlaces of those particles in whose places `counts` is true.
template <class Counts>
std::vector<bool> sharedPlacesWhere(const Groom& groom, const std::vector<bool>& isDuplicate,
                                    const Counts& counts) {
  RINGLET_ASSERT(isDuplicate.size() == groom.strandCount(), "a word for every strand");
  struct Place {
    Vec3f at;
    std::uint32_t strand, particle;
    auto key() const { return std::tuple(keyOf(at), strand); }
  };
  std::vector<Place> places;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (std::uint32_t i = groom.firstPoint[s]; !isDuplicate[s] && i < groom.firstPoint[s + 1]; ++i) {
      if (counts(groom.points[i])) places.push_back({groom.points[i], static_cast<std::uint32_t>(s), i});
    }
  }
  std::ranges::sort(places, {}, &Place::key);
  std::vector<bool> isShared(groom.points.size(), false);
  for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
    while (end < places.size() && places[end].at == places[first].at) ++end;
    if (places[first].strand == places[end - 1].strand) continue;
    for (std::size_t i = first; i < end; ++i) isShared[places[i].particle] = true;
  }
  return isShared;
}

// For each particle whether it is in a far suspect's place, and another strand has one there, too.
std::vector<bool> sharedAmong(const Groom& groom, std::span<const Suspect> suspects) {
  std::vector<Vec3f> places;
  for (const Suspect& suspect : suspects)
    if (suspect.isFar) places.push_back(groom.strand(suspect.strand)[suspect.stop.first]);
  if (places.empty()) return std::vector<bool>(groom.points.size(), false);
  std::ranges::sort(places, {}, keyOf);
  return sharedPlacesWhere(groom, duplicatesIn(groom), [&](Vec3f place) {
    return std::ranges::binary_search(places, keyOf(place), {}, keyOf);
  });
}

}  // namespace

double medianEdge(std::span<const Vec3f> strand) {
  std::vector<double> edges = edgesOf(strand);
  const double nothing = noEdgeLength(strand);
  std::erase_if(edges, [&](double edge) { return edge <= nothing; });
  return inOrder(edges, 1, 2);
}

double upperEdge(std::span<const Vec3f> strand) {
  std::vector<double> edges = edgesOf(strand);
  std::erase(edges, 0.0);
  return inOrder(edges, 3, 4);
}

std::vector<bool> sharedPlaces(const Groom& groom, const std::vector<bool>& isDuplicate) {
  return sharedPlacesWhere(groom, isDuplicate, [](Vec3f) { return true; });
}

std::vector<bool> strayPoints(const Groom& groom) {
  std::vector<bool> isStray(groom.points.size(), false);
  const std::vector<Suspect> suspects = suspectsIn(groom);
  const std::vector<bool> isShared = sharedAmong(groom, suspects);
  std::size_t left = 0;
  for (std::size_t k = 0; k < suspects.size(); ++k) {
    const auto& [strand, stop, isFar, isFarOff] = suspects[k];
    if (k == 0 || suspects[k - 1].strand != strand) left = groom.strand(strand).size();
    const std::size_t first = groom.firstPoint[strand] + stop.first;
    const bool isNoPlace = isFar && (groom.points[first] == Vec3f{0, 0, 0} || isShared[first]);
    if (left < stop.count + 2 || !(isNoPlace || isFarOff)) continue;
    left -= stop.count;
    for (std::size_t i = 0; i < stop.count; ++i) isStray[first + i] = true;
  }
  return isStray;
}

}  // namespace ringlet
