// HeadScalp: a scalp seen from the head: of each strand the pose of its own that Simulation::stepFrame takes.
//
//   at the binding  x_world = head(t0) x_groom
//   at t            x_world = scalp(t) head(t0) x_groom = head(t) root(t) x_groom
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/motion/scalp.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

/// root = head^-1 scalp headAtBinding, as rigid motions; `scalp`: the root's since the binding, in the world.
BodyPose rootPoseOn(const HeadPose& head, const HeadPose& scalp, const HeadPose& headAtBinding);

struct HeadScalpChoice {
  double start = 0;        // of the head's time: when the mesh's first key is, at which roots are bound [s]
  double farthest = 0.01;  // from the mesh, of a root [m]
  Vec3d offset{};          // of the head's world from the mesh's [m]
};

class HeadScalp {
 public:
  /// `roots` in the groom [m]: with the head where it is at choice.start they are on the mesh at its first
  /// key. Errors: as for Scalp::bind.
  static Result<HeadScalp> bind(std::shared_ptr<const MeshMotion> mesh, std::span<const Vec3d> roots,
                                const Motion& head, const HeadScalpChoice& choice = {});

  /// Each root's at t of the head's time [s]. BodyPose{} until choice.start: the mesh has no way before its
  /// first key, and comes with the head. While the head is cut (Keyframes::isCut) they are what they were
  /// before. Cost: that of Scalp::posesAt.
  std::vector<BodyPose> rootPosesAt(double t) const;

  /// Roots of the groom [m], one of each that are bound, in the world with the head there [m].
  std::vector<Vec3d> placesAt(double t, const HeadPose& head, std::span<const Vec3d> roots) const;

  /// The mesh as it was when roots were bound to it, in the groom's axes [m].
  TriangleMesh meshAtBinding() const;
  /// Other roots of the same groom, bound to the same mesh in the same way.
  Result<HeadScalp> bindOthers(std::span<const Vec3d> roots) const {
    return bind(scalp_.mesh(), roots, head_, choice_);
  }

  const Scalp& scalp() const { return scalp_; }

 private:
  HeadScalp(Scalp scalp, Motion head, HeadScalpChoice choice, double firstSeconds)
      : scalp_(std::move(scalp)), head_(std::move(head)), choice_(choice), firstSeconds_(firstSeconds) {}
  HeadPose headAt(double t) const;  // in the mesh's world

  Scalp scalp_;
  Motion head_;
  HeadScalpChoice choice_;
  double firstSeconds_;  // of the mesh
};

}  // namespace ringlet
