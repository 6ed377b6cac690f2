// Implements full_hair.h.
#include "program/full_hair.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <thread>

#include "reference/follow_guide.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/measure/head_fit.h"

namespace ringlet::program {
namespace {

// A pose whose strands are longer or shorter than this as a whole is one of another groom, or in another
// unit.
constexpr double kMostLonger = 3;

double lengthOf(std::span<const Vec3d> strand) {
  double sum = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) sum += length(strand[i] - strand[i - 1]);
  return sum;
}

}  // namespace

std::vector<Vec3d> FullHair::strandAt(std::span<const Vec3f> points, std::size_t strand) const {
  std::vector<Vec3d> metres;
  for (std::uint32_t i = firstPoint_[strand]; i < firstPoint_[strand + 1]; ++i)
    metres.push_back(Vec3d(points[i]) * metresPerUnit_);
  return metres;
}

Result<FullHair> FullHair::make(const Groom& rest, double metresPerUnit, const FollowOptions& options) {
  FullHair hair;
  hair.metresPerUnit_ = metresPerUnit;
  hair.firstPoint_ = rest.firstPoint;
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const std::vector<Vec3d> strand = hair.strandAt(rest.points, s);
    if (!(lengthOf(strand) > 0))
      return Error{
          fmt::format("strand {} of the groom has no length, so that no hair can follow it; "
                      "`ringlet info --fix` drops such strands",
                      s + 1)};
    hair.guides_.push_back(restOfGuide(strand));
  }
  auto planned = planHairs(hair.guides_, options);
  if (!planned) return planned.error();
  hair.hairs_ = std::move(*planned);

  std::uint64_t points = 0;
  for (const FollowHair& each : hair.hairs_) points += hair.guides_[each.guide].arcs.size();
  if (points > std::numeric_limits<std::uint32_t>::max())
    return Error{fmt::format("{} hairs have {} points; at most {} can be numbered", hair.hairs_.size(),
                             points, std::numeric_limits<std::uint32_t>::max())};

  hair.groom_.metresPerUnit = rest.metresPerUnit;
  hair.firstHair_.assign(hair.guides_.size() + 1, 0);
  for (const FollowHair& each : hair.hairs_) {
    ++hair.firstHair_[each.guide + 1];
    const std::uint32_t count = rest.firstPoint[each.guide + 1] - rest.firstPoint[each.guide];
    hair.groom_.firstPoint.push_back(hair.groom_.firstPoint.back() + count);
  }
  for (std::size_t s = 0; s < hair.guides_.size(); ++s) hair.firstHair_[s + 1] += hair.firstHair_[s];
  hair.groom_.points.resize(hair.groom_.firstPoint.back());
  hair.follow(rest.points);
  return hair;
}

Status FullHair::checkPose(const Groom& groom) const {
  if (groom.firstPoint != firstPoint_)
    return Error{
        fmt::format("the groom has {} strands of {} particles in all, the animation {} of {}: they do "
                    "not belong together",
                    guides_.size(), firstPoint_.back(), groom.strandCount(), groom.firstPoint.back())};
  double now = 0, atRest = 0;
  for (std::size_t s = 0; s < guides_.size(); ++s) {
    now += lengthOf(strandAt(groom.points, s));
    atRest += guides_[s].arcs.back();
  }
  if (now > kMostLonger * atRest || atRest > kMostLonger * now)
    return Error{
        fmt::format("the animation's strands are {:.3g} times as long as the groom's: one of them is in "
                    "another unit",
                    now / atRest)};
  return {};
}

void FullHair::follow(std::span<const Vec3f> points) {
  std::vector<Vec3d> restRoots, roots;
  for (std::size_t s = 0; s < guides_.size(); ++s) {
    restRoots.push_back(guides_[s].root);
    roots.push_back(Vec3d(points[firstPoint_[s]]) * metresPerUnit_);
  }
  const Quatd head = fitHeadRotation(restRoots, roots);
  std::atomic<std::size_t> next = 0;
  inParallel(std::max(1u, std::thread::hardware_concurrency()), [&] {
    for (std::size_t s; (s = next++) < guides_.size();) {
      const reference::GuidePose pose = reference::poseGuide(guides_[s], strandAt(points, s), head);
      for (std::size_t h = firstHair_[s]; h < firstHair_[s + 1]; ++h) {
        std::uint32_t at = groom_.firstPoint[h];
        for (const Vec3d& p : reference::followGuide(hairs_[h], pose))
          groom_.points[at++] = Vec3f(p / metresPerUnit_);
      }
    }
  });
}

}  // namespace ringlet::program
