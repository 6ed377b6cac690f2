// The facts that identify a run. Comparing them lets a run that resumes another's frames say what differs.
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

/// Every key of the scene that differs from the default, and the CRC-32 of every file. Fails where a file
/// cannot be read.
Result<std::vector<RunFact>> factsOf(const SceneFile& scene,
                                     const std::vector<std::filesystem::path>& inputs);

/// Prepares a run of a scene's file, before it is opened: loads the groom's file, of which prims and values
/// are needed, into `origin`, which must outlive the run; and collects facts if another run may resume this
/// one. `input`: as for inputFilesOf. Errors: the run would overwrite an input; a file cannot be read.
Status prepareRun(const SceneFile& scene, const std::filesystem::path& input,
                  std::optional<LoadedGroom>& origin, RunOptions& options);

/// Adds every parameter that differs from the default.
void addMaterialFacts(const Material& material, std::vector<RunFact>& facts);

/// Adds the outputs of a run and what they contain.
void addOutputFacts(const RunOptions& options, std::vector<RunFact>& facts);

}  // namespace ringlet
