// Implements follow_plan.h.
#include "ringlet/pictures/follow_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "ringlet/follow/rest_shape.h"
#include "ringlet/measure/head_fit.h"

namespace ringlet {
namespace {

// A pose in which a strand is longer or shorter by more than this factor is of another groom, or in another
// unit.
constexpr double kMostLonger = 3;

double lengthOf(std::span<const Vec3d> strand) {
  double sum = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) sum += length(strand[i] - strand[i - 1]);
  return sum;
}

}  // namespace

std::vector<Vec3d> FollowPlan::strandOf(std::span<const Vec3f> points, std::size_t strand) const {
  std::vector<Vec3d> metres;
  for (std::uint32_t i = firstPoint_[strand]; i < firstPoint_[strand + 1]; ++i)
    metres.push_back(Vec3d(points[i]) * metresPerUnit_);
  return metres;
}

Status FollowPlan::plant(const FollowOptions& options, const HairGround& ground) {
  const FollowMaps maps{ground.densities, ground.clumps};
  if (!ground.mesh) {
    auto hairs = planHairs(guides_, options, maps);
    if (!hairs) return hairs.error();
    hairs_ = std::move(*hairs);
    return {};
  }
  const auto roots = scatterRoots(*ground.mesh, guides_, options.hairCount, options.seed);
  if (!roots) return roots.error();
  std::vector<std::uint32_t> rootOf;
  auto hairs = planHairs(guides_, *roots, options, maps, &rootOf);
  if (!hairs) return hairs.error();
  hairs_ = std::move(*hairs);
  if (!ground.scalp) return {};
  for (const std::uint32_t root : rootOf) roots_.push_back(roots->places[root]);
  auto bound = ground.scalp->bindOthers(roots_);
  if (!bound) return bound.error();
  scalp_.emplace(std::move(*bound));
  return {};
}

std::vector<Vec3d> FollowPlan::rootsAt(double t, const HeadPose& head) const {
  return scalp_ ? scalp_->placesAt(t, head, roots_) : std::vector<Vec3d>();
}

Status FollowPlan::takeStrands(const Groom& rest, double metresPerUnit, const CutList& cuts) {
  metresPerUnit_ = metresPerUnit;
  firstPoint_ = rest.firstPoint;
  const auto pieces = cuts.pieces();
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const std::vector<Vec3d> strand = strandOf(rest.points, s);
    if (!(lengthOf(strand) > 0))
      return Error{fmt::format(
          "strand {} of the groom has no length, so that no hair can follow it; `ringlet info --fix` drops "
          "such strands",
          s + 1)};
    guides_.push_back(restOfGuide(strand));
    const auto cut = pieces.find(static_cast<std::uint32_t>(s));
    if (cut == pieces.end()) continue;
    std::ranges::copy_if(cut->second, std::back_inserter(guides_.back().pieces),
                         [&](std::uint32_t first) { return first > 0 && first < strand.size(); });
  }
  return {};
}

Status FollowPlan::numberPoints() {
  std::uint64_t points = 0;
  firstHairPoint_ = {0};
  for (std::size_t h = 0; h < hairs_.size(); ++h) {
    points += pointCountOf(hairs_[h], guides_, own_.of(h));
    firstHairPoint_.push_back(static_cast<std::uint32_t>(points));
  }
  if (points <= std::numeric_limits<std::uint32_t>::max()) return {};
  return Error{fmt::format("{} hairs have {} points; at most {} can be numbered", hairs_.size(), points,
                           std::numeric_limits<std::uint32_t>::max())};
}

Result<FollowPlan> FollowPlan::make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                    const HairGround& ground, const CutList& cuts) {
  FollowPlan plan;
  if (Status taken = plan.takeStrands(rest, metresPerUnit, cuts); !taken) return taken.error();
  if (Status planted = plan.plant(options, ground); !planted) return planted.error();
  if (Status numbered = plan.numberPoints(); !numbered) return numbered.error();
  return plan;
}

// All hairs of a groom of which the guides are simulated.
Result<FollowPlan> FollowPlan::ofGroom(const LoadedScene& scene) {
  FollowPlan plan;
  if (Status taken = plan.takeStrands(scene.groom, scene.groom.metresPerUnit, {}); !taken)
    return taken.error();
  plan.hairs_ = scene.level->hairs;
  plan.own_ = scene.level->own;
  plan.guideStrands_ = scene.level->guides;
  if (Status numbered = plan.numberPoints(); !numbered) return numbered.error();
  if (!scene.scalp || !scene.rootShifts.empty()) return plan;
  for (const FollowHair& hair : plan.hairs_) {
    const GuideRest& guide = plan.guides_[hair.guide];
    plan.roots_.push_back(guide.root + outOfFrame(guide.frame, Vec3d(hair.offset)));
  }
  auto bound = scene.scalp->bindOthers(plan.roots_);
  if (!bound) return bound.error();
  plan.scalp_.emplace(std::move(*bound));
  return plan;
}

Result<std::optional<FollowPlan>> FollowPlan::ofScene(const LoadedScene& scene, int hairs,
                                                      const HairLook& look, const CutList& cuts) {
  if (hairs == 0 && !scene.level) return std::optional<FollowPlan>();
  const auto planned = [&]() -> Result<FollowPlan> {
    if (hairs == 0) return ofGroom(scene);
    const auto ground = hairGroundOf(scene, look);
    if (!ground) return ground.error();
    return make(scene.groom, scene.groom.metresPerUnit, look.of({.hairCount = hairs}), *ground, cuts);
  };
  auto plan = planned();
  if (!plan) return plan.error();
  return std::optional(std::move(*plan));
}

Status FollowPlan::checkPose(const Groom& groom) const {
  if (groom.firstPoint != firstPoint_)
    return Error{fmt::format(
        "the groom has {} strands of {} particles in all, the animation {} of {}: they do not belong "
        "together",
        guides_.size(), firstPoint_.back(), groom.strandCount(), groom.firstPoint.back())};
  double now = 0, atRest = 0;
  for (std::size_t s = 0; s < guides_.size(); ++s) {
    now += lengthOf(strandOf(groom.points, s));
    atRest += guides_[s].arcs.back();
  }
  if (now > kMostLonger * atRest || atRest > kMostLonger * now)
    return Error{fmt::format(
        "the animation's strands are {:.3g} times as long as the groom's: one of them is in another unit",
        now / atRest)};
  return {};
}

Quatd FollowPlan::headOf(std::span<const Vec3f> points) const {
  std::vector<Vec3d> restRoots, roots;
  for (std::size_t s = 0; s < guides_.size(); ++s) {
    restRoots.push_back(guides_[s].root);
    roots.push_back(Vec3d(points[firstPoint_[s]]) * metresPerUnit_);
  }
  return fitHeadRotation(restRoots, roots);
}

}  // namespace ringlet
