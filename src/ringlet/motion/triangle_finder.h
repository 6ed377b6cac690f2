// TriangleFinder: the triangle nearest to a point, among many.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// A place on a triangle: corners times weights, which are 0 to 1 and sum to 1.
struct TrianglePlace {
  std::size_t triangle = 0;
  std::array<double, 3> weights{};
  double distance = 0;  // from what was asked for
};

/// The place of a triangle nearest to p, exactly. Weights of a corner or an edge have zeros.
std::array<double, 3> nearestWeights(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

class TriangleFinder {
 public:
  /// Triangles without an area, or not finite, are left out. Cost: n log n.
  TriangleFinder(std::span<const Vec3d> points, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// Nothing where there are no triangles, or p is not finite. The same for the same triangles, always.
  std::optional<TrianglePlace> nearestTo(Vec3d p) const;

 private:
  struct Part {  // a box of the tree
    Vec3d low, high;
    std::size_t begin = 0, end = 0;  // triangles, as ordered
    std::size_t right = 0;           // the second half; the first is next to this; 0: no halves
  };
  struct Triangle {
    Vec3d a, b, c;
    std::size_t index;
  };

  void build(std::size_t begin, std::size_t end);

  std::vector<Triangle> triangles_;
  std::vector<Part> parts_;
};

}  // namespace ringlet
