// Hairs that follow guides: where each stands beside its guide, and how its curl differs. A few hundred or
// thousand guides are simulated; what one sees are tens of thousands of hairs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/follow/guide_rest.h"
#include "ringlet/follow/scalp_roots.h"

namespace ringlet {

/// A hair has as many points as its guide, or its own (OwnPoints). reference/equations/follow.h says where
/// they are.
struct FollowHair {
  std::uint32_t guide = 0;
  Vec3f offset{};    // of its root from the guide's, along GuideRest::frame: normal, binormal, tangent [m]
  float phase = 0;   // by which the guide's curl is turned about its core [rad]
  float radius = 1;  // of its curl, over the guide's
  float length = 1;  // share of the guide that it follows, in (0, 1]
  float spread = 1;  // what becomes of the offset beyond the root: below 1 hairs of a guide gather

  /// Another guide whose core is blended with the guide's; the hair has its guide's curl.
  struct Other {
    std::uint32_t guide = 0;
    float share = 0;  // of the core, in [0, 1]; what the two leave of 1 is the guide's. 0: nothing
    Vec3f offset{};   // of the hair's root from this guide's, along its frame [m]
  };
  std::array<Other, 2> others{};
};

/// A point of a hair with its own shape at rest.
struct OwnPoint {
  Vec3f shift{};    // q, from where the guide alone would have it at rest, along the frame beside it [m]
  float along = 0;  // its place on the guide [particles]
};

/// Points of hairs that have their own, each hair at least two, rising along their guides.
struct OwnPoints {
  std::vector<std::uint32_t> firstPoint;  // of each hair, and one more; empty: all have their guides' points
  std::vector<OwnPoint> points;

  bool empty() const { return firstPoint.empty(); }
  std::span<const OwnPoint> of(std::size_t hair) const {
    if (empty()) return {};
    return std::span(points).subspan(firstPoint[hair], firstPoint[hair + 1] - firstPoint[hair]);
  }
};

/// How hairs of one guide differ. `blend` is of guides side by side: less of those that part at rest by 0.4
/// to 0.8 radians (partingOf), nothing of others, nor of guides that are cut (GuideRest::pieces).
struct FollowOptions {
  int hairCount = 30000;    // in [1, 10000000]
  double reach = 1;         // largest distance of a root from the guide's [m], above 0, to 1000
  double phase = 0.45;      // largest turn of a curl [rad], in [0, pi]; small turns are more frequent
  double radius = 0.12;     // largest relative difference of a curl's radius, in [0, 0.9]
  double length = 0.15;     // share by which the shortest hair is shorter, in [0, 0.9]
  double gather = 0.25;     // mean share by which hairs come together, in [0, 1]
  double strayShare = 0.1;  // share of hairs, in [0, 1], that keep apart and whose phase differs more
  double blend = 0;         // share, in [0, 1], of what the two next guides have in a hair's core
  double frizz = 1;         // factor on phase, radius and strayShare up to their limits, in [0, 10]
  std::uint64_t seed = 1;
};

/// Factors of each guide; empty: 1 everywhere.
struct FollowMaps {
  std::span<const float> density;  // share of the hairs that are there, in [0, 1]; above 1 counts as 1
  std::span<const float> clump;    // on FollowOptions::gather, up to all of it
};

/// Hairs of all guides, those of a guide one after the other, as many of each as of any other, or one more.
/// Roots are spread evenly over the guide's part of the scalp: where no other guide's root is nearer, and not
/// beyond `reach`. The scalp there is the paraboloid through the roots about it. Errors: an option outside
/// its range; no guide. Cost: guides^1.5, and with hairs.
Result<std::vector<FollowHair>> planHairs(std::span<const GuideRest> guides, const FollowOptions& options,
                                          const FollowMaps& maps = {});

/// The same with these roots in place of hairCount and reach. Each follows the guide nearest to it. Maps have
/// what they have at guides, and between them what is between. `rootOf`: the root of each hair, where one is
/// to know.
Result<std::vector<FollowHair>> planHairs(std::span<const GuideRest> guides, const ScalpRoots& roots,
                                          const FollowOptions& options, const FollowMaps& maps = {},
                                          std::vector<std::uint32_t>* rootOf = nullptr);

/// How many points a hair has: `own`, or as many as its guide.
inline std::size_t pointCountOf(const FollowHair& hair, std::span<const GuideRest> guides,
                                std::span<const OwnPoint> own) {
  return own.empty() ? guides[hair.guide].arcs.size() : own.size();
}

/// How many points of a hair, `own` or of as many as its guide has, are before the piece of the guide that
/// begins with particle `begin`.
std::size_t pointsBefore(std::size_t begin, const FollowHair& hair, std::size_t points,
                         std::span<const OwnPoint> own = {});

}  // namespace ringlet
