// Implements scenes/load/load_scene.h.
#include "ringlet/scenes/load/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "ringlet/base/quoted.h"
#include "ringlet/bodies/head_mesh.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_grid.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/measure/groom_doubts.h"
#include "ringlet/measure/joint_check.h"
#include "ringlet/measure/material_suggestion.h"
#include "ringlet/measure/placement_check.h"
#include "ringlet/motion/abc_mesh.h"
#include "ringlet/motion/bust_motion.h"
#include "ringlet/motion/mesh_motion_file.h"
#include "ringlet/motion/motion_file.h"
#include "ringlet/motion/usd_mesh.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/rest/material_presets.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/body_forms.h"
#include "ringlet/scenes/load/bending_body.h"
#include "ringlet/scenes/load/idle_dials.h"
#include "ringlet/scenes/load/motion_reach.h"
#include "ringlet/scenes/load/scalp_doubts.h"
#include "ringlet/scenes/load/scene_guides.h"
#include "ringlet/scenes/load/scene_maps.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "ringlet/scenes/load/scene_scalp.h"
#include "ringlet/scenes/load/shot_start.h"
#include "ringlet/scenes/load/world_bind.h"

namespace ringlet {
namespace {

constexpr const char* kBodyEndings = ".obj, .gltf, .glb, .vrm, .usda, .usdc, .usd, .usdz and .abc files";

// Of a glTF, USD or Alembic file, turned up, a mesh as it is at the first key or sample; it does not bend.
Result<TriangleMesh> readMeshAtFirst(const SceneBody& scene, bool upIsZ, double metresPerUnit,
                                     std::vector<std::string>& warnings) {
  MeshMotionChoice choice{.path = scene.file, .mesh = scene.mesh, .metresPerUnit = scene.metresPerUnit};
  if (!choice.metresPerUnit && isWithoutUnit(scene.file)) choice.metresPerUnit = metresPerUnit;
  const auto read = readMeshMotion(choice, upIsZ);
  if (!read) return read.error();
  const MeshMotion& moving = **read;
  for (const std::string& warning : moving.warnings())
    warnings.push_back(fmt::format("{}: {}", scene.file.string(), warning));
  TriangleMesh mesh{moving.pointsAt(moving.firstSeconds()), moving.triangles()};
  if (Status checked = checkMesh(mesh); !checked)
    return Error{fmt::format("{}: {}", scene.file.string(), checked.error().message)};
  return mesh;
}

// The triangles of a body of shape mesh, read or made, in its own axes [m].
Result<TriangleMesh> meshOf(const SceneBody& scene, const SceneGroom& groom, double metresPerUnit,
                            std::vector<std::string>& warnings) {
  TriangleMesh mesh;
  if (scene.generate == "head") {
    HeadParameters head;
    head.scalpRadius = groom.scalpRadius;
    mesh = makeHeadMesh(head);
  } else if (!scene.generate.empty()) {
    const auto motion = generatedMotion(scene.generate);
    mesh = {motion->pointsAt(0), motion->triangles()};
  } else {
    const bool isPlaced = isUsdFile(scene.file) || isAbcFile(scene.file) ||
                          motionFileKind(scene.file.string()) == MotionFileKind::gltf;
    if (!isPlaced && !scene.mesh.empty())
      return Error{
          fmt::format("{}: found the mesh {}; only a glTF, USD or Alembic file has meshes with names",
                      scene.file.string(), ringlet::quoted(scene.mesh))};
    auto read = isPlaced ? readMeshAtFirst(scene, groom.up == "Z", metresPerUnit, warnings)
                         : readObjMesh(scene.file, scene.metresPerUnit.value_or(metresPerUnit));
    if (!read && !isPlaced && !isObjMesh(scene.file)) {
      return Error{fmt::format("{}; bodies are read from {}", read.error().message, kBodyEndings),
                   read.error().fault};
    }
    if (!read) return read.error();
    mesh = std::move(*read);
  }
  for (Vec3d& point : mesh.points) point = point * scene.scale;
  return mesh;
}

// Its distance grid.
Status loadMeshBody(const SceneBody& scene, const SceneGroom& groom, double metresPerUnit, Body& body,
                    std::vector<std::string>& warnings) {
  const auto mesh = meshOf(scene, groom, metresPerUnit, warnings);
  if (!mesh) return mesh.error();
  auto made = makeDistanceGrid(*mesh, {.cells = scene.cells});
  if (!made) return made.error();
  for (const std::string& warning : made->warnings)
    warnings.push_back(fmt::format("the body {}: {}", body.name, warning));
  body.grid = std::make_shared<const DistanceGrid>(std::move(made->grid));
  return {};
}

}  // namespace

MotionFileChoice motionFileOf(const SceneMotion& motion) {
  return {motion.file,       motion.joint,     motion.metresPerUnit,
          motion.skipFrames, motion.animation, fileAxisNamed(motion.up),
          motion.joint};
}

Result<Motion> jointMotion(const SceneFile& scene, const std::string& joint,
                           std::vector<std::string>& warnings) {
  if (scene.motion.file.empty())
    return Error{
        fmt::format("its joint {} is one of the head's motion file, but the head follows none", joint)};
  MotionFileChoice choice = motionFileOf(scene.motion);
  choice.joint = joint;
  auto motion = readMotionFile(choice, scene.groom.up == "Z", warnings);
  if (motion) motion->start = scene.motion.start;
  return motion;
}

namespace {

// The way of a joint or of a body's own file.
Status loadMotion(const SceneBody& scene, const SceneFile& file, Body& body,
                  std::vector<std::string>& warnings) {
  if (scene.joint.empty() && (!scene.moves || scene.moves->file.empty())) return {};
  auto motion = scene.joint.empty()
                    ? readMotionFile(motionFileOf(*scene.moves), file.groom.up == "Z", warnings)
                    : jointMotion(file, scene.joint, warnings);
  if (!motion) return motion.error();
  if (scene.joint.empty()) motion->start = scene.moves->start;
  body.motion = std::move(*motion);
  return {};
}

// Where keys are further apart than a head goes in a frame, it jumps: on a smooth way it would only be fast.
void cutJumps(const Settings& settings, Motion& motion) {
  if (!motion.keyframes || settings.teleportDistance <= 0) return;
  Keyframes keys = *motion.keyframes;
  keys.cutSpeed = settings.teleportDistance * settings.framesPerSecond;
  motion.keyframes = std::make_shared<const Keyframes>(std::move(keys));
}

// The motion, from its file where it has one.
Result<Motion> loadedMotion(const SceneFile& scene, const Settings& settings,
                            std::vector<std::string>& warnings) {
  Motion motion = motionOf(scene.motion, upOf(scene.groom));
  if (!scene.motion.file.empty()) {
    auto read = readMotionFile(motionFileOf(scene.motion), scene.groom.up == "Z", warnings);
    if (!read) return read.error();
    read->start = motion.start;
    read->roots = motion.roots;
    motion = std::move(*read);
  }
  cutJumps(settings, motion);
  return motion;
}

// Of a file's groom: whether it runs from tip to root, or lies on its side. `statesUp`: the file does.
void checkGroomFile(const SceneFile& scene, bool statesUp, LoadedScene& loaded) {
  if (!scene.groom.generate.empty()) return;
  auto ends = checkRootEnds(loaded.groom, loaded.bodies, loaded.motion.poseAt(0));
  if (!ends && !scene.scalp.isThere()) ends = doubtOfRootEnds(loaded.groom);
  if (ends) loaded.warnings.push_back(std::move(*ends));
  const bool isTurned = scene.groom.rotateDegrees != Vec3d{};
  if (statesUp || isTurned) return;
  if (auto doubt = doubtOfUp(loaded.groom, scene.groom.up == "Z"))
    loaded.warnings.push_back(std::move(*doubt));
}

// The preset that a file's groom looks like, where nobody chose a material.
void notePreset(const SceneFile& scene, LoadedScene& loaded) {
  const Material& material = scene.material.material;
  if (!scene.groom.generate.empty() || scene.hasMaterial || !(material == Material{})) return;
  const MaterialSuggestion suggestion =
      suggestMaterial(inspectShape(loaded.groom), loaded.groom.metresPerUnit);
  const auto preset = materialPreset(suggestion.preset);
  if (!suggestion.isClear || !preset || *preset == material) return;
  loaded.notes.push_back(fmt::format(
      "this groom looks like {0}, and has the default material; preset = \"{0}\" of [material] (--material "
      "{0}) suits it better: {1}",
      suggestion.preset, suggestion.reason));
}

// A groom that is bound to the world and turned by a built-in motion turns about its own head.
void turnAboutOwnHead(const SceneFile& scene, LoadedScene& loaded) {
  const bool isBuiltIn = scene.motion.file.empty() && scene.motion.keys.empty();
  if (!isBuiltIn || scene.groom.bind != "world" || scene.motion.start != Vec3d{}) return;
  if (standsFarOff(loaded.groom)) loaded.motion.start = headMiddle(loaded.groom);
}

// Binds what is bound to the world, and says what seems to be of another unit, place or axis.
Status bindAndCheck(const SceneFile& scene, LoadedScene& loaded) {
  turnAboutOwnHead(scene, loaded);
  const WorldBind bind = worldBindOf(scene);
  const bool followsJoint = !scene.motion.file.empty();
  const auto warn = [&](std::optional<std::string> doubt) {
    if (doubt) loaded.warnings.push_back(std::move(*doubt));
  };
  // A groom that is turned was placed by hand, and a scalp says itself where roots are.
  const bool isPlaced = scene.groom.rotateDegrees != Vec3d{} || scene.scalp.isThere();
  if (followsJoint && !bind.groom && !isPlaced)
    warn(checkJointAxes(loaded.motion, upOf(scene.groom), scene.motion.joint));
  bindInWorld(bind, loaded.motion, loaded.groom, loaded.bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].deforms) continue;
    if (Status read = loadBendingBody(scene, i, loaded); !read) return read;
  }
  if (followsJoint) {
    const HeadPose head = loaded.motion.poseAt(bind.groom.value_or(0));
    warn(checkJointDistance(loaded.groom, head, bind.groom.has_value(), scene.motion.joint));
  } else if (!bind.groom && !isPlaced) {
    warn(doubtOfPivot(loaded.groom, loaded.motion));
  }
  for (std::string& doubt : checkPlacement(loaded.groom, loaded.bodies, loaded.motion.poseAt(0)))
    warn(std::move(doubt));
  return {};
}

int frameCountOf(const SceneFile& scene, const Motion& motion) {
  const SceneSimulation& simulation = scene.simulation;
  const double framesPerSecond = simulation.framesPerSecond;
  if (simulation.frames) return *simulation.frames;
  if (simulation.seconds)
    return std::max(1, static_cast<int>(std::lround(*simulation.seconds * framesPerSecond)));
  if (!motion.keyframes) return LoadedScene{}.frameCount;
  return static_cast<int>(std::clamp(motion.keyframes->seconds() * framesPerSecond + 1e-6, 1.0, 1e6));
}

// Enough at every key.
Result<int> stepsOf(LoadedScene& loaded) {
  if (!loaded.geometry) {
    auto measured = measureGeometry(loaded.groom);
    if (!measured) return measured.error();
    loaded.geometry = std::make_shared<const std::vector<StrandGeometry>>(std::move(*measured));
  }
  auto steps = chooseStepsPerFrame(loaded.groom, loaded.material, loaded.settings, *loaded.geometry);
  if (!loaded.keys) return steps;
  for (const double time : loaded.keys->times()) {
    if (!steps) return steps;
    const auto numbers = loaded.keys->at(time, 1);
    if (!numbers) return numbers.error();
    auto now = chooseStepsPerFrame(loaded.groom, numbers->material, numbers->settings, *loaded.geometry);
    if (!now) return now;
    steps = std::max(*steps, *now);
  }
  return steps;
}

// Hair begins with the numbers of the first key.
Status takeStart(const SceneFile& scene, LoadedScene& loaded) {
  if (!loaded.keys) return {};
  auto start = loaded.keys->at(-scene.motion.preRollSeconds, loaded.settings.stepsPerFrame);
  if (!start) return start.error();
  const bool isLive = loaded.settings.integrator == Integrator::jacobi;
  if (!isLive && !(start->material == loaded.material))
    return Error{"keys of a material need the integrator jacobi"};
  start->settings.contacts.takeLists(loaded.settings.contacts);
  loaded.settings = start->settings;
  loaded.material = std::move(start->material);
  return {};
}

// Groups whose strands do not touch each other.
Status addBundles(const SceneFile& scene, std::size_t strandCount, ContactSettings& contacts) {
  std::vector<ContactBundle> bundles;
  std::vector<const SceneGroup*> bundleOf(strandCount);
  for (const SceneGroup& group : scene.groups) {
    if (group.touch) continue;
    const auto runs = parseStrands(group.strands, 1, scene.groups);
    if (!runs) return Error{fmt::format("the group {}: {}", group.name, runs.error().message)};
    ContactBundle& bundle = bundles.emplace_back();
    for (const StrandRun& run : *runs) {
      if (run.last >= strandCount)
        return Error{fmt::format("the group {} names strand {}; the groom has {}, numbered from 0",
                                 group.name, run.last, strandCount)};
      for (std::uint32_t s = run.first; s <= run.last; ++s) {
        if (bundleOf[s])
          return Error{fmt::format(
              "strand {} is in the groups {} and {}, and strands of neither touch each other; expected it in "
              "one of them, or both as one group",
              s, bundleOf[s]->name, group.name)};
        bundleOf[s] = &group;
        bundle.push_back(s);
      }
    }
  }
  if (!bundles.empty())
    contacts.bundles = std::make_shared<const std::vector<ContactBundle>>(std::move(bundles));
  return {};
}

// Maps of the radius.
Status addRadii(const SceneFile& scene, std::size_t strandCount, ContactSettings& contacts) {
  auto factors = factorsOf(kContactRadiusMap, scene, strandCount);
  if (!factors) return factors.error();
  if (!factors->empty())
    contacts.radiusFactors = std::make_shared<const std::vector<float>>(std::move(*factors));
  return {};
}

// The body that hairs grow on, where the head is at the start.
Status addHairScalp(const SceneFile& scene, LoadedScene& loaded) {
  const std::string& name = scene.output.hairScalp;
  if (name.empty()) return {};
  for (std::size_t i = 0; i < loaded.bodies.size(); ++i) {
    if (loaded.bodies[i].name != name) continue;
    if (scene.bodies[i].shape != BodyShape::grid)
      return Error{fmt::format("the body {} that hairs grow on is a {}; expected a mesh", name,
                               nameOf(scene.bodies[i].shape))};
    std::vector<std::string> said;  // with the body
    auto mesh = meshOf(scene.bodies[i], scene.groom, loaded.groom.metresPerUnit, said);
    if (!mesh) return mesh.error();
    const HeadPose head = loaded.motion.poseAt(0);
    const BodyPose pose = loaded.bodies[i].poseAt(0, head);
    for (Vec3d& point : mesh->points)
      point = rotate(head.rotation.conjugate(), pose.position + rotate(pose.rotation, point) - head.position);
    loaded.hairs.scalp = std::make_shared<const TriangleMesh>(std::move(*mesh));
    return {};
  }
  return Error{fmt::format("no body is named {}, which output.hair_scalp says that hairs grow on", name)};
}

// What differs from strand to strand in what is shown.
Status addHairMaps(const SceneFile& scene, LoadedScene& loaded) {
  const std::pair<const char*, std::vector<float>*> maps[] = {{kWidthMap, &loaded.widthFactors},
                                                              {kHairsMap, &loaded.hairs.densities},
                                                              {kClumpMap, &loaded.hairs.clumps}};
  for (const auto& [number, into] : maps) {
    auto factors = factorsOf(number, scene, loaded.groom.strandCount());
    if (!factors) return factors.error();
    *into = std::move(*factors);
  }
  return {};
}

}  // namespace

Result<LoadedGroom> loadGroom(const SceneGroom& scene, bool keepsPrims) {
  LoadedGroom loaded;
  if (scene.generate.empty()) {
    auto read = readGroom(scene.file, readingOf(scene, keepsPrims));
    if (!read) return read.error();
    loaded = std::move(*read);
    if (scene.metresPerUnit) loaded.groom.metresPerUnit = *scene.metresPerUnit;
    for (std::string& doubt : doubtsOfPlaces(loaded.groom)) loaded.warnings.push_back(std::move(doubt));
  } else {
    auto made = generatedGroom(scene);
    if (!made) return made.error();
    loaded.groom = std::move(*made);
    if (const auto warning = coarseCurlWarning(
            {.turns = scene.turns, .length = scene.length, .particleCount = scene.particles}))
      loaded.warnings.push_back(*warning);
  }
  placeGroom(scene, loaded.groom);
  const UsdTransform placement = placementOf(scene, loaded.groom.metresPerUnit);
  for (GroomPrim& prim : loaded.prims) prim.toGroom = prim.toGroom.then(placement);
  return loaded;
}

Result<std::vector<Body>> loadBodies(const SceneFile& scene, double metresPerUnit,
                                     std::vector<std::string>& warnings) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& stated = scene.bodies[i];
    Body body = bodyOf(stated, i, upOf(scene.groom));
    Status loaded = loadMotion(stated, scene, body, warnings);
    if (loaded && stated.shape == BodyShape::grid && !stated.deforms)
      loaded = loadMeshBody(stated, scene.groom, metresPerUnit, body, warnings);
    if (!loaded) {
      return Error{fmt::format("the body {}: {}", body.name, loaded.error().message), loaded.error().fault};
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Result<Material> loadMaterialOf(const SceneFile& scene, Integrator integrator,
                                std::vector<std::string>& warnings) {
  Material material = scene.material.material;
  const MaterialDials& dials = scene.material.dials;
  if (scene.hasMaterial && integrator == Integrator::paper) {
    warnings.push_back(
        "the paper's integrator has spring constants of its own; of the material only its smoothing lengths, "
        "core elongations and factors on gravity and inertia count");
  }
  for (const std::string& warning : scene.material.warnings) warnings.push_back(warning);
  if (const auto warning = applyDials(dials, material)) warnings.push_back(*warning);
  if (Status checked = checkMaterial(material); !checked) {
    return Error{fmt::format("{}, with the dials worked in: {}", checked.error().message, dialsText(dials))};
  }
  return material;
}

Result<LoadedScene> loadScene(const SceneFile& scene, const LoadedGroom* known, SharedGeometry geometry) {
  LoadedScene loaded;
  loaded.warnings = scene.warnings;
  auto groom = known ? Result<LoadedGroom>(*known) : loadGroom(scene.groom);
  if (!groom) return groom.error();
  loaded.groom = std::move(groom->groom);
  if (Status checked = checkGuides(scene); !checked) return checked.error();
  const auto guides = readGuides(scene.groom, loaded.groom.metresPerUnit, loaded.warnings);
  if (!guides) return guides.error();
  const std::size_t guidesOfFile = *guides ? (*guides)->strandCount() : 0;
  for (std::size_t g = 0; g < guidesOfFile; ++g) loaded.groom.addStrand((*guides)->strand(g));
  if (!worldBindOf(scene).groom) loaded.geometry = std::move(geometry);  // else its points move
  loaded.warnings.insert(loaded.warnings.end(), groom->warnings.begin(), groom->warnings.end());
  loaded.settings = settingsOf(scene);
  if (Status added = addBundles(scene, loaded.groom.strandCount(), loaded.settings.contacts); !added)
    return added.error();
  if (Status added = addRadii(scene, loaded.groom.strandCount(), loaded.settings.contacts); !added)
    return added.error();
  if (Status added = addHairMaps(scene, loaded); !added) return added.error();
  auto material = loadMaterialOf(scene, loaded.settings.integrator, loaded.warnings);
  if (!material) return material.error();
  for (const StrandFactors& factors : material->factors) {
    if (factors.runs->back().last >= loaded.groom.strandCount())
      return Error{fmt::format("a map names strand {}; the groom has {}, numbered from 0",
                               factors.runs->back().last, loaded.groom.strandCount())};
  }
  loaded.material = std::move(*material);
  auto motion = loadedMotion(scene, loaded.settings, loaded.warnings);
  if (!motion) return motion.error();
  loaded.motion = std::move(*motion);
  auto bodies = loadBodies(scene, loaded.groom.metresPerUnit, loaded.warnings);
  if (!bodies) return bodies.error();
  loaded.bodies = std::move(*bodies);
  loaded.frameCount = frameCountOf(scene, loaded.motion);
  if (Status bound = bindAndCheck(scene, loaded); !bound) return bound.error();
  checkGroomFile(scene, groom->statesUp, loaded);
  notePreset(scene, loaded);
  if (Status added = addHairScalp(scene, loaded); !added) return added.error();
  if (hasGuides(scene.groom)) {
    if (Status taken = takeGuides(scene, guidesOfFile, loaded); !taken) return taken.error();
  }
  if (!scene.timeKeys.empty()) {
    auto keys = SceneKeys::make(scene);
    if (!keys) return keys.error();
    loaded.keys.emplace(std::move(*keys));
  }
  if (Status begun = takeShotStart(scene, loaded); !begun) return begun.error();
  auto forces = SceneForces::load(scene, loaded.groom, loaded.motion, loaded.warnings);
  if (!forces) return forces.error();
  loaded.forces = std::move(*forces);
  if (loaded.start && scene.start.blend > 0)
    loaded.forces.holdStart(loaded.groom, loaded.start->placesIn(loaded.groom),
                            scene.start.blend / loaded.settings.framesPerSecond);
  if ((loaded.forces.haveFields() || loaded.forces.haveGoals()) &&
      loaded.settings.integrator != Integrator::jacobi)
    return Error{"fields, holds and goals of a file need the integrator jacobi; this run has another"};
  auto cuts = cutsOf(scene, loaded.groom, loaded.settings.rootCount);
  if (!cuts) return cuts.error();
  loaded.cuts = std::move(*cuts);
  if (!loaded.cuts.empty() && loaded.settings.integrator != Integrator::jacobi)
    return Error{"hair is cut with the integrator jacobi only; this run has another"};
  if (!scene.simulation.stepsPerFrame) {
    const auto steps = stepsOf(loaded);
    if (!steps) return steps.error();
    loaded.settings.stepsPerFrame = *steps;
  }
  if (Status started = takeStart(scene, loaded); !started) return started.error();
  loaded.rootShifts = rootShiftsOf(scene.motion.roots.shift, loaded.groom.strandCount());
  if (scene.scalp.isThere()) {
    if (Status bound = loadScalp(scene, loaded); !bound) return bound.error();
  }
  loaded.preRollSeconds = scene.motion.preRollSeconds;
  for (std::string& sentence : doubtsOfRigidBodies(loaded)) loaded.warnings.push_back(std::move(sentence));
  const double seconds = loaded.frameCount / loaded.settings.framesPerSecond;
  for (std::string& sentence : idleDials(scene.material.dials, loaded.material, loaded.groom, loaded.settings,
                                         loaded.motion, seconds))
    loaded.warnings.push_back(std::move(sentence));
  for (std::string& sentence :
       motionReach(scene, loaded.motion, loaded.bodies, loaded.settings, loaded.frameCount))
    loaded.warnings.push_back(std::move(sentence));
  return loaded;
}

}  // namespace ringlet
