// The mesh that a scalp or a body that bends is, as a scene file states it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "ringlet/base/vec3.h"
#include "ringlet/motion/mesh_motion.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// As motion/mesh_motion_file.h takes it; what is empty is as the kind of file has it.
struct MovingMeshSource {
  std::filesystem::path file, cache;
  std::string mesh, animation, up;
  std::optional<double> metresPerUnit, framesPerSecond;
};

MovingMeshSource sourceOf(const SceneScalp& scalp);
MovingMeshSource sourceOf(const SceneBody& body);

struct MovingMesh {
  std::shared_ptr<const MeshMotion> mesh;
  Vec3d offset;  // of the run's world from the mesh's [m]
};

/// Where its file is the head's the two stand in one world, and what the source leaves open is the head's.
/// What of `loaded` it needs is there: groom, motion, settings. Warnings go to loaded.warnings. Errors: those
/// of readMeshMotion.
Result<MovingMesh> readMovingMesh(const MovingMeshSource& source, const SceneFile& file, LoadedScene& loaded);

}  // namespace ringlet
