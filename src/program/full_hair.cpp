// Implements full_hair.h.
#include "program/full_hair.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

#include "reference/follow_guide.h"
#include "ringlet/base/in_parallel.h"

namespace ringlet::program {

Result<FullHair> FullHair::make(const Groom& rest, double metresPerUnit, const FollowOptions& options,
                                std::span<const Body> bodies, const HairGround& ground, const CutList& cuts) {
  auto plan = FollowPlan::make(rest, metresPerUnit, options, ground, cuts);
  if (!plan) return plan.error();
  FullHair hair(std::move(*plan), bodies);
  hair.groom_.metresPerUnit = rest.metresPerUnit;
  hair.groom_.firstPoint = hair.plan_.firstPoint();
  hair.groom_.points.resize(hair.groom_.firstPoint.back());
  hair.firstHair_.assign(rest.strandCount() + 1, 0);
  for (const FollowHair& each : hair.plan_.hairs()) ++hair.firstHair_[each.guide + 1];
  hair.isBlended_ = options.blend > 0;
  for (std::size_t s = 0; s < rest.strandCount(); ++s) hair.firstHair_[s + 1] += hair.firstHair_[s];
  hair.follow(rest.points, {}, hair.plan_.restRoots());
  return hair;
}

void FullHair::follow(std::span<const Vec3f> points, std::span<const BodyPose> bodies,
                      std::span<const Vec3d> roots) {
  const Quatd head = plan_.headOf(points);
  const std::span<const Body> met = bodies.empty() ? std::span<const Body>() : bodies_;
  const auto poseOf = [&](std::size_t s) {
    return reference::poseGuide(plan_.guides()[s], plan_.strandOf(points, s), head);
  };
  const auto forEachStrand = [&](const auto& use) {
    std::atomic<std::size_t> next = 0;
    inParallel(std::max(1u, std::thread::hardware_concurrency()), [&] {
      for (std::size_t s; (s = next++) < plan_.guides().size();) use(s);
    });
  };
  const auto moveHairs = [&](std::size_t s, const auto& pointsOf) {
    for (std::size_t h = firstHair_[s]; h < firstHair_[s + 1]; ++h) {
      std::uint32_t at = groom_.firstPoint[h];
      const auto root = roots.empty() ? std::nullopt : std::optional(roots[h]);
      for (const Vec3d& p : pointsOf(plan_.hairs()[h], root))
        groom_.points[at++] = Vec3f(p / plan_.metresPerUnit());
    }
  };
  if (!isBlended_) {
    forEachStrand([&](std::size_t s) {
      const reference::GuidePose pose = poseOf(s);
      moveHairs(s, [&](const FollowHair& hair, const std::optional<Vec3d>& root) {
        return reference::followGuide(hair, pose, met, bodies, root);
      });
    });
    return;
  }
  std::vector<reference::GuidePose> poses(plan_.guides().size());
  forEachStrand([&](std::size_t s) { poses[s] = poseOf(s); });
  forEachStrand([&](std::size_t s) {
    moveHairs(s, [&](const FollowHair& hair, const std::optional<Vec3d>& root) {
      return reference::followGuides(hair, poses, met, bodies, root);
    });
  });
}

CutList FullHair::cutsOfHairs(const CutList& cuts) const {
  std::vector<FrameCut> all;
  for (const FrameCut& each : cuts.all()) {
    const std::size_t strand = each.cut.strand;
    if (strand >= plan_.guides().size()) continue;
    const std::size_t points = plan_.guides()[strand].arcs.size();
    for (std::size_t h = firstHair_[strand]; h < firstHair_[strand + 1]; ++h) {
      const std::size_t keep = reference::pointsBefore(each.cut.keep, plan_.hairs()[h], points);
      if (keep < points)
        all.push_back({each.frame, {static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(keep)}});
    }
  }
  return CutList(std::move(all));
}

std::vector<std::uint32_t> FullHair::strandOf() const {
  std::vector<std::uint32_t> strands;
  for (const FollowHair& hair : plan_.hairs()) strands.push_back(hair.guide);
  return strands;
}

}  // namespace ringlet::program
