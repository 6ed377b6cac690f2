// Implements follow/follow_hairs.h.
#include "ringlet/follow/follow_hairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "ringlet/follow/near_guides.h"
#include "ringlet/groom/seeded_random.h"

namespace ringlet {
namespace {

constexpr double kMostRadius = 0.9;     // by which the radius of a curl may differ
constexpr std::size_t kNeighbours = 8;  // roots that bound a guide's part of the scalp
constexpr double kReach = 0.75;         // its largest radius, in the median distance of the neighbours
constexpr std::size_t kMostSeeds = 10;  // tried for each hair
constexpr double kLoneRadius = 0.0025;  // without neighbours [m]
constexpr double kGoldenAngle = 2.399963229728653;  // pi (3 - sqrt 5) [rad]

// Guides that part by less [rad] are blended, by more not: a parting stays one.
constexpr double kBlendedParting = 0.4, kMostParting = 0.8;

// By eye: strays differ in phase and stay off by these factors.
constexpr double kStrayPhase = 2.5, kStraySpread = 1.4;

Status checkOptions(std::span<const GuideRest> guides, const FollowOptions& o) {
  if (guides.empty()) return Error{"there is no guide that hairs could follow"};
  const struct {
    const char* name;
    double value, low, high;
  } ranges[] = {{"the number of hairs", double(o.hairCount), 1, 1e7},
                {"the reach of hairs [m]", o.reach, 1e-6, 1000},
                {"the largest turn of a hair's curl", o.phase, 0, std::numbers::pi},
                {"the variation of the curl radius", o.radius, 0, kMostRadius},
                {"the variation of the length", o.length, 0, 0.9},
                {"the share by which hairs gather", o.gather, 0, 1},
                {"the share of blended guides", o.blend, 0, 1},
                {"the share of strays", o.strayShare, 0, 1},
                {"the frizz of hairs", o.frizz, 0, 10}};
  for (const auto& range : ranges) {
    if (range.value >= range.low && range.value <= range.high) continue;  // false for NaN
    return Error{fmt::format("{} is {}; it must be between {} and {}", range.name, range.value, range.low,
                             range.high)};
  }
  return {};
}

// The roots nearest to each, seen from it, nearest first. Roots are sorted along an axis, and looked through
// to both sides of each until what is left is further off along that axis than those found.
std::vector<std::vector<Vec3d>> neighboursOf(std::span<const GuideRest> guides) {
  std::vector<std::size_t> order(guides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t g) { return guides[g].root.y; });
  std::vector<std::vector<Vec3d>> all(guides.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3d root = guides[order[i]].root;
    std::vector<Vec3d>& found = all[order[i]];
    const auto isBeyond = [&](std::size_t k) {
      return found.size() == kNeighbours && std::abs(guides[order[k]].root.y - root.y) > length(found.back());
    };
    const auto look = [&](std::size_t k) {
      const Vec3d apart = guides[order[k]].root - root;
      if (length(apart) == 0) return;
      const auto at = std::ranges::upper_bound(found, length(apart), {}, [](Vec3d v) { return length(v); });
      found.insert(at, apart);
      if (found.size() > kNeighbours) found.pop_back();
    };
    for (std::size_t k = i; k-- > 0 && !isBeyond(k);) look(k);
    for (std::size_t k = i + 1; k < order.size() && !isBeyond(k); ++k) look(k);
  }
  return all;
}

// Of the plane through a root and those about it: the mean of what pairs of them span. Which side it points
// to is left open. `fallback`: where they span none.
Vec3d normalOf(std::span<const Vec3d> around, Vec3d fallback) {
  Vec3d widest{};
  const auto forEachPair = [&](auto&& use) {
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t k = i + 1; k < around.size(); ++k) use(cross(around[i], around[k]));
  };
  forEachPair([&](Vec3d plane) {
    if (dot(plane, plane) > dot(widest, widest)) widest = plane;
  });
  Vec3d sum{};
  forEachPair([&](Vec3d plane) { sum += plane * (dot(plane, widest) < 0 ? -1.0 : 1.0); });
  return normalizedOr(sum, fallback);
}

// x of M x = b, M symmetric of these columns (Cramer); zero where M is singular but for rounding.
Vec3d solveSymmetric(Vec3d first, Vec3d second, Vec3d third, Vec3d b) {
  const double determinant = dot(first, cross(second, third));
  if (!(std::abs(determinant) > 1e-9 * length(first) * length(second) * length(third))) return {};
  return Vec3d{dot(b, cross(second, third)), dot(first, cross(b, third)), dot(first, cross(second, b))} /
         determinant;
}

// The scalp about a root: the paraboloid z = slopes . (x, y, x^2 + y^2) that fits the roots about it best.
// Its slopes matter at the hairline, where all of them are on one side.
struct ScalpPatch {
  Vec3d across, along, normal;
  Vec3d slopes{};
  double radius = kLoneRadius;
  std::span<const Vec3d> neighbours;

  ScalpPatch(const GuideRest& guide, std::span<const Vec3d> around) : neighbours(around) {
    normal = normalOf(around, guide.frame.tangent);
    across = anyNormal(normal);
    along = cross(normal, across);
    if (around.empty()) return;
    const double unit = length(around[around.size() / 2]);  // so that squares are as large as distances
    Vec3d columns[3]{}, right{};
    for (const Vec3d& v : around) {
      const Vec3d terms = termsAt(dot(v, across) / unit, dot(v, along) / unit);
      right += terms * (dot(v, normal) / unit);
      columns[0] += terms * terms.x;
      columns[1] += terms * terms.y;
      columns[2] += terms * terms.z;
    }
    slopes = solveSymmetric(columns[0], columns[1], columns[2], right);
    slopes.z /= unit;
    radius = kReach * unit;
  }

  static Vec3d termsAt(double x, double y) { return {x, y, x * x + y * y}; }
  Vec3d at(double x, double y) const { return across * x + along * y + normal * dot(slopes, termsAt(x, y)); }
  bool isOwn(Vec3d place) const {
    return std::ranges::all_of(neighbours, [&](Vec3d v) { return dot(place, v) <= 0.5 * dot(v, v); });
  }
};

// `count` places spread evenly over the guide's part of the scalp: a sunflower (Vogel 1979) of just so many
// seeds that enough of them are the guide's own. Where few are, as other roots are much nearer than most, the
// sunflower shrinks.
std::vector<Vec3d> placesOn(const ScalpPatch& patch, double reach, std::size_t count, double firstAngle) {
  std::vector<Vec3d> places;
  double radius = std::min(patch.radius, reach);
  for (std::size_t seeds = count; places.size() < count; seeds += std::max<std::size_t>(1, seeds / 20)) {
    if (seeds > kMostSeeds * count) {
      radius /= 2;
      seeds = count;
    }
    places.clear();
    for (std::size_t k = 0; k < seeds && places.size() < count; ++k) {
      const double distance = radius * std::sqrt((double(k) + 0.5) / double(seeds));
      const double angle = firstAngle + kGoldenAngle * double(k);
      const Vec3d place = patch.at(distance * std::cos(angle), distance * std::sin(angle));
      if (patch.isOwn(place) && length(place) <= reach) places.push_back(place);
    }
  }
  return places;
}

// clump: a factor on what hairs gather.
FollowHair variedHair(const FollowOptions& options, double clump, SeededRandom random) {
  // Always the same draws in the same order, so that one option does not change the others.
  const bool isStray = random.uniform() < options.frizz * options.strayShare;
  const double turn = random.uniform() + random.uniform() - 1;  // triangular
  const double wider = random.between(-1, 1), shorter = random.uniform(),
               together = random.between(-0.2, 2.2);
  FollowHair hair;
  const double phase = std::min(options.frizz * options.phase, std::numbers::pi),
               radius = std::min(options.frizz * options.radius, kMostRadius);
  hair.phase = static_cast<float>(turn * phase * (isStray ? kStrayPhase : 1));
  hair.radius = static_cast<float>(1 + radius * wider);
  hair.length = static_cast<float>(1 - options.length * shorter);
  hair.spread = static_cast<float>(
      isStray ? kStraySpread : std::max(0.0, 1 - std::min(1.0, clump * options.gather) * together));
  return hair;
}

double factorAt(std::span<const float> map, std::size_t guide) {
  return map.empty() ? 1.0 : static_cast<double>(map[guide]);
}
double factorAt(std::span<const float> map, const std::array<NearGuides::Share, 3>& shares) {
  if (map.empty()) return 1;
  double factor = 0;
  for (const NearGuides::Share& each : shares) factor += each.share * factorAt(map, each.guide);
  return factor;
}

// Up to which hair each guide has them: the same numbers, or less where the density is less.
std::vector<std::size_t> lastHairs(std::size_t guideCount, std::size_t hairCount,
                                   std::span<const float> density) {
  std::vector<std::size_t> last;
  double sum = 0;
  for (std::size_t g = 0; g < guideCount; ++g) {
    sum += std::min(1.0, factorAt(density, g));
    last.push_back(density.empty() ? (g + 1) * hairCount / guideCount
                                   : static_cast<std::size_t>(sum * static_cast<double>(hairCount) /
                                                              static_cast<double>(guideCount)));
  }
  return last;
}

Vec3f seenFrom(const MeasuringFrame& frame, Vec3d v) {
  return Vec3f(Vec3d{dot(v, frame.normal), dot(v, frame.binormal), dot(v, frame.tangent)});
}

// Of a root beside its guide.
void standOn(const GuideRest& guide, std::size_t number, Vec3d place, FollowHair& hair) {
  hair.guide = static_cast<std::uint32_t>(number);
  hair.offset = seenFrom(guide.frame, place);
}

// 1 for guides side by side, 0 for those that part; pieces of one that is cut go ways of their own.
double togetherness(const GuideRest& a, const GuideRest& b) {
  if (!a.pieces.empty() || !b.pieces.empty()) return 0;
  const double apart =
      std::clamp((partingOf(a, b) - kBlendedParting) / (kMostParting - kBlendedParting), 0.0, 1.0);
  return 1 - apart * apart * (3 - 2 * apart);
}

// The guides nearest to a hair's root but its own, which is one of the nearest, take their shares of its
// core.
void blendWith(std::span<const GuideRest> guides, const std::array<NearGuides::Share, 3>& shares, Vec3d root,
               double blend, FollowHair& hair) {
  auto other = hair.others.begin();
  for (const NearGuides::Share& each : shares) {
    if (each.guide == hair.guide || other == hair.others.end()) continue;
    const GuideRest& guide = guides[each.guide];
    const double share = blend * each.share * togetherness(guides[hair.guide], guide);
    if (share > 0)
      *other++ = {each.guide, static_cast<float>(share), seenFrom(guide.frame, root - guide.root)};
  }
}

Status checkCount(std::size_t hairCount) {
  return hairCount > 0 ? Status() : Status(Error{"the map of density leaves no hair; ask for more hairs"});
}

}  // namespace

Result<std::vector<FollowHair>> planHairs(std::span<const GuideRest> guides, const ScalpRoots& roots,
                                          const FollowOptions& options, const FollowMaps& maps,
                                          std::vector<std::uint32_t>* rootOf) {
  if (Status checked = checkOptions(guides, options); !checked) return checked.error();
  const NearGuides near(guides);
  std::vector<std::pair<FollowHair, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < roots.places.size(); ++i) {
    const auto shares = near.sharesAt(roots.places[i]);
    if (!maps.density.empty() && roots.ranks[i] > factorAt(maps.density, shares)) continue;
    FollowHair hair = variedHair(options, factorAt(maps.clump, shares), SeededRandom(options.seed, i));
    const GuideRest& guide = guides[shares[0].guide];
    standOn(guide, shares[0].guide, roots.places[i] - guide.root, hair);
    if (options.blend > 0) blendWith(guides, shares, roots.places[i], options.blend, hair);
    found.emplace_back(hair, i);
  }
  if (Status some = checkCount(found.size()); !some) return some.error();
  std::ranges::stable_sort(found, {}, [](const auto& each) { return each.first.guide; });
  std::vector<FollowHair> hairs;
  if (rootOf) rootOf->clear();
  for (const auto& [hair, root] : found) {
    hairs.push_back(hair);
    if (rootOf) rootOf->push_back(root);
  }
  return hairs;
}

Result<std::vector<FollowHair>> planHairs(std::span<const GuideRest> guides, const FollowOptions& options,
                                          const FollowMaps& maps) {
  if (Status checked = checkOptions(guides, options); !checked) return checked.error();
  const auto neighbours = neighboursOf(guides);
  const auto hairCount = static_cast<std::size_t>(options.hairCount);
  const std::vector<std::size_t> last = lastHairs(guides.size(), hairCount, maps.density);
  if (Status some = checkCount(last.back()); !some) return some.error();
  const std::optional<NearGuides> near = options.blend > 0 ? std::optional<NearGuides>(guides) : std::nullopt;
  std::vector<FollowHair> hairs;
  hairs.reserve(last.back());
  for (std::size_t g = 0; g < guides.size(); ++g) {
    const std::size_t count = last[g] - (g > 0 ? last[g - 1] : 0);
    const ScalpPatch patch(guides[g], neighbours[g]);
    const double firstAngle = SeededRandom(options.seed, g).between(0, 2 * std::numbers::pi);
    for (const Vec3d& place : placesOn(patch, options.reach, count, firstAngle)) {
      FollowHair hair = variedHair(options, factorAt(maps.clump, g),
                                   SeededRandom(options.seed, guides.size() + hairs.size()));
      standOn(guides[g], g, place, hair);
      const Vec3d root = guides[g].root + place;
      if (near) blendWith(guides, near->sharesAt(root), root, options.blend, hair);
      hairs.push_back(hair);
    }
  }
  return hairs;
}

// Point i of a shorter hair lags behind particle i of its guide, but for the root
// (reference/equations/follow.h).
std::size_t pointsBefore(std::size_t begin, const FollowHair& hair, std::size_t points,
                         std::span<const OwnPoint> own) {
  const auto along = [&](std::size_t i) {
    if (!own.empty()) return static_cast<double>(own[i].along);
    const double share = static_cast<double>(i) / static_cast<double>(points - 1);
    const double rise = std::min(share / 0.2, 1.0);
    return static_cast<double>(i) *
           (1 + (static_cast<double>(hair.length) - 1) * rise * rise * (3 - 2 * rise));
  };
  std::size_t i = 0;
  while (i < points && along(i) < static_cast<double>(begin) - 0.5) ++i;
  return i;
}

}  // namespace ringlet
