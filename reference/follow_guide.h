// Hairs that follow guides through a pose: each guide's core, frames and curl, then each hair's points.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "reference/equations/follow.h"
#include "ringlet/base/vec3.h"
#include "ringlet/follow/follow_hairs.h"
#include "ringlet/scene/body.h"

namespace ringlet::reference {

/// A guide in a pose.
struct GuidePose {
  std::vector<GuidePlace<double>> places;  // one a particle
  Rotation<double> rootFrame;              // the frame at rest, carried by the head
  std::vector<std::uint32_t> pieces{};     // GuideRest's
};

/// `positions` [m]: one a particle, in the world or relative to the head's origin alike. `head`: how the head
/// has turned since the rest pose.
GuidePose poseGuide(const GuideRest& rest, std::span<const Vec3d> positions, Quatd head);

/// Those of FollowHair::others; none where its share is 0.
using OtherPoses = std::array<const GuidePose*, 2>;

/// Bodies as hairs that follow meet them: each that bends has the grid of its points, seen from what carries
/// it [m], or as before the first frame where there are none; of cloth a grain.
std::vector<Body> bodiesMetAt(std::span<const Body> bodies, std::span<const std::vector<Vec3d>> points);

/// The points of a hair [m]: `own`, or where it is empty as many as its guide's; out of bodies at `poses`,
/// one a body. `rootOnScalp`: where its root is in this pose [m]; none: where the head carries it.
std::vector<Vec3d> followGuide(const FollowHair& hair, const GuidePose& guide,
                               std::span<const Body> bodies = {}, std::span<const BodyPose> poses = {},
                               std::optional<Vec3d> rootOnScalp = std::nullopt, const OtherPoses& others = {},
                               std::span<const OwnPoint> own = {});

/// The same with all guides' poses.
std::vector<Vec3d> followGuides(const FollowHair& hair, std::span<const GuidePose> guides,
                                std::span<const Body> bodies = {}, std::span<const BodyPose> poses = {},
                                std::optional<Vec3d> rootOnScalp = std::nullopt,
                                std::span<const OwnPoint> own = {});

/// How many points of a hair, `own` or of as many as its guide has, are before the piece of the guide that
/// begins with particle `begin`.
std::size_t pointsBefore(std::size_t begin, const FollowHair& hair, std::size_t points,
                         std::span<const OwnPoint> own = {});

}  // namespace ringlet::reference
