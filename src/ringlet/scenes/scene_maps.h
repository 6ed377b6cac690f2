// Maps of a scene: factors on numbers of the material, strand by strand. [[map]] of a scene file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scenes/scene_file.h"

namespace ringlet {

/// Greatest number of a strand that a map may name.
inline constexpr std::uint32_t kMostMappedStrand = 20'000'000;

/// The numbers of a material that may differ from strand to strand.
std::span<const Parameter<Material>> mappedParameters();

/// First and last of some strands, in groom order from 0.
struct StrandRange {
  std::uint32_t first = 0, last = 0;
};

/// "0:99, 120": ranges and single strands. Errors: the word that is none.
Result<std::vector<StrandRange>> parseStrands(std::string_view text);

/// Lines "strand,factor" in any order; empty lines and what follows a # are left out, and so is a first line
/// without a number. Strands without a line keep 1. Errors: the line, what was found and what was expected; a
/// strand that is there twice.
Result<std::vector<float>> parseStrandFactors(std::string_view text);

/// Puts what maps say of a material into its `factors`; several on one number multiply. Errors: a file that
/// cannot be read; a preset that needs what the material has none of.
Status addMaps(std::span<const SceneMap> maps, Material& material);

}  // namespace ringlet
