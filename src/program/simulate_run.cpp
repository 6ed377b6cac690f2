// Implements simulate_run.h: what is read before a run. The run itself is hair_run.cpp.
#include "program/simulate_run.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "program/run_facts.h"
#include "ringlet/measure/placement_check.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_parts.h"

namespace ringlet::program {

Result<SimulateOutcome> runSimulation(SimulateOptions& options) {
  const Groom& groom = options.groom.groom;
  std::vector<std::string> warnings = options.warnings;
  warnings.insert(warnings.end(), options.groom.warnings.begin(), options.groom.warnings.end());
  Settings settings = options.settings;
  const auto material = chooseMaterial(options.material, settings, warnings);
  if (!material) return material.error();
  if (options.motionFile) {
    const Motion stated = options.motion;
    auto motion = readMotionFile(*options.motionFile, options.up == UpAxis::z, warnings);
    if (!motion) return motion.error();
    options.motion = std::move(*motion);
    options.motion.start = stated.start;
    options.motion.roots = stated.roots;
  }
  cutJumps(settings, options.motion);
  for (std::string& doubt : checkPlacement(groom, options.bodies, options.motion.poseAt(0)))
    warnings.push_back(std::move(doubt));
  if (options.choosesFrames && options.motion.keyframes) {
    const double frames = options.motion.keyframes->seconds() * settings.framesPerSecond;
    options.frameCount = static_cast<int>(std::clamp(frames + 1e-6, 1.0, 1e6));
  }
  if (options.choosesSteps) {
    const auto steps = chooseStepsPerFrame(groom, *material, settings);
    if (!steps) return steps.error();
    settings.stepsPerFrame = options.settings.stepsPerFrame = *steps;
  }

  const std::vector<Vec3d> shifts = rootShiftsOf(options.rootShift, groom.strandCount());
  std::optional<HeadScalp> scalp;
  if (!options.scalp.file.empty()) {
    auto bound = loadScalp(options.scalp, groom, options.motion, options.motionFile, options.up == UpAxis::z,
                           warnings);
    if (!bound) return bound.error();
    scalp = std::move(*bound);
  }
  if (!options.facts.empty()) addMaterialFacts(*material, options.facts);
  auto outcome =
      runHair({groom, *material, settings, options.motion, shifts, options.bodies, scalp ? &*scalp : nullptr},
              options);
  if (!outcome) return outcome.error();
  outcome->warnings.insert(outcome->warnings.begin(), warnings.begin(), warnings.end());
  return outcome;
}

}  // namespace ringlet::program
