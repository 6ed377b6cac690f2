// What a run is a run of, fact by fact: so that a run that goes on with another's frames can say what
// differs.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/output/checkpoint_file.h"
#include "ringlet/rest/material.h"
#include "ringlet/run/run_options.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Every file that a scene reads; `input`: what the user named, the scene or its groom.
std::vector<std::filesystem::path> inputFilesOf(const std::filesystem::path& input, const SceneFile& scene);

/// Every key of the scene that is not the default, and of every file its bytes' CRC-32. Fails where one
/// cannot be read.
Result<std::vector<RunFact>> factsOf(const SceneFile& scene,
                                     const std::vector<std::filesystem::path>& inputs);

/// What a run of a scene's file needs besides its scene, before it is opened: what prims and values of the
/// groom's file come from, in `origin`, which lives as long as the run, and facts, where one may go on with
/// it. `input`: as inputFilesOf. Errors: the run would overwrite what it reads; a file that cannot be read.
Status prepareRun(const SceneFile& scene, const std::filesystem::path& input,
                  std::optional<LoadedGroom>& origin, RunOptions& options);

/// Every parameter that is not the default.
void addMaterialFacts(const Material& material, std::vector<RunFact>& facts);

/// What a run writes, and what is in it.
void addOutputFacts(const RunOptions& options, std::vector<RunFact>& facts);

}  // namespace ringlet
