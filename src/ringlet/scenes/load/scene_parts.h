// From what a scene file states to what is stepped, as far as no other file is needed but a scalp's; and
// back, of built-in scenes.
#pragma once

#include <filesystem>
#include <memory>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/groom/scalp_surface.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/foreign/foreign_frames.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/builtin_scene.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Turned about X first, then Y, then Z, axes that stay.
Quatd turnOfDegrees(Vec3d degrees);

Vec3d upOf(const SceneGroom& groom);

/// What holds without keys: the defaults, or a style's; its own `style` is empty.
SceneGroom groomOfStyle(const std::string& style);

/// How the groom's file is to be read.
GroomReading readingOf(const SceneGroom& groom, bool keepsPrims = false);

/// How animations that other programs wrote of the scene's strands are read: what they do not say is the
/// groom's, and the run's rate.
ForeignReading foreignReadingOf(const SceneFile& scene);

/// A mesh that generated hair grows on. Errors: those of readObjMesh and, with the path, of makeMeshScalp.
Result<std::shared_ptr<const ScalpSurface>> readScalp(const std::filesystem::path& path,
                                                      double metresPerUnit);

/// Of a groom with a generator, in its unit, not yet placed. Errors: as for makeHead and readScalp.
Result<Groom> generatedGroom(const SceneGroom& groom);

/// Into the head's frame: scaled, turned, moved. One that stays where it is keeps its bits.
void placeGroom(const SceneGroom& scene, Groom& groom);
/// The same as a map of the groom's points [unit of the groom].
UsdTransform placementOf(const SceneGroom& scene, double metresPerUnit);

/// A built-in motion or keys, not a file's.
Motion motionOf(const SceneMotion& motion, Vec3d up);

/// Each strand's shift of its root (InitialState::rootShifts); none where nothing shifts.
std::vector<Vec3d> rootShiftsOf(Vec3d shift, std::size_t strandCount);

/// stepsPerFrame is 1 where it is to be chosen.
Settings settingsOf(const SceneFile& scene);

/// Everything but what must be read: `grid` of a mesh, and the motion of a joint or a file.
Body bodyOf(const SceneBody& body, std::size_t index, Vec3d up);

/// The bust as a scene's body.
SceneBody bustBody();

/// A built-in scene with its groom in a file; what the file does not hold is the sentence it shows.
SceneFile sceneFileOf(const BuiltinScene& scene, const std::filesystem::path& groom);

}  // namespace ringlet
