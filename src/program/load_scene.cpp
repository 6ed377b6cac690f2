// Implements load_scene.h.
#include "program/load_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/motion/skinned_mesh.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet::program {
namespace {

// Of a glTF file the only mesh, where it is at the first key; it does not bend.
Result<TriangleMesh> readGltfMesh(const SceneBody& scene, std::vector<std::string>& warnings) {
  auto read = readSkinnedMesh(scene.file, {.placement = {.metresPerUnit = scene.metresPerUnit.value_or(1)}});
  if (!read) return read.error();
  for (const std::string& warning : read->warnings())
    warnings.push_back(fmt::format("{}: {}", scene.file.string(), warning));
  TriangleMesh mesh{read->pointsAt(read->firstSeconds()), read->triangles()};
  if (Status checked = checkMesh(mesh); !checked)
    return Error{fmt::format("{}: {}", scene.file.string(), checked.error().message)};
  return mesh;
}

// The distance grid of a mesh, read or made.
Status loadMeshBody(const SceneBody& scene, const SceneGroom& groom, double metresPerUnit, Body& body,
                    std::vector<std::string>& warnings) {
  TriangleMesh mesh;
  if (scene.generate == "head") {
    HeadParameters head;
    head.scalpRadius = groom.scalpRadius;
    mesh = makeHeadMesh(head);
  } else {
    const bool isGltf = motionFileKind(scene.file.string()) == MotionFileKind::gltf;
    auto read = isGltf ? readGltfMesh(scene, warnings)
                       : readObjMesh(scene.file, scene.metresPerUnit.value_or(metresPerUnit));
    if (!read) return read.error();
    mesh = std::move(*read);
  }
  for (Vec3d& point : mesh.points) point = point * scene.scale;
  auto made = makeDistanceGrid(mesh, {.cells = scene.cells});
  if (!made) return made.error();
  for (const std::string& warning : made->warnings)
    warnings.push_back(fmt::format("the body {}: {}", body.name, warning));
  body.grid = std::make_shared<const DistanceGrid>(std::move(made->grid));
  return {};
}

// The way of a joint or of a body's own file.
Status loadMotion(const SceneBody& scene, const SceneFile& file, Body& body,
                  std::vector<std::string>& warnings) {
  MotionFileChoice choice;
  if (!scene.joint.empty()) {
    if (file.motion.file.empty()) {
      return Error{fmt::format("its joint {} is one of the head's motion file, but the head follows none",
                               scene.joint)};
    }
    choice = motionFileOf(file.motion);
    choice.joint = scene.joint;
  } else if (scene.motion && !scene.motion->file.empty()) {
    choice = motionFileOf(*scene.motion);
  } else {
    return {};
  }
  auto motion = readMotionFile(choice, file.groom.up == "Z" ? UpAxis::z : UpAxis::y, warnings);
  if (!motion) return motion.error();
  motion->start = scene.joint.empty() ? scene.motion->start : file.motion.start;
  body.motion = std::move(*motion);
  return {};
}

}  // namespace

Result<LoadedGroom> loadGroom(const SceneGroom& scene) {
  LoadedGroom loaded;
  if (scene.generate.empty()) {
    auto read = readGroom(scene.file, {.upIsZ = scene.up == "Z"});
    if (!read) return read.error();
    loaded = std::move(*read);
    if (scene.metresPerUnit) loaded.groom.metresPerUnit = *scene.metresPerUnit;
  } else {
    auto made = generatedGroom(scene);
    if (!made) return made.error();
    loaded.groom = std::move(*made);
    if (const auto warning = coarseCurlWarning(
            {.turns = scene.turns, .length = scene.length, .particleCount = scene.particles}))
      loaded.warnings.push_back(*warning);
  }
  placeGroom(scene, loaded.groom);
  return loaded;
}

MotionFileChoice motionFileOf(const SceneMotion& motion) {
  return {motion.file, motion.joint, motion.metresPerUnit, motion.skipFrames, motion.animation};
}

Result<std::vector<Body>> loadBodies(const SceneFile& scene, double metresPerUnit,
                                     std::vector<std::string>& warnings) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& stated = scene.bodies[i];
    Body body = bodyOf(stated, i, upOf(scene.groom));
    Status loaded = loadMotion(stated, scene, body, warnings);
    if (loaded && stated.shape == "mesh")
      loaded = loadMeshBody(stated, scene.groom, metresPerUnit, body, warnings);
    if (!loaded) return Error{fmt::format("the body {}: {}", body.name, loaded.error().message)};
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Result<HeadScalp> loadScalp(const SceneScalp& scene, const Groom& groom, const Motion& head,
                            const std::optional<MotionFileChoice>& headFile, UpAxis up,
                            std::vector<std::string>& warnings) {
  const std::string name = scene.file.string();
  std::error_code code;  // files that are not there are no error of this
  const bool isHeads = headFile && std::filesystem::equivalent(headFile->path, scene.file, code);
  SkinnedMeshChoice choice{.node = scene.mesh, .animation = scene.animation};
  if (isHeads && choice.animation.empty()) choice.animation = headFile->animation;
  choice.placement.metresPerUnit =
      scene.metresPerUnit.value_or(isHeads ? headFile->metresPerUnit.value_or(1) : 1);
  choice.placement.upIsZ = up == UpAxis::z;
  auto read = readSkinnedMesh(scene.file, choice);
  if (!read) return Error{fmt::format("the scalp: {}", read.error().message)};
  const auto mesh = std::make_shared<const SkinnedMesh>(std::move(*read));
  for (const std::string& warning : mesh->warnings())
    warnings.push_back(fmt::format("{}: {}", name, warning));

  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < groom.strandCount(); ++s)
    roots.push_back(Vec3d(groom.strand(s).front()) * groom.metresPerUnit);
  auto scalp = HeadScalp::bind(
      mesh, roots, head,
      {.start = scene.start, .farthest = scene.farthest, .offset = isHeads ? head.start : Vec3d{}});
  if (!scalp) return Error{fmt::format("the scalp {}: {}", name, scalp.error().message)};
  return scalp;
}

}  // namespace ringlet::program
