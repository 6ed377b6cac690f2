// Maps of a scene: factors on numbers of the material, strand by strand. [[map]] of a scene file.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/material_parameters.h"
#include "ringlet/scenes/file/scene_file.h"

namespace ringlet {

/// Greatest number of a strand that a map may name.
inline constexpr std::uint32_t kMostMappedStrand = 1'000'000'000;

/// The numbers of a material that may differ from strand to strand.
std::span<const Parameter<Material>> mappedParameters();

/// "0:99, fringe": runs of strands in groom order from 0, and those of groups by name, each with this factor;
/// rising. Errors: the word that is neither, a strand that is there twice.
Result<std::vector<StrandRun>> parseStrands(std::string_view text, double factor,
                                            std::span<const SceneGroup> groups = {});

/// Lines "strand,factor" in any order; empty lines and what follows a # are left out, and so is a first line
/// that begins with a letter. Rising. Errors: the line, what was found and what was expected; a strand that
/// is there twice.
Result<std::vector<StrandRun>> parseStrandFactors(std::string_view text);

/// In place of a number of the material: the strength of the goal, the radius in contacts, the width of what
/// is drawn and written, and of hairs that follow, how many there are and how they come together.
inline constexpr const char* kGoalStrengthMap = "goal.strength";
inline constexpr const char* kContactRadiusMap = "contacts.radius";
inline constexpr const char* kWidthMap = "output.width";
inline constexpr const char* kHairsMap = "output.hairs";
inline constexpr const char* kClumpMap = "output.clump";
inline constexpr std::string_view kOtherMaps[] = {kGoalStrengthMap, kContactRadiusMap, kWidthMap, kHairsMap,
                                                  kClumpMap};

/// Whether a map is of a number of the material, or of a preset.
inline bool isOfMaterial(const SceneMap& map) {
  return std::ranges::find(kOtherMaps, map.number) == std::ranges::end(kOtherMaps);
}

/// Whether the strands and factors of a map can be read. Errors: those of applyMaps.
Status checkStrands(const SceneMap& map, const SceneFile& scene);

/// Factors of one of these by strand, groom order; empty: no map is of it. Errors: those of applyMaps,
/// and a strand that the groom does not have.
Result<std::vector<float>> factorsOf(std::string_view number, const SceneFile& scene,
                                     std::size_t strandCount);

/// Sets the `factors` of a material to what maps of a scene say; those of other numbers are left out. Errors:
/// a file that cannot be read, that of the groom too where a map is of its primvars; a preset that needs what
/// the material has none of.
Status applyMaps(std::span<const SceneMap> maps, const SceneFile& scene, Material& material);

}  // namespace ringlet
