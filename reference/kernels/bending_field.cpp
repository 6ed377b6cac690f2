// Implements reference/kernels/bending_field.h.
#include "reference/kernels/bending_field.h"

#include <utility>

namespace ringlet::reference {

template <class Real>
BendingField<Real> bendingField(const BendingMesh& mesh, std::span<const Vec3d> points,
                                std::span<const Vec3d> next, Real band) {
  if (mesh.isCloth) {
    BendingField<Real> field;
    field.cloth = &mesh;
    for (const Vec3d& p : points) field.points.push_back(toEigen<Real>(p));
    for (const Vec3d& p : next) field.next.push_back(toEigen<Real>(p));
    return field;
  }
  MeshField<Real> made = meshField<Real>(mesh, points, band);
  BendingField<Real> field;
  field.grid = {mesh.origin, mesh.cell, mesh.counts, {}};
  for (const Real distance : made.distances)
    field.grid.distances.push_back(static_cast<float>(distance) * static_cast<float>(mesh.cell));
  field.triangles = std::move(made.triangles);
  for (const auto& [a, b, c] : mesh.surface.triangles) {
    const Vec3d way = (next[a] - points[a] + (next[b] - points[b]) + (next[c] - points[c])) / 3.0;
    field.ways.push_back(toEigen<Real>(way));
  }
  return field;
}

template BendingField<float> bendingField<float>(const BendingMesh&, std::span<const Vec3d>,
                                                 std::span<const Vec3d>, float);
template BendingField<double> bendingField<double>(const BendingMesh&, std::span<const Vec3d>,
                                                   std::span<const Vec3d>, double);

}  // namespace ringlet::reference
