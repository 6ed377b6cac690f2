// Implements follow/core_weights.h: what a core makes of points that are 0 but for one is that one's weights.
#include "ringlet/follow/core_weights.h"

#include <algorithm>
#include <cmath>

#include "ringlet/measure/core.h"

namespace ringlet {
namespace {

// No particle is further than two windows from those whose core it has part in: beyond an end the core goes
// on straight, as it goes within the first two windows. Points so many windows apart are told apart.
constexpr double kWindowsApart = 3;

// Weights are of the size of 1 / particles in a window; smaller ones are rounding.
constexpr double kLeastWeight = 1e-9;

// The least number of particles that always spans so many windows.
std::size_t particlesApart(const std::vector<double>& at, double window) {
  for (std::size_t apart = 1; apart < at.size(); ++apart) {
    bool isFar = true;
    for (std::size_t i = 0; i + apart < at.size() && isFar; ++i)
      isFar = at[i + apart] - at[i] > kWindowsApart * window;
    if (isFar) return apart;
  }
  return at.size();
}

// Of the particles i with i % apart == remainder, the nearest to a place.
std::size_t nearestOf(const std::vector<double>& at, std::size_t apart, std::size_t remainder, double place) {
  std::size_t nearest = remainder;
  for (std::size_t i = remainder; i < at.size(); i += apart)
    if (std::abs(at[i] - place) < std::abs(at[nearest] - place)) nearest = i;
  return nearest;
}

// weights[i][j]: of particle j in the core at i.
std::vector<std::vector<double>> denseWeights(const std::vector<double>& at, double window) {
  const std::size_t count = at.size();
  if (window == 0)
    return std::vector<std::vector<double>>(count,
                                            std::vector<double>(count, 1.0 / static_cast<double>(count)));
  const std::size_t apart = particlesApart(at, window);
  std::vector<std::vector<double>> weights(count, std::vector<double>(count));
  for (std::size_t first = 0; first < apart; first += 3) {  // three at a time: x, y and z
    std::vector<Vec3d> points(count);
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t remainder = j % apart;
      if (remainder == first) points[j].x = 1;
      if (remainder == first + 1) points[j].y = 1;
      if (remainder == first + 2) points[j].z = 1;
    }
    const std::vector<Vec3d> core = smoothCore(points, at, window);
    for (std::size_t i = 0; i < count; ++i) {
      const double found[] = {core[i].x, core[i].y, core[i].z};
      for (std::size_t k = 0; k < 3 && first + k < std::min(apart, count); ++k)
        weights[i][nearestOf(at, apart, first + k, at[i])] = found[k];
    }
  }
  return weights;
}

}  // namespace

std::vector<CoreWeights> coreWeightsOf(const GuideRest& guide) {
  std::vector<CoreWeights> rows;
  for (const GuidePiece& piece : piecesOf(guide)) {
    for (const std::vector<double>& dense : denseWeights(arcsOf(guide, piece), piece.window)) {
      const auto counts = [](double w) { return std::abs(w) > kLeastWeight; };
      const auto begin = std::ranges::find_if(dense, counts);
      const auto end = std::find_if(dense.rbegin(), dense.rend(), counts).base();
      rows.push_back(
          {piece.begin + static_cast<std::size_t>(begin - dense.begin()), std::vector<float>(begin, end)});
    }
  }
  return rows;
}

}  // namespace ringlet
