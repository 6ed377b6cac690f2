// A mesh that hair of a generated head grows on and stays outside of: a head, or its scalp alone.
#pragma once

#include <memory>

#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/groom/scalp_surface.h"

namespace ringlet {

/// The mesh, in metres, about the origin. Roots are on its triangles; heights are those of a distance grid
/// (mesh_grid.h), exact to a small share of a 48th of the mesh, up to a third of it away. Errors: those of
/// makeDistanceGrid.
Result<std::shared_ptr<const ScalpSurface>> makeMeshScalp(const TriangleMesh& mesh);

}  // namespace ringlet
