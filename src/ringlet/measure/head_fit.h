// fitHeadRotation: how the head has turned, from the roots it carries, for files that do not say.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// The rotation that takes the rest roots to the roots best, both seen from their means (least squares, Horn
/// 1987). Where the roots leave it open (one root, or all on a line) the smallest of those that fit. As many
/// roots as rest roots, finite. Cost: one pass.
Quatd fitHeadRotation(std::span<const Vec3d> restRoots, std::span<const Vec3d> roots);

}  // namespace ringlet
