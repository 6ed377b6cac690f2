// ShotStart: how hair begins a shot: as it was at a frame of another run, seen from the head. [start] of a
// scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Of each particle, in groom order, in the groom's axes as the head carries them, relative to the first
/// particle of its strand. No part of it depends on where the other run's head was, or on how it moved.
struct ShotStart {
  std::vector<Vec3f> offsets{};     // [m]
  std::vector<Vec3f> velocities{};  // of the offsets [m/s]

  /// Where particles are with their roots where `groom` has them, in the head's frame [m].
  std::vector<Vec3f> placesIn(const Groom& groom) const;
};

/// The other run's head is where its roots, the first `rootCount` particles of strands, say: the rigid motion
/// that best brings the groom's there. Velocities are those of the parabola through the frame and the two
/// before it. Adds warnings: a first frame, which has no velocities; strands of another length than the
/// groom's. Errors: no such animation or frame; other strands than the groom's. Cost: the reading of two
/// frames, of text of all up to them.
Result<ShotStart> loadShotStart(const SceneFile& scene, const Groom& groom, int rootCount,
                                std::vector<std::string>& warnings);

}  // namespace ringlet
