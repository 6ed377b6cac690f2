// Crossings: hairs that went through each other between two states. Contacts exist so that there are none.
#pragma once

#include <cstdint>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// How often an edge of one strand passed through an edge of another while every particle went straight and
/// evenly from `before` to `after`. Two edges pass where the signed volume of their four ends changes its
/// sign while they cut each other; twice in one step is two crossings. Edges that stay in one plane, or only
/// touch, do not pass. Over the steps of a motion, of which each begins where the last one ended, none is
/// counted twice or lost.
///
/// firstPoint: Groom::firstPoint; before, after: all particles, in groom order. bundles: of each strand,
/// those of one pass through each other uncounted, 0 is none; empty: all are. Edges with a particle that is
/// not finite cross nothing. Cost: linear in edges and overlaps of the boxes they sweep.
std::uint64_t countCrossings(std::span<const std::uint32_t> firstPoint, std::span<const Vec3f> before,
                             std::span<const Vec3f> after, std::span<const std::uint32_t> bundles = {});

}  // namespace ringlet
