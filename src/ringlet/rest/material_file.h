// Material files: TOML, one key a number, as rest/material_parameters.h names them.
//
//     preset = "ringlet"       # what the rest is based on; without it, Material{}
//     bend_stiffness = 8       # [w]
//     core_smoothing_length = "rest"   # measured on the rest curl, where a number would be a length [m]
//
//     [dials]
//     hold = 1.5
//
//     [variation]              # from strand to strand
//     bend_stiffness = 0.2
//     seed = 7
//
//     [profile]                # from root to tip: points [share of the arc length, factor]
//     bend_stiffness = [[0, 1], [1, 0.5]]
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/material.h"
#include "ringlet/rest/material_dials.h"

namespace ringlet {

/// The content of a file. The dials are not yet applied to the material.
struct LoadedMaterial {
  Material material;
  MaterialDials dials;
  std::vector<std::string> warnings;  // numbers that are allowed but unusual, a sentence each
};

/// Errors, each with file and line, what was found and what was expected: no such file or not TOML; an
/// unknown key (with the nearest known one); a value of another type or out of its range. If there are
/// several, the topmost is reported.
Result<LoadedMaterial> readMaterial(const std::filesystem::path& path);

/// The same from text; `name` is the file's name in messages.
Result<LoadedMaterial> parseMaterial(std::string_view text, const std::string& name);

/// Loads a preset by its name, or a file if the name ends in .toml.
Result<LoadedMaterial> loadMaterial(const std::string& presetOrFile);

/// Whether loadMaterial treats the name as that of a file.
bool isMaterialFile(const std::filesystem::path& name);

/// TOML with every number and, as comments, its unit, effect and ranges; parseMaterial gives back the same
/// bits.
std::string materialText(const Material& material, const MaterialDials& dials = {});

/// Writes materialText. Errors: as for writeWholeFile; numbers that could not be read back.
Status writeMaterial(const std::filesystem::path& path, const Material& material,
                     const MaterialDials& dials = {});

}  // namespace ringlet
