// TriangleTree: boxes within boxes about the triangles of a mesh, to find the nearest one and whether a place
// is inside, in time that hardly grows with the mesh.
//
// Inside is what the generalised winding number says (Jacobson, Kavan and Sorkine-Hornung, "Robust
// inside-outside segmentation using generalized winding numbers", 2013): the solid angle that the surface
// covers around a place, over 4 pi. It is 1 inside and 0 outside of a watertight mesh, adds up where parts
// overlap, and fades across holes. From afar a box of triangles counts as one dipole (Barill, Dickson,
// Schmidt, Levin and Jacobson, "Fast winding numbers for soups and clouds", 2018).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/bounds.h"
#include "ringlet/base/vec3.h"
#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet {

class TriangleTree {
 public:
  /// Copies the data it needs of a mesh that has passed checkMesh. Cost: n log n.
  explicit TriangleTree(const TriangleMesh& mesh);

  struct Nearest {
    double distance = 0;         // [m]
    std::uint32_t entry = 0;     // of the tree's own order: a guess for a place nearby
    std::uint32_t triangle = 0;  // of the mesh
  };
  /// Exact, whatever the guess, which any entry below the number of triangles may be.
  Nearest nearest(Vec3d place, std::uint32_t guess = 0) const;

  /// Of a watertight mesh it rounds to the exact one; elsewhere the dipoles err by 0.03 at most. Undecided on
  /// the surface itself.
  double windingNumber(Vec3d place) const;

 private:
  using Corners = std::array<Vec3d, 3>;
  struct Branch {
    Bounds bounds{};
    Vec3d middle{}, areas{};             // mean place by area; sum of areas times normals [m^2]
    double reach = 0;                    // no corner is further from the middle [m]
    std::uint32_t first = 0, count = 0;  // of entries_
    std::uint32_t second =
        0;  // the other half's branch, 0 at the end; the one half's comes right behind this
  };

  std::uint32_t grow(std::uint32_t first, std::uint32_t count);

  struct Entry {
    Corners corners;
    std::uint32_t triangle;
  };
  std::vector<Entry> entries_;
  std::vector<Branch> branches_;
};

}  // namespace ringlet
