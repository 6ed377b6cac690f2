// Implements bodies/hole_film.h.
#include "ringlet/bodies/hole_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace ringlet {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// The distance at a corner whose neighbours along the three axes are at a, b and c, of a front one cell
// apart: |grad u| = 1 in upwind differences.
double advanced(double a, double b, double c, double cell) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  double u = a + cell;
  if (u <= b) return u;
  u = (a + b + std::sqrt(2 * cell * cell - (a - b) * (a - b))) / 2;
  if (u <= c) return u;
  const double sum = a + b + c;
  return (sum + std::sqrt(std::max(0.0, sum * sum - 3 * (a * a + b * b + c * c - cell * cell)))) / 3;
}

// The corners of a grid, and the steps in memory from one to the next along each axis.
struct Corners {
  std::array<std::ptrdiff_t, 3> counts, strides;

  explicit Corners(const DistanceGrid& grid)
      : counts{grid.counts[0] + std::ptrdiff_t{1}, grid.counts[1] + std::ptrdiff_t{1},
               grid.counts[2] + std::ptrdiff_t{1}},
        strides{1, counts[0], counts[0] * counts[1]} {}
  std::size_t size() const { return static_cast<std::size_t>(counts[0] * counts[1] * counts[2]); }
};

// How far each corner beside the film is from it; kNowhere elsewhere. True if there is any.
bool findFilm(const Corners& corners, double cell, const std::vector<float>& windings,
              const std::vector<float>& magnitudes, std::vector<double>& film) {
  bool isAny = false;
  for (std::ptrdiff_t z = 0, i = 0; z < corners.counts[2]; ++z) {
    for (std::ptrdiff_t y = 0; y < corners.counts[1]; ++y) {
      for (std::ptrdiff_t x = 0; x < corners.counts[0]; ++x, ++i) {
        const std::array<std::ptrdiff_t, 3> at{x, y, z};
        const double own = windings[static_cast<std::size_t>(i)] - 0.5;
        double inverseSquares = 0;  // of where the film cuts the axes: of a plane their sum is 1 / distance^2
        for (std::size_t axis = 0; axis < 3; ++axis) {
          double nearest = kNowhere;
          for (const std::ptrdiff_t step : {-1, 1}) {
            if (at[axis] + step < 0 || at[axis] + step >= corners.counts[axis]) continue;
            const std::ptrdiff_t j = i + step * corners.strides[axis];
            const double other = windings[static_cast<std::size_t>(j)] - 0.5;
            if ((own > 0) == (other > 0)) continue;
            // A triangle between the two would be within one cell of both together; in a hole no wider than a
            // cell they are at most sqrt(2) away, which is near enough without a film.
            const double reach = double{magnitudes[static_cast<std::size_t>(i)]} +
                                 double{magnitudes[static_cast<std::size_t>(j)]};
            if (reach > cell * std::numbers::sqrt2) nearest = std::min(nearest, cell * own / (own - other));
          }
          if (nearest < kNowhere) inverseSquares += 1 / std::max(nearest * nearest, 1e-12 * cell * cell);
        }
        if (inverseSquares == 0) continue;
        film[static_cast<std::size_t>(i)] = 1 / std::sqrt(inverseSquares);
        isAny = true;
      }
    }
  }
  return isAny;
}

// One pass over all corners in one of eight directions; the largest change.
double sweep(const Corners& corners, double cell, unsigned direction, std::vector<double>& film) {
  double change = 0;
  auto neighbour = [&](std::ptrdiff_t i, std::ptrdiff_t at, std::size_t axis) {
    const std::ptrdiff_t stride = corners.strides[axis];
    const double before = at > 0 ? film[static_cast<std::size_t>(i - stride)] : kNowhere;
    const double after =
        at + 1 < corners.counts[axis] ? film[static_cast<std::size_t>(i + stride)] : kNowhere;
    return std::min(before, after);
  };
  auto place = [&](std::ptrdiff_t k, std::size_t axis) {
    return direction >> axis & 1 ? corners.counts[axis] - 1 - k : k;
  };
  for (std::ptrdiff_t kz = 0; kz < corners.counts[2]; ++kz) {
    const std::ptrdiff_t z = place(kz, 2);
    for (std::ptrdiff_t ky = 0; ky < corners.counts[1]; ++ky) {
      const std::ptrdiff_t y = place(ky, 1);
      for (std::ptrdiff_t kx = 0; kx < corners.counts[0]; ++kx) {
        const std::ptrdiff_t x = place(kx, 0), i = x + y * corners.strides[1] + z * corners.strides[2];
        const double a = neighbour(i, x, 0), b = neighbour(i, y, 1), c = neighbour(i, z, 2);
        if (std::min({a, b, c}) == kNowhere) continue;
        double& own = film[static_cast<std::size_t>(i)];
        const double next = advanced(a, b, c, cell);
        if (next >= own) continue;
        change = std::max(change, own == kNowhere ? cell : own - next);
        own = next;
      }
    }
  }
  return change;
}

}  // namespace

void closeHoles(const DistanceGrid& grid, const std::vector<float>& windings,
                std::vector<float>& magnitudes) {
  const Corners corners(grid);
  std::vector<double> film(corners.size(), kNowhere);
  if (!findFilm(corners, grid.cell, windings, magnitudes, film)) return;

  // Once in all eight directions is enough but for ways that bend; three times for those.
  for (int round = 0; round < 3; ++round) {
    double change = 0;
    for (unsigned direction = 0; direction < 8; ++direction)
      change = std::max(change, sweep(corners, grid.cell, direction, film));
    if (change < 1e-6 * grid.cell) break;
  }
  for (std::size_t i = 0; i < film.size(); ++i)
    magnitudes[i] = static_cast<float>(std::min(double{magnitudes[i]}, film[i]));
}

}  // namespace ringlet
