// The rigid motion of points: of a head from its roots, for files that do not contain it, and of the part of
// a mesh that does not bend.
#pragma once

#include <span>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

/// The rotation that best takes the rest roots to the roots, each relative to their mean (least squares, Horn
/// 1987). If the roots do not determine it (one root, or all on a line), the smallest best rotation. As many
/// roots as rest roots, all finite. Cost: one pass.
Quatd fitHeadRotation(std::span<const Vec3d> restRoots, std::span<const Vec3d> roots);

/// The rigid motion that as many of the points as can be share: the least sum of square roots of distances,
/// so that a part that bends hardly turns what the rest agrees on (iteratively reweighted least squares, from
/// equal weights). The position is that of the mean of `rest`. As many points as at rest, all finite. Cost:
/// twenty passes.
HeadPose fitSharedMotion(std::span<const Vec3d> rest, std::span<const Vec3d> points);

}  // namespace ringlet
