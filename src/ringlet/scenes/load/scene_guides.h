// Guides of a scene: the strands that are simulated of a groom whose other hairs follow them.
#pragma once

#include <optional>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Whether some strands of the groom follow others.
bool hasGuides(const SceneGroom& groom);

/// Strands of the groom's file, or another's, that were read before anything moves. Errors: keys that do not
/// go together, what a scene names by strands of the groom and guides do not have yet.
Status checkGuides(const SceneFile& scene);

/// The guides of the scene's file of guides, in the groom's unit and place; nothing: they are of the groom.
Result<std::optional<Groom>> readGuides(const SceneGroom& scene, double metresPerUnit,
                                        std::vector<std::string>& warnings);

/// Makes the guides the scene's groom, and its hairs LoadedScene::level; what differs from strand to strand
/// becomes the guides'. `ofFile`: the last so many strands are those of readGuides, and no hairs. Errors: a
/// primvar that is not there, or names no guide; a strand without length. Cost: that of levelOfDetailOfCount.
Status takeGuides(const SceneFile& scene, std::size_t ofFile, LoadedScene& loaded);

}  // namespace ringlet
