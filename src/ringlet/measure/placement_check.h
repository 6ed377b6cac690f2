// Whether a groom and what it stays out of have the sizes and places of hair and a head: a wrong unit or
// place otherwise shows as hair that behaves oddly.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/root_ends.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

/// Strands shorter or longer than this on average are no hair [m].
inline constexpr double kLeastMeanLength = 0.01, kMostMeanLength = 2;

/// A sentence for each doubt, with its likely cause and what mends it; none for a groom that fits. At the
/// head's pose `head`. Of bodies only those that the head carries, less planes: others come and go. Cost: a
/// look at each particle, and at each root and body.
std::vector<std::string> checkPlacement(const Groom& groom, std::span<const Body> bodies,
                                        const HeadPose& head);

/// Of a groom's strands [m].
double meanLength(const Groom& groom);

/// A sentence about strands that run from tip to root, by the bodies that the head carries.
std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const Body> bodies,
                                         const HeadPose& head);

/// A sentence where strands of the groom end on what roots belong on, `what`, and begin off it: from how far
/// both ends of each (strandEnds) are from it [m].
std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const EndDistances> ends,
                                         const std::string& what);

}  // namespace ringlet
