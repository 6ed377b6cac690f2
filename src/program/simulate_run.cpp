// Implements simulate_run.h: a run of a scene. The run itself is hair_run.cpp.
#include "program/simulate_run.h"

#include <algorithm>
#include <utility>

#include "program/animation_source.h"
#include "program/run_facts.h"

namespace ringlet::program {

RunOptions runOptionsOf(const SceneFile& scene) {
  const SceneOutput& output = scene.output;
  const auto writes = [&](const char* file) {
    return std::ranges::find(output.files, file) != output.files.end();
  };
  RunOptions options;
  options.folder = output.folder;
  options.writesUsd = writes("hair.usda");
  options.writesLast = writes("last.obj");
  options.writesSheet = writes("sheet.png");
  if (!output.cache.empty()) options.cache = precisionByName(output.cache);
  options.up = scene.groom.up == "Z" ? UpAxis::z : UpAxis::y;
  options.width = output.width;
  return options;
}

Result<SimulateOutcome> runLoadedScene(const LoadedScene& scene, RunOptions options,
                                       const FrameObserver& observer) {
  options.frameCount = scene.frameCount;
  options.preRollSeconds = scene.preRollSeconds;
  if (!options.facts.empty()) addMaterialFacts(scene.material, options.facts);
  auto outcome = runHair({scene.groom, scene.material, scene.settings, scene.motion, scene.rootShifts,
                          scene.bodies, scene.scalp ? &*scene.scalp : nullptr},
                         options, observer);
  if (!outcome) return outcome.error();
  outcome->warnings.insert(outcome->warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  return outcome;
}

}  // namespace ringlet::program
