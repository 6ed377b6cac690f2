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
  FullHair hair;
  hair.plan_ = std::make_unique<FollowPlan>(std::move(*plan));
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
    const std::size_t points = plan_->guides()[each.cut.strand].arcs.size();
    auto hair = static_cast<std::uint32_t>(
        std::ranges::lower_bound(plan_->hairs(), each.cut.strand, {}, &FollowHair::guide) -
        plan_->hairs().begin());
    for (; hair < plan_->hairs().size() && plan_->hairs()[hair].guide == each.cut.strand; ++hair) {
      const std::size_t keep = pointsBefore(each.cut.keep, plan_->hairs()[hair], points);
      if (keep < points) all.push_back({each.frame, {hair, static_cast<std::uint32_t>(keep)}});
    }
  }
  return CutList(std::move(all));
}

std::vector<std::uint32_t> FullHair::strandOf() const {
  std::vector<std::uint32_t> strands;
  for (const FollowHair& hair : plan_->hairs()) strands.push_back(hair.guide);
  return strands;
}

}  // namespace ringlet
