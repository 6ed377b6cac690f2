// Implements picture_solids.h.
#include "ringlet/pictures/picture_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "ringlet/base/mean.h"
#include "ringlet/bodies/body_surface.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/groom/ball.h"
#include "ringlet/pictures/scene_bodies.h"
#include "ringlet/scene/body.h"

namespace ringlet {
namespace {

constexpr double kBelowRoots = 0.985;  // radius of the drawn skin relative to the roots' ball; hair is not
                                       // simulated to touch it
constexpr double kPlaneShare = 6;      // side of a drawn plane relative to the hair's size

const MovingBody& movingOf(const LoadedScene& scene, std::size_t body) {
  return *std::ranges::find(scene.moving, body, &MovingBody::body);
}

}  // namespace

PictureSolids PictureSolids::ofScene(const LoadedScene& scene, double hairSize) {
  PictureSolids solids;
  solids.scene_ = &scene;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const TriangleMesh mesh = body.shape == BodyShape::plane ? squareOf(kPlaneShare * hairSize)
                              : body.bends()
                                  ? TriangleMesh{body.mesh->points, movingOf(scene, i).mesh->triangles()}
                                  : surfaceOf(body);
    if (mesh.triangles.empty()) continue;
    solids.meshes_.push_back(solidMeshOf(mesh));
    solids.meshes_.back().isCloth = body.isCloth();
    solids.bodies_.push_back(i);
  }
  return solids;
}

PictureSolids PictureSolids::ofRoots(std::span<const Vec3d> roots, Vec3d up) {
  PictureSolids solids;
  const auto head = headUnder(roots);
  if (!head) return solids;
  solids.meshes_.push_back(solidMeshOf(makeHeadMesh({.scalpRadius = kBelowRoots * head->radius})));
  solids.fromRoots_ = head->middle - meanOf(roots);
  if (up.z > 0.5) solids.upright_ = fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0});
  return solids;
}

void PictureSolids::addGround(double height, double radius, Vec3d middle, Vec3d up) {
  meshes_.push_back(groundOf(radius));
  const Quatd upright = up.z > 0.5 ? fromRotationVector(Vec3d{std::numbers::pi / 2, 0, 0}) : Quatd{};
  ground_ = {middle + up * (height - dot(middle, up)), upright};
}

double PictureSolids::lowest(std::span<const SolidPlace> places, Vec3d up) const {
  double low = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < std::min(places.size(), meshes_.size()); ++s) {
    if (scene_ && scene_->bodies[bodies_[s]].shape == BodyShape::plane) continue;
    for (const Vec3d& point : meshes_[s].points)
      low = std::min(low, dot(places[s].position + rotate(places[s].rotation, point), up));
  }
  return low;
}

std::vector<SolidPlace> PictureSolids::placesAt(double frame, std::span<const Vec3d> roots,
                                                Quatd head) const {
  std::vector<SolidPlace> places = bodiesAt(frame, roots, head);
  if (ground_) places.push_back(*ground_);
  return places;
}

std::vector<SolidPlace> PictureSolids::bodiesAt(double frame, std::span<const Vec3d> roots,
                                                Quatd head) const {
  std::vector<SolidPlace> places;
  if (!scene_) {
    if (!meshes_.empty()) places.push_back({meanOf(roots) + rotate(head, fromRoots_), head * upright_});
    return places;
  }
  const std::vector<BodyPose> poses = bodiesAtFrame(*scene_, frame);
  for (const std::size_t body : bodies_) places.push_back({poses[body].position, poses[body].rotation});
  const auto points = SceneFrames(*scene_).bodyPointsAt(frame);
  for (std::size_t m = 0; m < points.size(); ++m) {
    const auto s =
        static_cast<std::size_t>(std::ranges::find(bodies_, scene_->moving[m].body) - bodies_.begin());
    places[s].bent = std::make_shared<const SolidMesh>(bent(meshes_[s], points[m]));
  }
  return places;
}

}  // namespace ringlet
