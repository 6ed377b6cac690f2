// fitHeadRotation: the rotation of the head, estimated from its roots, for files that do not contain it.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// The rotation that best takes the rest roots to the roots, each relative to their mean (least squares, Horn
/// 1987). If the roots do not determine it (one root, or all on a line), the smallest best rotation. As many
/// roots as rest roots, all finite. Cost: one pass.
Quatd fitHeadRotation(std::span<const Vec3d> restRoots, std::span<const Vec3d> roots);

}  // namespace ringlet
