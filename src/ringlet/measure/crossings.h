// Counts how often hairs passed through each other between two states. Contacts exist to prevent this.
#pragma once

#include <cstdint>
#include <span>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// How often an edge of one strand passed through an edge of another, if every particle moves straight and
/// evenly from `before` to `after`. Two edges pass where the signed volume of their four ends changes sign
/// while they cut each other; twice in one step is two crossings. Edges that stay in one plane, or only
/// touch, do not pass. If each step begins where the last one ended, no crossing is counted twice or lost.
///
/// firstPoint: Groom::firstPoint; before, after: all particles, in groom order. bundles: of each strand;
/// strands of one bundle may pass through each other, 0 is no bundle; empty: no strand has one. Edges with a
/// particle that is not finite cross nothing. Cost: linear in edges and overlaps of the boxes they sweep.
std::uint64_t countCrossings(std::span<const std::uint32_t> firstPoint, std::span<const Vec3f> before,
                             std::span<const Vec3f> after, std::span<const std::uint32_t> bundles = {});

}  // namespace ringlet
