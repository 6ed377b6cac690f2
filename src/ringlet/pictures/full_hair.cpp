// Implements full_hair.h.
#include "ringlet/pictures/full_hair.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace ringlet {

Result<FullHair> FullHair::make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                const FollowMoverMaker& makeMover, std::span<const Body> bodies,
                                const HairGround& ground, const CutList& cuts) {
  auto plan = FollowPlan::make(rest, metresPerUnit, options, ground, cuts);
  if (!plan) return plan.error();
  return of(std::move(*plan), rest, makeMover, bodies);
}

Result<std::optional<FullHair>> FullHair::ofScene(const LoadedScene& scene, int hairs, const HairLook& look,
                                                  const FollowMoverMaker& makeMover, const CutList& cuts) {
  auto plan = FollowPlan::ofScene(scene, hairs, look, cuts);
  if (!plan) return plan.error();
  if (!*plan) return std::optional<FullHair>();
  if (!makeMover)
    return Error{"a run with hairs that follow strands was given nothing that moves these hairs"};
  auto hair = of(std::move(**plan), scene.groom, makeMover, scene.bodies);
  if (!hair) return hair.error();
  return std::optional(std::move(*hair));
}

Result<FullHair> FullHair::of(FollowPlan plan, const Groom& rest, const FollowMoverMaker& makeMover,
                              std::span<const Body> bodies) {
  FullHair hair;
  hair.plan_ = std::make_unique<FollowPlan>(std::move(plan));
  auto mover = makeMover(*hair.plan_, bodies);
  if (!mover) return mover.error();
  hair.mover_ = std::move(*mover);
  hair.groom_.metresPerUnit = rest.metresPerUnit;
  hair.groom_.firstPoint = hair.plan_->firstPoint();
  hair.groom_.points.resize(hair.groom_.firstPoint.back());
  if (Status moved = hair.follow({.points = rest.points, .roots = hair.plan_->restRoots()}); !moved)
    return moved.error();
  return hair;
}

CutList FullHair::cutsOfHairs(const CutList& cuts) const {
  std::vector<FrameCut> all;
  for (const FrameCut& each : cuts.all()) {
    if (each.cut.strand >= plan_->guides().size()) continue;
    for (std::uint32_t hair = 0; hair < plan_->hairs().size(); ++hair) {
      const FollowHair& follows = plan_->hairs()[hair];
      if (follows.guide != each.cut.strand) continue;
      const auto own = plan_->own().of(hair);
      const std::size_t points = pointCountOf(follows, plan_->guides(), own);
      const std::size_t keep = pointsBefore(each.cut.keep, follows, points, own);
      if (keep < points) all.push_back({each.frame, {hair, static_cast<std::uint32_t>(keep)}});
    }
  }
  return CutList(std::move(all));
}

std::vector<ClosestGuides> FullHair::closestGuides() const {
  const std::vector<std::uint32_t>& strands = plan_->guideStrands();
  std::vector<ClosestGuides> all;
  if (strands.empty()) return all;
  for (const FollowHair& hair : plan_->hairs()) {
    ClosestGuides& each = all.emplace_back();
    each.strands.fill(strands[hair.guide]);
    for (std::size_t k = 0; k < hair.others.size(); ++k) {
      if (!(hair.others[k].share > 0)) continue;
      each.strands[k + 1] = strands[hair.others[k].guide];
      each.shares[k + 1] = hair.others[k].share;
      each.shares[0] -= hair.others[k].share;
    }
  }
  return all;
}

std::vector<std::uint32_t> FullHair::strandOf() const {
  std::vector<std::uint32_t> strands;
  for (const FollowHair& hair : plan_->hairs()) strands.push_back(hair.guide);
  return strands;
}

}  // namespace ringlet
