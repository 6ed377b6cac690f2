// Implements load_scene.h.
#include "program/load_scene.h"

#include <fmt/format.h>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/up_axis.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet::program {
namespace {

// TO BE FILLED IN when mesh bodies come: reads or generates the mesh of `scene` (file or generate, scale, and
// metresPerUnit, which where it is unset is `groom`'s), makes its distance grid of scene.cells along its
// longest side and gives it to `body`, which has all the rest.
Status loadMeshBody(const SceneBody& scene, const SceneGroom& groom, Body& body) {
  static_cast<void>(scene), static_cast<void>(groom), static_cast<void>(body);
  return Error{"mesh bodies are not built in yet"};
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
    auto read = readGroom(scene.file);
    if (!read) return read.error();
    loaded = std::move(*read);
    loaded.groom.metresPerUnit = scene.metresPerUnit;
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

Result<std::vector<Body>> loadBodies(const SceneFile& scene, std::vector<std::string>& warnings) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& stated = scene.bodies[i];
    Body body = bodyOf(stated, i, upOf(scene.groom));
    Status loaded = loadMotion(stated, scene, body, warnings);
    if (loaded && stated.shape == "mesh") loaded = loadMeshBody(stated, scene.groom, body);
    if (!loaded) return Error{fmt::format("the body {}: {}", body.name, loaded.error().message)};
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace ringlet::program
