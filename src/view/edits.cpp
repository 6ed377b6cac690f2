// Implements view/edits.h.
#include "view/edits.h"

#include <span>
#include <string>
#include <vector>

#include "ringlet/base/whole_file.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/scenes/load/scene_paths.h"

namespace ringlet::view {

Edits editsOf(const SceneFile& scene) {
  const EditedMaterial material{scene.material.material, scene.material.dials};
  return {scene.simulation, scene.contacts, scene.air, scene.goal, {material, material}, false};
}

SceneFile sceneWith(const SceneFile& scene, const Edits& edits, std::size_t material) {
  SceneFile edited = scene;
  edited.simulation = edits.simulation;
  edited.contacts = edits.contacts;
  edited.air = edits.air;
  edited.goal = edits.goal;
  edited.material.material = edits.materials[material].material;
  edited.material.dials = edits.materials[material].dials;
  edited.hasMaterial = true;
  return edited;
}

Result<HairNumbers> numbersOf(const SceneFile& scene, const Groom& groom) {
  HairNumbers numbers{settingsOf(scene), {}};
  std::vector<std::string> warnings;  // they were said when the scene was loaded
  auto material = loadMaterialOf(scene, numbers.settings.integrator, warnings);
  if (!material) return material.error();
  numbers.material = std::move(*material);
  if (!scene.simulation.stepsPerFrame) {
    const auto steps = chooseStepsPerFrame(groom, numbers.material, numbers.settings);
    if (!steps) return steps.error();
    numbers.settings.stepsPerFrame = *steps;
  }
  return numbers;
}

Status saveScene(const SceneFile& scene, const Edits& edits, std::size_t material,
                 const std::filesystem::path& path) {
  SceneFile saved = sceneWith(scene, edits, material);
  makePathsAbsolute(saved);
  std::error_code code;  // of a folder that cannot be made absolute, the scene's paths stay so
  const auto folder = std::filesystem::absolute(path, code).parent_path();
  const std::string text = sceneText(saved, folder, "# Saved by `ringlet view`.\n");
  return writeWholeFile(path, std::as_bytes(std::span(text)));
}

}  // namespace ringlet::view
