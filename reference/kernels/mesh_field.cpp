// Implements reference/kernels/mesh_field.h.
#include "reference/kernels/mesh_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/equations/column_crossing.h"
#include "reference/equations/triangle_distance.h"
#include "reference/fields.h"

namespace ringlet::reference {
namespace {

template <class Real>
using Corners = std::array<Vector3<Real>, 3>;

struct Range {
  int first, last;
};

// Numbers along an axis within `band` of the triangle and in the grid.
template <class Real>
Range rangeAlong(int axis, const Corners<Real>& corners, int cells, Real band) {
  const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
  return {std::max(0, static_cast<int>(std::ceil(low - band))),
          std::min(cells, static_cast<int>(std::floor(high + band)))};
}

template <class Real>
class Builder {
 public:
  Builder(const BendingMesh& mesh, Real band) : mesh_(mesh), band_(band) {
    for (int axis = 0; axis < 3; ++axis)
      cells_[std::size_t(axis)] = static_cast<int>(mesh.counts[std::size_t(axis)]);
    field_.distances.assign(mesh.cornerCount(), band);
    field_.triangles.assign(mesh.cornerCount(), MeshField<Real>::kNone);
    turns_.assign(mesh.cornerCount(), 0);
  }

  void add(std::uint32_t triangle, const Corners<Real>& corners) {
    const Range x = rangeAlong(0, corners, cells_[0], band_), y = rangeAlong(1, corners, cells_[1], band_),
                z = rangeAlong(2, corners, cells_[2], band_);
    for (int k = z.first; k <= z.last; ++k)
      for (int j = y.first; j <= y.last; ++j) {
        for (int i = x.first; i <= x.last; ++i) offer(triangle, corners, i, j, k);
        cross(corners, j, k);
      }
  }

  MeshField<Real> field() && {
    for (int k = 0; k <= cells_[2]; ++k)
      for (int j = 0; j <= cells_[1]; ++j) {
        int inside = 0;
        for (int i = 0; i <= cells_[0]; ++i) {
          inside += turns_[at(i, j, k)];
          if (inside > 0) field_.distances[at(i, j, k)] *= -1;
        }
        deepen(j, k);
      }
    return std::move(field_);
  }

 private:
  // Beyond the band, inside: as far as the nearer end of it along x, in steps of a cell.
  void deepen(int y, int z) {
    const auto isDeep = [&](int x) {
      return field_.distances[at(x, y, z)] < 0 && field_.triangles[at(x, y, z)] == MeshField<Real>::kNone;
    };
    const auto distance = [&](int x) -> Real& { return field_.distances[at(x, y, z)]; };
    for (int x = 0; x <= cells_[0]; ++x)
      if (isDeep(x)) distance(x) = (x > 0 ? distance(x - 1) : Real(0)) - 1;
    for (int x = cells_[0] - 1; x >= 0; --x)
      if (distance(x) < -band_) distance(x) = std::max(distance(x), distance(x + 1) - 1);
  }

  std::size_t at(int x, int y, int z) const {
    return static_cast<std::size_t>(x + (cells_[0] + 1) * (y + (cells_[1] + 1) * z));
  }

  void offer(std::uint32_t triangle, const Corners<Real>& corners, int x, int y, int z) {
    const Vector3<Real> place(static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z));
    const Real distance = triangleDistance<Real>(place, corners[0], corners[1], corners[2]);
    Real& least = field_.distances[at(x, y, z)];
    std::uint32_t& nearest = field_.triangles[at(x, y, z)];
    const bool isFirst = nearest == MeshField<Real>::kNone && distance <= least;
    if (!isFirst && !(distance < least)) return;
    least = distance;
    nearest = triangle;
  }

  void cross(const Corners<Real>& corners, int y, int z) {
    const Real steps = static_cast<Real>(mesh_.stepsPerCell());
    const Real most = static_cast<Real>(BendingMesh::kMostSteps);
    std::array<LatticePoint, 3> rounded;
    std::array<Real, 3> along;
    for (std::size_t c = 0; c < 3; ++c) {
      along[c] = corners[c].x();
      for (int axis = 1; axis < 3; ++axis) {
        const Real middle = static_cast<Real>(cells_[std::size_t(axis)] / 2);
        const Real wanted = (corners[c][axis] - middle) * steps;
        rounded[c][std::size_t(axis - 1)] = std::llround(std::clamp(wanted, -most, most));
      }
    }
    const auto latticeSteps = static_cast<std::int64_t>(steps);
    const LatticePoint column{(y - cells_[1] / 2) * latticeSteps, (z - cells_[2] / 2) * latticeSteps};
    const ColumnCrossing<Real> crossing = columnCrossing<Real>(rounded, along, column);
    const Real beyond = std::max(std::floor(crossing.x) + 1, Real(0));
    if (crossing.turns != 0 && beyond <= static_cast<Real>(cells_[0]))
      turns_[at(static_cast<int>(beyond), y, z)] += crossing.turns;
  }

  const BendingMesh& mesh_;
  Real band_;
  std::array<int, 3> cells_{};
  MeshField<Real> field_;
  std::vector<int> turns_;
};

}  // namespace

template <class Real>
MeshField<Real> meshField(const BendingMesh& mesh, std::span<const Vec3d> points, Real band) {
  Builder<Real> builder(mesh, band);
  for (std::uint32_t t = 0; t < mesh.surface.triangles.size(); ++t) {
    Corners<Real> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d inCells = (points[mesh.surface.triangles[t][c]] - mesh.origin) / mesh.cell;
      corners[c] = toEigen<Real>(inCells);
    }
    builder.add(t, corners);
  }
  return std::move(builder).field();
}

template MeshField<float> meshField<float>(const BendingMesh&, std::span<const Vec3d>, float);
template MeshField<double> meshField<double>(const BendingMesh&, std::span<const Vec3d>, double);

}  // namespace ringlet::reference
