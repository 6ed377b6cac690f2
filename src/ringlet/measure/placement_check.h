// Checks that a groom and its bodies have plausible sizes and places: a wrong unit or place otherwise only
// shows as hair that behaves oddly.
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

/// Plausible range of the mean length of strands [m].
inline constexpr double kLeastMeanLength = 0.01, kMostMeanLength = 2;

/// A sentence for each doubt, with its likely cause and its remedy; none for a plausible groom. `head`: the
/// head's pose. Of bodies only those that the head carries are checked, without planes, since others move
/// freely. Cost: linear in particles, and in roots times bodies.
std::vector<std::string> checkPlacement(const Groom& groom, std::span<const Body> bodies,
                                        const HeadPose& head);

/// Mean length of a groom's strands [m].
double meanLength(const Groom& groom);

/// A sentence about strands that run from tip to root, judged by the bodies that the head carries.
std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const Body> bodies,
                                         const HeadPose& head);

/// A sentence if strands have their tips on the surface that roots should be on, `what`, and their roots off
/// it. ends: the distance of each strand's both ends (strandEnds) from it [m].
std::optional<std::string> checkRootEnds(const Groom& groom, std::span<const EndDistances> ends,
                                         const std::string& what);

}  // namespace ringlet
