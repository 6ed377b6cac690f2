// Writers need finite numbers: one NaN makes most programs drop or refuse the whole groom.
#pragma once

#include <cstddef>
#include <span>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

bool areFinite(std::span<const Vec3f> points);

/// Moves every particle that has no finite position to the last finite one before it on its strand, so that
/// the strand ends there (a root without position goes to the origin). Returns how many it moved.
std::size_t replaceNonfinite(const Groom& topology, std::span<Vec3f> points);

}  // namespace ringlet
