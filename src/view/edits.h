// Edits: the numbers of a scene that a person changes while hair moves, what hair is made of them, and the
// scene they are saved as.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet::view {

/// A material as its file has it: the dials are not worked in.
struct EditedMaterial {
  Material material;
  MaterialDials dials;
  bool operator==(const EditedMaterial&) const = default;
};

struct Edits {
  SceneSimulation simulation;
  ContactSettings contacts;
  AirSettings air;
  GoalSettings goal;
  std::array<EditedMaterial, 2> materials;  // A and B
  bool compares = false;                    // B is shown beside A
};

/// What a scene says, for A and for B.
Edits editsOf(const SceneFile& scene);
/// The scene with the numbers of `edits`, and with one of its materials.
SceneFile sceneWith(const SceneFile& scene, const Edits& edits, std::size_t material = 0);

/// What hair is stepped with.
struct HairNumbers {
  Settings settings;
  Material material;  // its dials worked in
};
/// As loadScene finds them, for a groom that it has read. Errors: a material that its dials spoil.
Result<HairNumbers> numbersOf(const SceneFile& scene, const Groom& groom);

/// Writes the scene with these numbers, to be read by `ringlet simulate`. Errors: as for writeWholeFile.
Status saveScene(const SceneFile& scene, const Edits& edits, std::size_t material,
                 const std::filesystem::path& path);

}  // namespace ringlet::view
