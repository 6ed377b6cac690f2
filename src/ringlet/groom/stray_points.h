// Particles that an exporter put where no hair is: at the origin, say, or in one place of all strands.
#pragma once

#include <span>
#include <vector>

#include "ringlet/groom/groom.h"

namespace ringlet {

/// A particle in a place that several strands share, or at the origin, is a stray where every edge to it is
/// longer than its strand's median by this factor. Real grooms have edges up to 3.6 times as long.
inline constexpr double kStrayEdge = 4;
/// And one in any place where they are longer than its strand's upper edge by this: a number such as 99999
/// that stands for no place. Only of strands with three edges and more.
inline constexpr double kFarEdge = 100;

/// For each particle whether another strand has one in the very same place. Strands that repeat one before
/// count as that one. Cost: n log n in the particles.
std::vector<bool> sharedPlaces(const Groom& groom, const std::vector<bool>& isDuplicate);

/// For each particle whether it is such a stray. Two particles of a strand are none at least. Cost: linear in
/// the particles, times the logarithm of the strays.
std::vector<bool> strayPoints(const Groom& groom);

/// Of a strand's edges that have a length (kNoEdgeShare), the lower of two in the middle; 0 without any.
double medianEdge(std::span<const Vec3f> strand);

/// Than which three of four are no longer, of a strand's edges that are not 0; 0 without any.
double upperEdge(std::span<const Vec3f> strand);

}  // namespace ringlet
