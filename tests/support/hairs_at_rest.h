// Where the hairs of a groom are while the guides they follow are at rest, by the reference.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "reference/follow_guide.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/follow/level_of_detail.h"
#include "ringlet/groom/groom.h"

namespace ringlet::test {

inline std::vector<Vec3d> metresOf(const Groom& groom, std::size_t strand) {
  std::vector<Vec3d> points;
  for (const Vec3f& p : groom.strand(strand)) points.push_back(Vec3d(p) * groom.metresPerUnit);
  return points;
}

/// The farthest that a point of a hair is from its place in the whole groom [m].
inline double farthestAtRest(const LevelOfDetail& level, const Groom& whole) {
  std::vector<reference::GuidePose> poses;
  for (std::size_t g = 0; g < level.groom.strandCount(); ++g) {
    const std::vector<Vec3d> guide = metresOf(level.groom, g);
    poses.push_back(reference::poseGuide(restOfGuide(guide), guide, {}));
  }
  EXPECT_EQ(level.hairs.size(), whole.strandCount());
  EXPECT_EQ(level.own.firstPoint, whole.firstPoint);
  double farthest = 0;
  for (std::size_t s = 0; s < whole.strandCount(); ++s) {
    const std::vector<Vec3d> wanted = metresOf(whole, s);
    const auto found = reference::followGuides(level.hairs[s], poses, {}, {}, std::nullopt, level.own.of(s));
    for (std::size_t i = 0; i < wanted.size(); ++i)
      farthest = std::max(farthest, length(found[i] - wanted[i]));
  }
  return farthest;
}

}  // namespace ringlet::test
