// Implements simulate_run.h: a run of a scene. The run itself is hair_run.cpp.
#include "program/simulate_run.h"

#include <algorithm>
#include <utility>

#include "program/output_options.h"
#include "program/run_facts.h"

namespace ringlet::program {

RunOptions runOptionsOf(const SceneFile& scene) {
  RunOptions options;
  options.folder = scene.output.folder;
  options.up = scene.groom.up == "Z" ? UpAxis::z : UpAxis::y;
  chooseOutputs(scene.output, options);
  return options;
}

Result<SimulateOutcome> runLoadedScene(const LoadedScene& scene, RunOptions options,
                                       const FrameObserver& observer) {
  if (!options.facts.empty()) addMaterialFacts(scene.material, options.facts);
  auto outcome = runHair(scene, options, observer);
  if (!outcome) return outcome.error();
  outcome->warnings.insert(outcome->warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  outcome->notes = scene.notes;
  return outcome;
}

}  // namespace ringlet::program
