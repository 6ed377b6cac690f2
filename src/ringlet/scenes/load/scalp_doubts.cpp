// Implements scenes/load/scalp_doubts.h.
#include "ringlet/scenes/load/scalp_doubts.h"

#include <fmt/format.h>

#include <algorithm>

#include "ringlet/bodies/body_distance.h"
#include "ringlet/bodies/triangle_tree.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/measure/placement_check.h"

namespace ringlet {
namespace {

constexpr int kLooks = 9;          // at roots in bodies, over the run
constexpr double kDeeper = 0.003;  // than at the start, of a root that is in a body's way [m]

}  // namespace

std::optional<std::string> doubtOfRootEnds(const MeshMotion& mesh, const Groom& groom, const Motion& head,
                                           const HeadScalpChoice& binding, const std::string& name) {
  const TriangleMesh ground{mesh.pointsAt(mesh.firstSeconds()), mesh.triangles()};
  if (!checkMesh(ground) || groom.strandCount() == 0) return std::nullopt;  // the binding says what is wrong
  const TriangleTree tree(ground);
  const HeadPose pose = head.poseAt(binding.start);
  const auto groundDistance = [&](Vec3d end) {
    const Vec3d place = end * groom.metresPerUnit;
    return tree.nearest(pose.position - binding.offset + rotate(pose.rotation, place)).distance;
  };
  const StrandEnds ends = strandEnds(groom);
  std::vector<EndDistances> distances;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    distances.push_back({groundDistance(ends.first[s]), groundDistance(ends.last[s])});
  return checkRootEnds(groom, distances, name);
}

std::vector<std::string> doubtsOfRigidBodies(const LoadedScene& scene) {
  std::vector<std::string> doubts;
  if (!scene.scalp || scene.bodies.empty()) return doubts;
  const std::vector<Vec3d> roots = rootPlaces(scene.groom);
  std::vector<double> atFirst(scene.bodies.size()), deepest(scene.bodies.size());
  for (int look = 0; look < kLooks; ++look) {
    const double t = scene.frameCount / scene.settings.framesPerSecond * look / (kLooks - 1);
    const HeadPose head = scene.motion.poseAt(t);
    const std::vector<Vec3d> places = scene.scalp->placesAt(t, head, roots);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].motion || scene.bodies[b].bends()) continue;
      const BodyPose pose = scene.bodies[b].poseAt(t, head);
      double depth = 0;
      for (const Vec3d& place : places) depth = std::max(depth, -distanceTo(scene.bodies[b], pose, place));
      if (look == 0) atFirst[b] = depth;
      deepest[b] = std::max(deepest[b], depth);
    }
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (deepest[b] <= atFirst[b] + kDeeper) continue;
    doubts.push_back(fmt::format(
        "the scalp takes roots {:.3g} mm into the body {}, which does not bend as the scalp does; hair is stretched "
        "over it there. Let the body bend too (deforms = true), leave it out, or make it of what moves rigidly with "
        "the roots",
        deepest[b] * 1000, scene.bodies[b].name));
  }
  return doubts;
}

}  // namespace ringlet
