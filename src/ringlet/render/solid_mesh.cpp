// Implements render/solid_mesh.h.
#include "ringlet/render/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ringlet {
namespace {

constexpr double kMostTriangles = 200000;

using Triangle = std::array<std::uint32_t, 3>;

Vec3d doubledArea(const SolidMesh& mesh, const Triangle& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

// The longest edge that keeps their number: equilateral triangles of that side cover the surface.
double longestEdge(const SolidMesh& mesh, double asked) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += length(doubledArea(mesh, t)) / 2;
  // Splitting halves edges, so that most come out shorter than the longest, to a third of its area.
  return std::max(asked, std::sqrt(6.9 * area / kMostTriangles));
}

// Splits every edge that is too long in its middle, the same for both triangles there; whether there was one.
bool splitOnce(SolidMesh& mesh, double longest, std::vector<std::array<std::uint32_t, 2>>& splits) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto isLong = [&](std::uint32_t a, std::uint32_t b) {
    return length(mesh.points[a] - mesh.points[b]) > longest;
  };
  const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, isNew] =
        middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
    if (isNew) {
      mesh.points.push_back((mesh.points[a] + mesh.points[b]) / 2.0);
      mesh.normals.push_back(normalizedOr(mesh.normals[a] + mesh.normals[b], mesh.normals[a]));
      splits.push_back({a, b});
    }
    return at->second;
  };
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    std::vector<std::uint32_t> rim;  // corners, and middles between them
    std::size_t hub = 0;             // a middle: triangles about it fill the rim
    for (int k = 0; k < 3; ++k) {
      rim.push_back(t[k]);
      const std::uint32_t next = t[(k + 1) % 3];
      if (!isLong(t[k], next)) continue;
      hub = rim.size();
      rim.push_back(middleOf(t[k], next));
    }
    if (rim.size() == 6) {  // all three: four triangles of the same shape
      triangles.push_back({rim[1], rim[3], rim[5]});
      for (std::size_t k = 0; k < 6; k += 2) triangles.push_back({rim[(k + 5) % 6], rim[k], rim[k + 1]});
      continue;
    }
    for (std::size_t k = 1; k + 1 < rim.size(); ++k)
      triangles.push_back({rim[hub], rim[(hub + k) % rim.size()], rim[(hub + k + 1) % rim.size()]});
  }
  mesh.triangles = std::move(triangles);
  return !middles.empty();
}

// Of areas of triangles around each point.
void setNormals(SolidMesh& mesh) {
  mesh.normals.assign(mesh.points.size(), {});
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t corner : t) mesh.normals[corner] += doubledArea(mesh, t);
  for (Vec3d& normal : mesh.normals) normal = normalizedOr(normal, Vec3d{0, 1, 0});
}

}  // namespace

SolidMesh solidMeshOf(const TriangleMesh& source, double longest) {
  SolidMesh mesh;
  mesh.points = source.points;
  mesh.triangles = source.triangles;
  setNormals(mesh);

  SolidMesh fine = mesh;
  const double limit = longestEdge(mesh, longest);
  while (splitOnce(fine, limit, mesh.splits)) {
  }
  for (std::size_t i = 0; i < fine.points.size(); ++i)
    mesh.patches.push_back({fine.points[i], fine.normals[i], 0});
  for (const Triangle& t : fine.triangles)
    for (std::uint32_t corner : t) mesh.patches[corner].area += length(doubledArea(fine, t)) / 6;
  return mesh;
}

SolidMesh bent(const SolidMesh& mesh, std::vector<Vec3d> points) {
  SolidMesh made = mesh;
  made.points = std::move(points);
  setNormals(made);
  const std::size_t count = made.points.size();
  for (std::size_t i = 0; i < made.patches.size(); ++i) {
    SolidMesh::Patch& patch = made.patches[i];
    if (i < count) {
      patch.place = made.points[i];
      patch.normal = made.normals[i];
      continue;
    }
    const auto& [a, b] = made.splits[i - count];
    patch.place = (made.patches[a].place + made.patches[b].place) / 2.0;
    patch.normal = normalizedOr(made.patches[a].normal + made.patches[b].normal, made.patches[a].normal);
  }
  return made;
}

SolidMesh groundOf(double radius) {
  constexpr std::uint32_t kSpokes = 64, kRings = 56;
  constexpr double kStep = 0.9;    // of a ring's radius, over that of the next: about square cells
  constexpr double kWhole = 0.15;  // of the radius, where it begins to fade
  SolidMesh mesh;
  const auto add = [&](double r, double angle) {
    mesh.points.push_back({r * std::cos(angle), 0, -r * std::sin(angle)});
    mesh.normals.push_back({0, 1, 0});
    const double s = std::clamp((r / radius - kWhole) / (1 - kWhole), 0.0, 1.0);
    mesh.clearness.push_back(s * s * (3 - 2 * s));
  };
  add(0, 0);
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t k = 0; k < kSpokes; ++k)
      add(radius * std::pow(kStep, kRings - 1 - ring), 2 * std::numbers::pi * k / kSpokes);
  const auto at = [](std::uint32_t ring, std::uint32_t spoke) {
    return 1 + ring * kSpokes + spoke % kSpokes;
  };
  for (std::uint32_t k = 0; k < kSpokes; ++k) {
    mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      mesh.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
      mesh.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
    }
  }
  return mesh;
}

TriangleMesh squareOf(double side) {
  const double h = side / 2;
  return {{{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace ringlet
