// Implements motion/triangle_finder.h.
#include "ringlet/motion/triangle_finder.h"

#include <algorithm>
#include <cmath>

namespace ringlet {
namespace {

constexpr std::size_t kFewest = 4;  // triangles that are looked at one by one

Vec3d least(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d most(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

double squaredDistance(Vec3d p, Vec3d low, Vec3d high) {
  const Vec3d out = most(most(low - p, p - high), {});
  return dot(out, out);
}

bool isFinite(Vec3d v) { return std::isfinite(v.x + v.y + v.z); }

}  // namespace

// Ericson, "Real-Time Collision Detection", 2005, 5.1.5: which corner, edge or face p is before.
std::array<double, 3> nearestWeights(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return {1 - s, s, 0};
  }
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return {1 - s, 0, s};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - s, s};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

TriangleFinder::TriangleFinder(std::span<const Vec3d> points,
                           std::span<const std::array<std::uint32_t, 3>> triangles) {
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto [i, j, l] = triangles[k];
    const Triangle triangle{points[i], points[j], points[l], k};
    const double area = length(cross(triangle.b - triangle.a, triangle.c - triangle.a));
    if (area > 0 && std::isfinite(area) && isFinite(triangle.a)) triangles_.push_back(triangle);
  }
  if (!triangles_.empty()) build(0, triangles_.size());
}

// Halves by number along the longest side of the boxes' centres, so that depth is a logarithm.
void TriangleFinder::build(std::size_t begin, std::size_t end) {
  const std::size_t own = parts_.size();
  Part part{triangles_[begin].a, triangles_[begin].a, begin, end, 0};
  for (std::size_t k = begin; k < end; ++k) {
    for (Vec3d corner : {triangles_[k].a, triangles_[k].b, triangles_[k].c})
      part.low = least(part.low, corner), part.high = most(part.high, corner);
  }
  parts_.push_back(part);
  if (end - begin <= kFewest) return;
  const Vec3d size = part.high - part.low;
  double Vec3d::*const side = size.x >= size.y && size.x >= size.z ? &Vec3d::x
                              : size.y >= size.z                   ? &Vec3d::y
                                                                   : &Vec3d::z;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return triangles_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](const Triangle& s, const Triangle& t) {
    const double first = s.a.*side + s.b.*side + s.c.*side, second = t.a.*side + t.b.*side + t.c.*side;
    return first != second ? first < second : s.index < t.index;
  });
  build(begin, middle);
  parts_[own].right = parts_.size();
  build(middle, end);
}

std::optional<TrianglePlace> TriangleFinder::nearestTo(Vec3d p) const {
  if (parts_.empty() || !isFinite(p)) return std::nullopt;
  TrianglePlace best;
  double least = INFINITY;              // squared
  std::array<std::size_t, 130> open{};  // parts to look into; a tree of 2^64 is 64 deep
  std::size_t count = 1;
  while (count > 0) {
    const std::size_t own = open[--count];
    const Part& part = parts_[own];
    if (squaredDistance(p, part.low, part.high) > least) continue;
    if (part.right != 0) {
      std::size_t near = own + 1, far = part.right;
      if (squaredDistance(p, parts_[far].low, parts_[far].high) <
          squaredDistance(p, parts_[near].low, parts_[near].high))
        std::swap(near, far);
      open[count++] = far;
      open[count++] = near;
      continue;
    }
    for (std::size_t k = part.begin; k < part.end; ++k) {
      const Triangle& t = triangles_[k];
      const std::array<double, 3> weights = nearestWeights(p, t.a, t.b, t.c);
      const Vec3d away = p - (t.a * weights[0] + t.b * weights[1] + t.c * weights[2]);
      const double squared = dot(away, away);
      if (squared < least || (squared == least && t.index < best.triangle))
        least = squared, best = {t.index, weights, 0};
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  best.distance = std::sqrt(least);
  return best;
}

}  // namespace ringlet
