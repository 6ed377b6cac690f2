// Implements scenes/load/scene_parts.h.
#include "ringlet/scenes/load/scene_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/bodies/mesh_file.h"
#include "ringlet/bodies/mesh_scalp.h"
#include "ringlet/groom/hair_styles.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet {
namespace {

constexpr double kUsualUnit = Groom{}.metresPerUnit;

Keyframes keyframesOf(const SceneMotion& motion) {
  Keyframes keys;
  keys.restsAtEnds = true;
  if (motion.interpolation == "linear") keys.interpolation = Keyframes::Interpolation::linear;
  for (const SceneKeyframe& key : motion.keys) {
    keys.times.push_back(key.time);
    keys.poses.push_back({key.position, key.quaternion ? normalized(*key.quaternion)
                                                       : turnOfDegrees(key.rotateDegrees.value_or(Vec3d{}))});
  }
  return keys;
}

}  // namespace

Quatd turnOfDegrees(Vec3d degrees) {
  const Vec3d turn = degrees * (std::numbers::pi / 180);
  return fromRotationVector(Vec3d{0, 0, turn.z}) * fromRotationVector(Vec3d{0, turn.y, 0}) *
         fromRotationVector(Vec3d{turn.x, 0, 0});
}

Vec3d upOf(const SceneGroom& groom) { return groom.up == "Z" ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }

SceneGroom groomOfStyle(const std::string& style) {
  SceneGroom groom;
  const auto head = headOfStyle(style);
  if (!head) return groom;
  groom.length = head->curl.length;
  groom.radius = head->curl.radius;
  groom.turns = head->curl.turns;
  groom.locks = head->lockCount;
  groom.cut = head->cut;
  return groom;
}

GroomReading readingOf(const SceneGroom& groom, bool keepsPrims) {
  return {.upIsZ = groom.up == "Z",
          .keepsPrims = keepsPrims,
          .pointsPerStrand = static_cast<std::uint32_t>(groom.pointsPerStrand),
          .rootEnd = rootEndOf(groom.rootEnd).value_or(RootEnd::first)};
}

ForeignReading foreignReadingOf(const SceneFile& scene) {
  const GroomReading groom = readingOf(scene.groom);
  return {.metresPerUnit = scene.groom.metresPerUnit,
          .upIsZ = groom.upIsZ,
          .rootEnd = groom.rootEnd,
          .pointsPerStrand = groom.pointsPerStrand,
          .framesPerSecond = scene.simulation.framesPerSecond,
          .groom = scene.groom.file};
}

Result<std::shared_ptr<const ScalpSurface>> readScalp(const std::filesystem::path& path,
                                                      double metresPerUnit) {
  const auto mesh = readObjMesh(path, metresPerUnit);
  if (!mesh) return mesh.error();
  auto scalp = makeMeshScalp(*mesh);
  if (!scalp) return Error{fmt::format("{}: {}", path.string(), scalp.error().message)};
  return scalp;
}

Result<Groom> generatedGroom(const SceneGroom& groom) {
  const CurlParameters curl{.radius = groom.radius,
                            .turns = groom.turns,
                            .length = groom.length,
                            .particleCount = groom.particles,
                            .handedness = groom.hand == "left" ? -1 : 1,
                            .phase = groom.phase,
                            .metresPerUnit = groom.metresPerUnit.value_or(kUsualUnit)};
  const Variation variation{.radius = groom.varyRadius,
                            .length = groom.varyLength,
                            .phase = groom.varyPhase,
                            .leftHandedShare = groom.otherHand,
                            .seed = groom.seed};
  if (groom.generate == "curl") return makeCurl(curl);
  if (groom.generate == "swatch") {
    return makeSwatch({.curl = curl,
                       .variation = variation,
                       .columnCount = groom.columns,
                       .rowCount = groom.rows,
                       .spacing = groom.spacing});
  }
  HeadParameters head = headOfStyle(groom.style).value_or(HeadParameters{});
  head.cut = groom.cut;
  head.curl = curl;
  head.variation = variation;
  head.strandCount = groom.strands;
  head.lockCount = groom.locks;
  head.scalpRadius = groom.scalpRadius;
  if (!groom.scalp.empty()) {
    auto scalp = readScalp(groom.scalp, curl.metresPerUnit);
    if (!scalp) return scalp.error();
    head.scalp = std::move(*scalp);
  }
  return makeHead(head);
}

void placeGroom(const SceneGroom& scene, Groom& groom) {
  if (scene.scale == 1 && scene.rotateDegrees == Vec3d{} && scene.offset == Vec3d{}) return;
  const Quatd turn = turnOfDegrees(scene.rotateDegrees);
  const Vec3d moved = scene.offset / groom.metresPerUnit;
  for (Vec3f& p : groom.points) p = Vec3f(rotate(turn, Vec3d(p) * scene.scale) + moved);
}

UsdTransform placementOf(const SceneGroom& scene, double metresPerUnit) {
  const Quatd turn = turnOfDegrees(scene.rotateDegrees);
  const auto row = [&](Vec3d axis) { return rotate(turn, axis) * scene.scale; };
  return {{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})}, scene.offset / metresPerUnit};
}

Motion motionOf(const SceneMotion& motion, Vec3d up) {
  Motion result;
  if (motion.keys.empty()) {
    result = motionByName(motion.kind, up).value_or(Motion{});
    result.amplitude = motion.amplitude.value_or(result.amplitude);
    result.frequency = motion.frequency.value_or(result.frequency);
    result.easeSeconds = motion.easeSeconds.value_or(result.easeSeconds);
    result.untilSeconds = motion.untilSeconds.value_or(result.untilSeconds);
    if (motion.axis) result.axis = normalizedOr(*motion.axis, result.axis);
  } else {
    result.kind = MotionKind::keyframes;
    result.keyframes = std::make_shared<const Keyframes>(keyframesOf(motion));
  }
  result.start = motion.start;
  result.roots = {.frequency = motion.roots.frequency,
                  .easeSeconds = motion.roots.easeSeconds,
                  .untilSeconds = motion.roots.untilSeconds};
  return result;
}

std::vector<Vec3d> rootShiftsOf(Vec3d shift, std::size_t strandCount) {
  std::vector<Vec3d> shifts;
  if (length(shift) == 0) return shifts;
  for (std::size_t s = 0; s < strandCount; ++s) shifts.push_back(2 * s < strandCount ? shift : shift * -1.0);
  return shifts;
}

Settings settingsOf(const SceneFile& scene) {
  const SceneSimulation& simulation = scene.simulation;
  Settings settings;
  settings.framesPerSecond = simulation.framesPerSecond;
  settings.stepsPerFrame = simulation.stepsPerFrame.value_or(1);
  settings.integrator = integratorNamed(simulation.integrator);
  settings.gravity = upOf(scene.groom) * -simulation.gravity;
  // The paper's own scheme knows no preload.
  settings.gravityPreload = simulation.preload.value_or(settings.integrator == Integrator::paper ? 0 : 1);
  settings.maxStretch = simulation.maxStretch;
  settings.rootCount = simulation.roots;
  settings.teleportDistance = simulation.teleportDistance;
  settings.sleepSpeed = simulation.sleepSpeed;
  settings.pointIterations = simulation.iterations;
  settings.chebyshev = simulation.chebyshev;
  settings.forceLoops = simulation.forceLoops;
  settings.dampingLoops = simulation.dampingLoops;
  settings.contacts = scene.contacts;
  settings.air = scene.air;
  settings.goal = scene.goal;
  return settings;
}

Body bodyOf(const SceneBody& body, std::size_t index, Vec3d up) {
  Body result = body;
  if (result.name.empty()) result.name = fmt::format("{} {}", nameOf(body.shape), index + 1);
  result.place = {body.position, turnOfDegrees(body.rotateDegrees)};
  if (body.moves && body.moves->file.empty()) result.motion = motionOf(*body.moves, up);
  return result;
}

SceneBody bustBody() {
  SceneBody bust;
  bust.name = "bust";
  bust.shape = BodyShape::grid;
  bust.generate = "bust";
  bust.deforms = true;
  return bust;
}

SceneFile sceneFileOf(const BuiltinScene& scene, const std::filesystem::path& groom) {
  SceneFile file;
  file.groom.file = groom;
  if (scene.groom.metresPerUnit != kUsualUnit) file.groom.metresPerUnit = scene.groom.metresPerUnit;
  file.material.material = scene.material;
  file.hasMaterial = true;

  const Motion& motion = scene.motion;
  file.motion.kind = motionName(motion.kind);
  if (motion.kind != MotionKind::still) {
    file.motion.amplitude = motion.amplitude;
    file.motion.axis = motion.axis;
    if (motion.kind != MotionKind::glide) file.motion.easeSeconds = motion.easeSeconds;
    if (isToAndFro(motion.kind)) {
      file.motion.frequency = motion.frequency;
      if (std::isfinite(motion.untilSeconds)) file.motion.untilSeconds = motion.untilSeconds;
    }
  }
  file.motion.start = motion.start;
  if (!scene.rootShifts.empty()) {
    file.motion.roots = {scene.rootShifts.front(), motion.roots.frequency, motion.roots.easeSeconds,
                         motion.roots.untilSeconds};
  }

  for (const Body& body : scene.bodies) {
    if (body.bends()) {
      file.bodies.push_back(bustBody());
      continue;
    }
    RINGLET_ASSERT(body.shape == BodyShape::grid, "other bodies of built-in scenes are the generated head");
    SceneBody head;
    static_cast<Body&>(head) = body;
    head.grid = nullptr;
    head.generate = "head";
    file.bodies.push_back(std::move(head));
  }

  if (scene.scalp) file.scalp.body = "bust";

  const Settings& settings = scene.settings;
  SceneSimulation& simulation = file.simulation;
  simulation.framesPerSecond = settings.framesPerSecond;
  simulation.frames = scene.frameCount;
  simulation.stepsPerFrame = settings.stepsPerFrame;
  simulation.gravity = -settings.gravity.y;
  simulation.preload = settings.gravityPreload;
  simulation.integrator = nameOf(settings.integrator);
  simulation.roots = settings.rootCount;
  simulation.teleportDistance = settings.teleportDistance;
  simulation.sleepSpeed = settings.sleepSpeed;
  simulation.iterations = settings.pointIterations;
  simulation.chebyshev = settings.chebyshev;
  simulation.forceLoops = settings.forceLoops;
  simulation.dampingLoops = settings.dampingLoops;
  simulation.maxStretch = settings.maxStretch;
  file.contacts = settings.contacts;
  file.air = settings.air;
  file.goal = settings.goal;
  return file;
}

}  // namespace ringlet
