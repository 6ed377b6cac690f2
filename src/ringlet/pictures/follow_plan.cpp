// Implements follow_plan.h.
#include "ringlet/pictures/follow_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

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

Result<FollowPlan> FollowPlan::make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                    const HairGround& ground, const CutList& cuts) {
  FollowPlan plan;
  plan.metresPerUnit_ = metresPerUnit;
  plan.firstPoint_ = rest.firstPoint;
  const auto pieces = cuts.pieces();
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const std::vector<Vec3d> strand = plan.strandOf(rest.points, s);
    if (!(lengthOf(strand) > 0))
      return Error{fmt::format(
          "strand {} of the groom has no length, so that no hair can follow it; `ringlet info --fix` drops "
          "such strands",
          s + 1)};
    plan.guides_.push_back(restOfGuide(strand));
    const auto cut = pieces.find(static_cast<std::uint32_t>(s));
    if (cut == pieces.end()) continue;
    std::ranges::copy_if(cut->second, std::back_inserter(plan.guides_.back().pieces),
                         [&](std::uint32_t first) { return first > 0 && first < strand.size(); });
  }
  if (Status planted = plan.plant(options, ground); !planted) return planted.error();

  std::uint64_t points = 0;
  for (const FollowHair& each : plan.hairs_) points += plan.guides_[each.guide].arcs.size();
  if (points > std::numeric_limits<std::uint32_t>::max())
    return Error{fmt::format("{} hairs have {} points; at most {} can be numbered", plan.hairs_.size(),
                             points, std::numeric_limits<std::uint32_t>::max())};
  plan.firstHairPoint_ = {0};
  for (const FollowHair& each : plan.hairs_)
    plan.firstHairPoint_.push_back(plan.firstHairPoint_.back() +
                                   static_cast<std::uint32_t>(plan.guides_[each.guide].arcs.size()));
  return plan;
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
