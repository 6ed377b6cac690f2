// Implements bodies/cloth_tree.h.
#include "ringlet/bodies/cloth_tree.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <tuple>

#include "ringlet/base/bounds.h"

namespace ringlet {
namespace {

struct Leaf {
  std::array<std::uint32_t, 3> triangle;
  Vec3d middle;
};

// Node `at` of a level: which leaves it has is layout's.
void halve(std::vector<Leaf>& leaves, std::uint64_t at, std::uint32_t level, std::uint32_t levels) {
  if (level == levels) return;
  const std::uint64_t count = leaves.size();
  const auto firstOf = [&](std::uint64_t node, std::uint32_t depth) {
    return leaves.begin() + static_cast<std::ptrdiff_t>(node * count >> depth);
  };
  Bounds box = Bounds::none();
  for (auto leaf = firstOf(at, level); leaf != firstOf(at + 1, level); ++leaf) box.add(leaf->middle);
  const Vec3d size = box.high - box.low;
  double Vec3d::*const axis = size.x >= size.y && size.x >= size.z ? &Vec3d::x
                              : size.y >= size.z                   ? &Vec3d::y
                                                                   : &Vec3d::z;
  std::nth_element(firstOf(at, level), firstOf(2 * at + 1, level + 1), firstOf(at + 1, level),
                   [&](const Leaf& a, const Leaf& b) {
                     return std::tuple(a.middle.*axis, a.triangle) < std::tuple(b.middle.*axis, b.triangle);
                   });
  halve(leaves, 2 * at, level + 1, levels);
  halve(leaves, 2 * at + 1, level + 1, levels);
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> orderedAsTree(std::vector<std::array<std::uint32_t, 3>> triangles,
                                                        std::span<const Vec3d> points) {
  std::vector<Leaf> leaves;
  for (const auto& triangle : triangles)
    leaves.push_back({triangle, (points[triangle[0]] + points[triangle[1]] + points[triangle[2]]) / 3.0});
  // Whole to the last triangle, so that the order does not depend on how a library leaves a leaf.
  halve(leaves, 0, 0, static_cast<std::uint32_t>(std::bit_width(triangles.size())));
  for (std::size_t i = 0; i < leaves.size(); ++i) triangles[i] = leaves[i].triangle;
  return triangles;
}

}  // namespace ringlet
