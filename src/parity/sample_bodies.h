// Bodies that tests share.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/bodies/make_bending_mesh.h"
#include "ringlet/scene/body.h"

namespace ringlet::parity {

/// A sphere about a place of its own axes as a distance grid, 1.5 radii to either side.
inline Body gridBall(double radius, double cell, Vec3d about = {}) {
  const auto count = static_cast<std::uint32_t>(std::lround(3 * radius / cell));
  DistanceGrid grid{
      .origin = about + Vec3d{-1.5, -1.5, -1.5} * radius, .cell = cell, .counts = {count, count, count}};
  for (std::uint32_t z = 0; z <= count; ++z) {
    for (std::uint32_t y = 0; y <= count; ++y) {
      for (std::uint32_t x = 0; x <= count; ++x) {
        const Vec3d place = grid.origin + Vec3d{double(x), double(y), double(z)} * cell;
        grid.distances.push_back(static_cast<float>(length(place - about) - radius));
      }
    }
  }
  return {.name = "grid",
          .shape = BodyShape::grid,
          .grid = std::make_shared<const DistanceGrid>(std::move(grid))};
}

/// A sphere that bends (bentPoints): of some 500 triangles about the place, with a hole where its pole was.
inline Body bendingBall(double radius, double cell, Vec3d about = {}) {
  constexpr std::uint32_t kAround = 24, kRings = 12;
  Body body = gridBall(radius, cell, about);
  body.name = "bending";
  BendingMesh mesh;
  // Not where corners are as near to one triangle as to the next: rounding would choose.
  mesh.origin = body.grid->origin + Vec3d{0.37, 0.21, 0.43} * cell;
  mesh.cell = cell;
  mesh.counts = body.grid->counts;
  mesh.reach = 2 * radius;
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double down = std::numbers::pi * ring / (kRings + 1), turn = 2 * std::numbers::pi * i / kAround;
      mesh.points.push_back(
          about +
          Vec3d{std::sin(down) * std::sin(turn), std::cos(down), std::sin(down) * std::cos(turn)} * radius);
      const std::uint32_t next = (i + 1) % kAround, here = (ring - 1) * kAround;
      if (ring < kRings) {
        mesh.surface.triangles.push_back({here + i, here + kAround + i, here + kAround + next});
        mesh.surface.triangles.push_back({here + i, here + kAround + next, here + next});
      }
    }
  }
  // Each cap passes its rim the other way round than the triangles beside it.
  const auto count = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t i = 0; i < count; ++i) mesh.surface.sources.push_back(i);
  mesh.surface.rims.resize(2);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    mesh.surface.rims[0].push_back(i);
    mesh.surface.rims[1].push_back(count - 1 - i);
  }
  for (std::uint32_t rim = 0; rim < 2; ++rim)
    for (std::uint32_t i = 0; i < kAround; ++i)
      mesh.surface.triangles.push_back(
          {mesh.surface.rims[rim][i], mesh.surface.rims[rim][(i + 1) % kAround], count + rim});
  body.mesh = std::make_shared<const BendingMesh>(std::move(mesh));
  return body;
}

/// Cloth: a sheet of 2 cells^2 triangles, `size` across, about the place, level but for its waves.
inline Body sheet(double size, Vec3d about = {}, std::uint32_t cells = 12) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double x = (double(i) / cells - 0.5) * size, z = (double(j) / cells - 0.5) * size;
      mesh.points.push_back(about +
                            Vec3d{x, 0.05 * size * std::sin(9 * x / size) * std::cos(7 * z / size), z});
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
  Body body{.name = "cloth", .shape = BodyShape::grid};
  std::vector<std::string> warnings;
  const BendingRoom room = bendingRoomOf(mesh.points, {}, 8, true);
  if (!makeBendingMesh(std::move(mesh), room, body, warnings)) return {};
  return body;
}

/// Of a body that bends, `seconds` after its start, in the frame of what carries it: each point has moved on
/// at a velocity of its own.
inline std::vector<Vec3d> bentPoints(const BendingMesh& mesh, double seconds) {
  std::vector<Vec3d> points = mesh.points;
  for (Vec3d& p : points)
    p += Vec3d{std::sin(25 * p.y), 0.5 * std::cos(20 * p.z), std::sin(30 * p.x)} * (0.6 * seconds);
  return points;
}

/// The points of all that bend, in the world: at each of `times` [s], with the body there at its pose of
/// `poses`, [time][body].
inline std::vector<std::vector<Vec3d>> bentInWorld(std::span<const Body> bodies,
                                                   std::span<const BodyPose> poses,
                                                   std::span<const double> times) {
  std::vector<std::vector<Vec3d>> all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].bends()) continue;
    std::vector<Vec3d>& points = all.emplace_back();
    for (std::size_t k = 0; k < times.size(); ++k) {
      const BodyPose& pose = poses[k * bodies.size() + b];
      for (const Vec3d p : bentPoints(*bodies[b].mesh, times[k]))
        points.push_back(pose.position + rotate(pose.rotation, p));
    }
  }
  return all;
}

/// One of each shape, some 20 cm across.
inline std::vector<Body> sampleBodies() {
  return {{.name = "sphere", .shape = BodyShape::sphere, .radius = 0.1},
          {.name = "capsule", .shape = BodyShape::capsule, .radius = 0.05, .length = 0.2},
          {.name = "plane", .shape = BodyShape::plane, .thickness = 0.01},
          {.name = "box", .shape = BodyShape::box, .halfExtents = {0.08, 0.1, 0.06}, .thickness = 0.01},
          gridBall(0.1, 0.005)};
}

}  // namespace ringlet::parity
