// Meshes whose distances are known, and slow ways to find distances and insides, for the tests of this
// folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "ringlet/bodies/distance_to_triangle.h"
#include "ringlet/bodies/icosphere.h"
#include "ringlet/bodies/triangle_mesh.h"

namespace ringlet::test {

inline TriangleMesh sphereMesh(double radius, int frequency, Vec3d middle = {}) {
  TriangleMesh mesh = makeIcosphere(frequency);
  for (Vec3d& p : mesh.points) p = middle + p * radius;
  return mesh;
}
inline double sphereDistance(Vec3d p, double radius) { return length(p) - radius; }

inline TriangleMesh boxMesh(Vec3d half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}
inline double boxDistance(Vec3d p, Vec3d half) {
  const Vec3d q{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  const Vec3d out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// About Y; ring from its middle to the tube's.
inline TriangleMesh torusMesh(double ring, double tube, std::uint32_t ringCount, std::uint32_t tubeCount) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < ringCount; ++i) {
    for (std::uint32_t j = 0; j < tubeCount; ++j) {
      const double u = 2 * std::numbers::pi * i / ringCount, v = 2 * std::numbers::pi * j / tubeCount;
      const double out = ring + tube * std::cos(v);
      mesh.points.push_back({out * std::sin(u), tube * std::sin(v), out * std::cos(u)});
      const std::uint32_t i1 = (i + 1) % ringCount, j1 = (j + 1) % tubeCount;
      const std::uint32_t a = i * tubeCount + j, b = i1 * tubeCount + j, c = i1 * tubeCount + j1,
                          d = i * tubeCount + j1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}
inline double torusDistance(Vec3d p, double ring, double tube) {
  return std::hypot(std::hypot(p.x, p.z) - ring, p.y) - tube;
}

inline void turnInsideOut(TriangleMesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

// Both meshes as one.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

inline double bruteDistance(const TriangleMesh& mesh, Vec3d p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Vec3d q = closestOnTriangle(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    least = std::min(least, length(p - q));
  }
  return least;
}

// Sums of spherical triangles' angles instead of the solid angle's arc tangent: area = A + B + C - pi.
inline double bruteWinding(const TriangleMesh& mesh, Vec3d p) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = normalizedOr(mesh.points[t[0]] - p, Vec3d{}),
                b = normalizedOr(mesh.points[t[1]] - p, Vec3d{}),
                c = normalizedOr(mesh.points[t[2]] - p, Vec3d{});
    auto angleAt = [](Vec3d u, Vec3d v, Vec3d w) {
      const Vec3d uv = cross(u, v), uw = cross(u, w);
      return std::atan2(length(cross(uv, uw)), dot(uv, uw));
    };
    const double area = angleAt(a, b, c) + angleAt(b, c, a) + angleAt(c, a, b) - std::numbers::pi;
    sum += dot(a, cross(b, c)) < 0 ? -area : area;
  }
  return sum / (4 * std::numbers::pi);
}

// Unit normals of points, of triangles weighted by their angle there.
inline std::vector<Vec3d> pointNormals(const TriangleMesh& mesh) {
  std::vector<Vec3d> normals(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d p = mesh.points[t[i]], u = mesh.points[t[(i + 1) % 3]] - p,
                  v = mesh.points[t[(i + 2) % 3]] - p;
      const Vec3d area = cross(u, v);
      normals[t[i]] += normalizedOr(area, Vec3d{}) * std::atan2(length(area), dot(u, v));
    }
  }
  for (Vec3d& n : normals) n = normalizedOr(n, Vec3d{});
  return normals;
}

// The points of edges that one triangle has and no other, of a mesh whose points are shared.
inline std::vector<Vec3d> openRims(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  }
  std::vector<Vec3d> rims;
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) rims.push_back(mesh.points[a]);
  }
  return rims;
}

// Evenly within a box.
class Places {
 public:
  Places(std::uint32_t seed, Vec3d low, Vec3d high) : random_(seed), low_(low), high_(high) {}
  Vec3d next() {
    const double x = share_(random_), y = share_(random_), z = share_(random_);
    const Vec3d size = high_ - low_;
    return low_ + Vec3d{size.x * x, size.y * y, size.z * z};
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> share_{0, 1};
  Vec3d low_, high_;
};

}  // namespace ringlet::test
