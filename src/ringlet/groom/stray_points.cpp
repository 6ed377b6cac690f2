// Implements groom/stray_points.h.
#include "ringlet/groom/stray_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
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
  RINGLET_ASSERT(isDuplicate.size() == groom.strandCount(), "a word for every strand");
  struct Place {
    Vec3f at;
    std::uint32_t strand, particle;
    auto key() const { return std::tuple(at.x, at.y, at.z, strand); }
  };
  std::vector<Place> places;
  places.reserve(groom.points.size());
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (std::uint32_t i = groom.firstPoint[s]; !isDuplicate[s] && i < groom.firstPoint[s + 1]; ++i)
      places.push_back({groom.points[i], static_cast<std::uint32_t>(s), i});
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

std::vector<bool> strayPoints(const Groom& groom, const std::vector<bool>& isShared) {
  RINGLET_ASSERT(isShared.size() == groom.points.size(), "a word for every particle");
  std::vector<bool> isStray(groom.points.size(), false);
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    const std::span<const Vec3f> strand = groom.strand(s);
    const auto mayBe = [&](std::size_t i) {
      return isShared[groom.firstPoint[s] + i] || strand[i] == Vec3f{0, 0, 0};
    };
    std::size_t left = strand.size();
    const std::vector<Stop> stops = stopsOf(strand);
    const double far = kStrayEdge * medianEdge(strand);
    const double anywhere = stops.size() > 3 ? kFarEdge * upperEdge(strand) : HUGE_VAL;
    for (std::size_t k = 0; k < stops.size() && stops.size() > 2; ++k) {
      const auto [first, count] = stops[k];
      if (left < count + 2) continue;
      const double longest = mayBe(first) ? far : anywhere;
      const bool isFarBefore = k == 0 || edgeOf(strand[first - 1], strand[first]) > longest;
      const bool isFarAfter = k + 1 == stops.size() || edgeOf(strand[first], strand[first + count]) > longest;
      if (!isFarBefore || !isFarAfter) continue;
      left -= count;
      for (std::size_t i = first; i < first + count; ++i) isStray[groom.firstPoint[s] + i] = true;
    }
  }
  return isStray;
}

}  // namespace ringlet
