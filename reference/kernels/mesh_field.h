// The distance grid of a mesh that bends, for points at one time. Mirrors shaders/kernels/mesh_splat.comp and
// mesh_columns.comp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/bending_mesh.h"

namespace ringlet::reference {

inline constexpr double kMeshBand = 2;  // cells, of layout::kMeshBand

/// Of each corner of the grid, x fastest.
template <class Real>
struct MeshField {
  static constexpr std::uint32_t kNone = ~0u;

  std::vector<Real>
      distances;  // [cells], negative inside; outside at most the band, inside beyond it along x
  std::vector<std::uint32_t> triangles;  // the nearest, of equally near ones the first; kNone beyond the band
};

/// points: of the mesh, in the carrier's frame [m]; band: corners know the distance of triangles closer than
/// this [cells]. Cost: corners times triangles at worst.
template <class Real>
MeshField<Real> meshField(const BendingMesh& mesh, std::span<const Vec3d> points, Real band);

}  // namespace ringlet::reference
