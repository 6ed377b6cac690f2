// What there is to doubt of a motion file's unit, up axis and frames: sentences for a person, each with what
// mends it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/motion/bvh_file.h"
#include "ringlet/motion/bvh_stance.h"
#include "ringlet/motion/gltf_file.h"

namespace ringlet {

inline constexpr double kTall = 1.7;  // a person whose file names no unit [m]

/// Metres per unit of a BVH file that names none: its person is kTall; a centimetre where it is one point.
double unitOf(const BvhStance& stance);

/// Of a file called `name`. metresPerUnit: as stated; `upIsZ`: of the groom.
std::vector<std::string> doubtsOf(const BvhFile& file, const BvhStance& stance, const std::string& name,
                                  std::optional<double> metresPerUnit, bool upIsZ);

/// Of a node that is a head. The figure is what is below it, from parent to parent, without steps that are
/// far longer than all below them, which place a character in a world. `statesUp`: that the placement's up
/// axis was given. Cost: a hundred looks at the node and its parents.
std::vector<std::string> doubtsOf(const GltfFile& file, std::size_t node, const GltfAnimation* animation,
                                  const GltfPlacement& placement, bool statesUp, const std::string& name);

}  // namespace ringlet
