// ShotStart: how hair begins a shot: as it was at a frame of another run, seen from the head. [start] of a
// scene.
#pragma once

#include <cstddef>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Of each particle, in groom order, in the groom's axes as the head carries them, relative to the first
/// particle of its strand. No part of it depends on where the other run's head was, or on how it moved.
struct ShotStart {
  std::vector<Vec3f> offsets{};     // [m]
  std::vector<Vec3f> velocities{};  // of the offsets [m/s]

  /// Where particles are with their roots where `groom` has them, in the head's frame [m].
  std::vector<Vec3f> placesIn(const Groom& groom) const;
};

/// LoadedScene::start of a scene whose groom, guides and settings are loaded, where it is asked for. The
/// other run's head is where its roots say, the particles that the head carries: the rigid motion that best
/// brings the groom's there. Velocities are those of the parabola through the frame and the two before it. A
/// run of all hairs of a groom has its guides. Adds warnings: a first frame, which has no velocities; strands
/// of another length than the groom's. Errors: keys that do not go together; no such animation or frame;
/// other strands than the groom's. Cost: the reading of three frames, of text of all up to them.
Status takeShotStart(const SceneFile& scene, LoadedScene& loaded);

}  // namespace ringlet
