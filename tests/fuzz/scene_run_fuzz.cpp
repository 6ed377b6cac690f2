// Two frames of whatever a scene file says, by the CPU reference: sanitizers see all of its code, and none of
// a kernel's. Scenes beyond kMost... are left aside, so that a file takes milliseconds.
#include "program/backend.h"
#include "ringlet/output/finite_points.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_parts.h"
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
              (!body.motion || body.motion->file.empty()) &&
              (body.shape != "mesh" || body.cells <= kMostCells);
  return isSmall;
}

// Where everything is at t.
struct Instant {
  HeadPose head;
  std::vector<BodyPose> bodies;
};
Instant instantAt(double t, const Motion& motion, std::span<const Body> bodies) {
  const HeadPose head = motion.poseAt(t);
  return {head, bodyPosesOf(bodies, std::span(&head, 1), std::span(&t, 1))};
}

void run(const SceneFile& scene, const Groom& groom, const Material& material, const Settings& settings,
         std::span<const Body> bodies) {
  const Motion motion = motionOf(scene.motion, upOf(scene.groom));
  const std::vector<Vec3d> shifts = rootShiftsOf(scene.motion.roots.shift, groom.strandCount());
  const Instant start = instantAt(0, motion, bodies);
  const HeadPose earlier = motion.poseAt(-settings.stepSeconds());
  const program::BackendInput input{groom,  material, settings,     start.head, earlier,
                                    shifts, bodies,   start.bodies, {},         {}};
  auto backend = program::makeReferenceBackend(input);
  if (!backend) return;
  for (int frame = 0; frame < kFrames; ++frame) {
    std::vector<HeadPose> heads;
    std::vector<double> times;
    for (int step = 1; step <= settings.stepsPerFrame; ++step) {
      times.push_back((frame * settings.stepsPerFrame + step) * settings.stepSeconds());
      heads.push_back(motion.poseAt(times.back()));
    }
    demand((*backend)->submitFrame(heads, bodyPosesOf(bodies, heads, times), {}) && (*backend)->waitFrame(),
           "the reference steps every scene that it takes");
    std::vector<Vec3f> points(groom.points.size());
    (*backend)->framePositions(points);
    // As a run does before it writes them: what is beyond float32 is counted there.
    bool isFiniteNow = true, isFiniteThen = true;
    for (const Vec3f& point : points) isFiniteNow = isFiniteNow && isFinite(point);
    const std::size_t replaced = replaceNonfinite(groom, points);
    for (const Vec3f& point : points) isFiniteThen = isFiniteThen && isFinite(point);
    demand(isFiniteNow == (replaced == 0), "positions that are not finite are counted");
    demand(isFiniteThen, "what is written is finite");
  }
  demand(static_cast<bool>((*backend)->report()), "a run has a report");
}

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  const auto scene = parseScene(textOf(bytes), "fuzz.toml", kNoFolder);
  if (!scene || !isSmall(*scene)) return;
  std::vector<std::string> warnings;
  const auto loaded = loadGroom(scene->groom);
  if (!loaded) return;
  const auto bodies = loadBodies(*scene, loaded->groom.metresPerUnit, warnings);
  if (!bodies) return;
  Settings settings = settingsOf(*scene);
  Material material = scene->material.material;
  (void)applyDials(scene->material.dials, material);
  run(*scene, loaded->groom, material, settings, *bodies);
}

}  // namespace ringlet::fuzz
