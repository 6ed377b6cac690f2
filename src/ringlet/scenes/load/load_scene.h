// What a scene names, read: the groom, the bodies, whatever moves as a file says.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/bodies/triangle_mesh.h"
#include "ringlet/follow/level_of_detail.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/motion/head_scalp.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/motion/moving_body.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/scene_cuts.h"
#include "ringlet/scenes/frames/scene_forces.h"
#include "ringlet/scenes/frames/scene_keys.h"

namespace ringlet {

struct StrandGeometry;

/// In its unit, the scene's or else the file's, turned to the scene's up axis, placed in the head's frame.
/// `keepsPrims`: with LoadedGroom::prims.
Result<LoadedGroom> loadGroom(const SceneGroom& scene, bool keepsPrims = false);

/// All of them, ready to be stepped. `metresPerUnit`: the groom's, and of meshes that state none. Fails with
/// the body's name.
Result<std::vector<Body>> loadBodies(const SceneFile& scene, double metresPerUnit,
                                     std::vector<std::string>& warnings);

/// What a scene says of a motion file, of the head or of a body.
MotionFileChoice motionFileOf(const SceneMotion& motion);

/// The way of a joint of the head's motion file.
Result<Motion> jointMotion(const SceneFile& scene, const std::string& joint,
                           std::vector<std::string>& warnings);

/// The scene's material with its dials worked in; adds what a person should know. Errors: a material that its
/// dials spoil.
Result<Material> loadMaterialOf(const SceneFile& scene, Integrator integrator,
                                std::vector<std::string>& warnings);

/// Where hairs that follow the strands stand, and how they differ from strand to strand.
struct SceneHairs {
  std::shared_ptr<const TriangleMesh> scalp{};  // in the groom's axes [m]; none: [scalp]'s, or none
  std::vector<float> densities{}, clumps{};     // factors of each strand; empty: all 1
};

/// As measureGeometry of rest/rest_state.h makes it.
using SharedGeometry = std::shared_ptr<const std::vector<StrandGeometry>>;

struct ShotStart;

/// Everything that a run of a scene starts from.
struct LoadedScene {
  Groom groom;                                   // what is simulated: all strands, or the guides
  std::shared_ptr<const LevelOfDetail> level{};  // of all hairs, where they follow guides
  SharedGeometry geometry{};                     // of the groom, where it had to be measured or was known
  Material material;                             // its dials worked in
  Settings settings;
  Motion motion;
  std::vector<Vec3d> rootShifts{};           // as InitialState takes them
  std::shared_ptr<const ShotStart> start{};  // none: hair begins at rest
  std::vector<Body> bodies{};
  std::vector<MovingBody> moving{};  // those that bend, in the order of bodies
  std::optional<HeadScalp> scalp{};  // that roots follow; none: the head carries them
  SceneForces forces{};              // fields and holds
  SceneHairs hairs{};
  std::vector<TimedCuts> cuts{};      // by rising time
  std::vector<float> widthFactors{};  // of each strand, or hair of `level`, on the width in pictures and USD
                                      // files; empty: all 1
  double preRollSeconds = 0;
  int frameCount = 48;                  // where the file does not say: the length of keys, or this
  std::optional<SceneKeys> keys{};      // of numbers that change; settings and material are then the start's
  std::vector<std::string> warnings{};  // a sentence each
  std::vector<std::string> notes{};     // likewise, of what is well and may be better
};

/// Reads all that the file names, and chooses the steps a frame where it leaves them open. `known`: its
/// groom, where loadGroom has read it already, and `geometry` that groom's. Warnings also say what seems to
/// be of another unit, place or axis than the rest. Errors: those of the parts; a material that its dials
/// spoil.
Result<LoadedScene> loadScene(const SceneFile& scene, const LoadedGroom* known = nullptr,
                              SharedGeometry geometry = {});

}  // namespace ringlet
