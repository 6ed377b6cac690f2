// Two frames of whatever a scene file says, by the CPU reference: sanitizers see all of its code, and none of
// a kernel's. Scenes beyond kMost... are left aside, so that a file takes milliseconds.
#include <algorithm>
#include <utility>

#include "program/simulate/reference_hair.h"
#include "ringlet/output/finite_points.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/scenes/load/scene_parts.h"
#include "tests/fuzz/fuzz_target.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 64 << 20, .perByte = 4096};

namespace {

constexpr std::size_t kMostParticles = 256, kMostBodies = 4;
constexpr int kMostStrands = 16, kMostSteps = 8, kMostCells = 8, kMostIterations = 100;
constexpr int kFrames = 2;

// Before anything of its size is made. Files that a scene names have fuzzers of their own.
bool isSmall(const SceneFile& scene) {
  const SceneGroom& groom = scene.groom;
  const long long strands = groom.generate == "curl"     ? 1
                            : groom.generate == "swatch" ? 1LL * groom.columns * groom.rows
                                                         : groom.strands;
  const SceneSimulation& simulation = scene.simulation;
  bool isSmall = !groom.generate.empty() && strands <= kMostStrands &&
                 strands * groom.particles <= static_cast<long long>(kMostParticles) &&
                 scene.motion.file.empty() && scene.scalp.file.empty() &&
                 scene.bodies.size() <= kMostBodies && simulation.stepsPerFrame.value_or(1) <= kMostSteps &&
                 simulation.iterations <= kMostIterations && simulation.forceLoops <= kMostIterations &&
                 simulation.dampingLoops <= kMostIterations &&
                 scene.contacts.iterations.value_or(2) <= kMostIterations;
  for (const SceneBody& body : scene.bodies)
    isSmall = isSmall && body.file.empty() && body.joint.empty() &&
              (!body.moves || body.moves->file.empty()) &&
              (body.shape != BodyShape::grid || body.cells <= kMostCells);
  return isSmall;
}

void run(const LoadedScene& scene) {
  const SceneFrames frames(scene);
  auto hair = program::makeReferenceHair({scene, frames});
  if (!hair) return;
  for (int number = 0; number < kFrames; ++number) {
    const auto frame = frames.at(number);
    demand(frame && (*hair)->submit(*frame) && (*hair)->wait(),
           "the reference steps every scene that it takes");
    std::vector<Vec3f> points(scene.groom.points.size());
    (*hair)->framePositions(points);
    // As a run does before it writes them: what is beyond float32 is counted there.
    bool isFiniteNow = true, isFiniteThen = true;
    for (const Vec3f& point : points) isFiniteNow = isFiniteNow && isFinite(point);
    const std::size_t replaced = replaceNonfinite(scene.groom, points);
    for (const Vec3f& point : points) isFiniteThen = isFiniteThen && isFinite(point);
    demand(isFiniteNow == (replaced == 0), "positions that are not finite are counted");
    demand(isFiniteThen, "what is written is finite");
  }
  demand(static_cast<bool>((*hair)->reports()), "a run has a report");
}

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  const auto scene = parseScene(textOf(bytes), "fuzz.toml", kNoFolder);
  if (!scene || !isSmall(*scene)) return;
  if (std::ranges::any_of(scene->bodies, &SceneBody::deforms)) return;  // their meshes are files
  std::vector<std::string> warnings;
  auto loaded = loadGroom(scene->groom);
  if (!loaded) return;
  auto bodies = loadBodies(*scene, loaded->groom.metresPerUnit, warnings);
  if (!bodies) return;
  Material material = scene->material.material;
  (void)applyDials(scene->material.dials, material);
  const std::size_t strandCount = loaded->groom.strandCount();
  run({.groom = std::move(loaded->groom),
       .material = material,
       .settings = settingsOf(*scene),
       .motion = motionOf(scene->motion, upOf(scene->groom)),
       .rootShifts = rootShiftsOf(scene->motion.roots.shift, strandCount),
       .bodies = std::move(*bodies)});
}

}  // namespace ringlet::fuzz
