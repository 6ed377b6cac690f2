// MovingBody: a body that bends as a mesh does.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

struct MovingBody {
  std::size_t body = 0;                      // of the scene's
  std::shared_ptr<const MeshMotion> mesh{};  // of which it has the points
  double start = 0;                          // of the run's time: when the mesh's first key is [s]
  Vec3d offset{};                            // of the run's world from the mesh's [m]
  Body early{};                              // with which the mesh comes before `start`

  /// The mesh's points in the run's world at time t [m]; `head`: that of the run. Cost: that of
  /// MeshMotion::pointsAt.
  std::vector<Vec3d> pointsAt(double t, const Motion& head) const;
  /// The same seen from what carries `of`, this body, at that time.
  std::vector<Vec3d> pointsSeenAt(double t, const Body& of, const Motion& head) const;
};

}  // namespace ringlet
