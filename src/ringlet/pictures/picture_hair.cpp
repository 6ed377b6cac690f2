// Implements picture_hair.h.
#include "ringlet/pictures/picture_hair.h"

#include <algorithm>
#include <utility>

#include "ringlet/measure/head_fit.h"
#include "ringlet/render/look.h"

namespace ringlet {
namespace {

constexpr std::size_t kFewestGuides = 100, kMostGuides = 10000;  // number of guides of a head of hair
constexpr int kUsualHairs = 30000;                               // of a head
constexpr int kLockHairs = 300;                                  // number of hairs for each of a few strands
constexpr double kLockRadius = 0.0025;                           // of these locks, at the root [m]
constexpr std::size_t kLockPoints = 2000000;                     // most points of all locks together

// The defaults for this number of strands. hairCount 0: the strands themselves are shown.
struct UsualHairs {
  FollowOptions options;
  double width;  // at the root [m]
};
UsualHairs usualHairs(std::size_t strands, std::size_t particles) {
  if (strands >= kMostGuides) return {{.hairCount = 0}, widthOfHairs(static_cast<double>(strands))};
  if (strands >= kFewestGuides) return {{.hairCount = kUsualHairs}, widthOfHairs(kUsualHairs)};
  const auto ofEach = static_cast<int>(std::clamp<std::size_t>(kLockPoints / particles, 1, kLockHairs));
  return {{.hairCount = ofEach * static_cast<int>(strands), .reach = kLockRadius}, widthOfHairs(kUsualHairs)};
}

}  // namespace

Result<PictureHair> PictureHair::create(const ComputeDevice& device, const Groom& rest, const Groom& first,
                                        double metresPerUnit, const PictureHairChoice& choice,
                                        const PictureHairScene& scene) {
  PictureHair self;
  self.metresPerUnit_ = metresPerUnit;
  self.firstOfStrand_ = first.firstPoint;
  self.cuts_ = scene.cuts;
  const UsualHairs usual = usualHairs(first.strandCount(), first.firstPoint.back());
  const FollowOptions options =
      choice.look.of(choice.hairs ? FollowOptions{.hairCount = *choice.hairs} : usual.options);
  if (options.hairCount == 0) {
    auto lines = StrandPoints::create(device.gpu(), first.firstPoint);
    if (!lines) return lines.error();
    self.lines_.emplace(std::move(*lines));
  } else {
    auto plan = FollowPlan::make(rest, metresPerUnit, options, scene.ground, scene.cuts);
    if (!plan) return plan.error();
    if (Status belongs = plan->checkPose(first); !belongs) return belongs.error();
    auto stage = FollowStage::create(device.gpu(), plan->guides(), plan->hairs(), scene.bodies,
                                     plan->isOnScalp(), plan->own());
    if (!stage) return stage.error();
    self.plan_.emplace(std::move(*plan));
    self.hairs_.emplace(std::move(*stage));
  }
  self.restRoots_ = self.rootsOf(self.follows() ? rest.points : first.points);
  self.width_ =
      choice.width.value_or(choice.hairs ? widthOfHairs(static_cast<double>(self.hairCount())) : usual.width);
  return self;
}

Status PictureHair::setPose(const StrandsPose& pose, int frame) {
  const std::vector<std::uint32_t> cutBeyond = cuts_.cutBeyond(frame, firstOfStrand_);
  if (lines_) return lines_->setPose(pose.points, metresPerUnit_, cutBeyond);
  std::vector<Vec3d> metres;
  metres.reserve(pose.points.size());
  for (const Vec3f& p : pose.points) metres.push_back(Vec3d(p) * metresPerUnit_);
  hairs_->setBodies(pose.bodies, pose.bodyPoints);
  return hairs_->setPose(metres, pose.roots, cutBeyond);
}

Quatd PictureHair::headOf(std::span<const Vec3f> points) const {
  return plan_ ? plan_->headOf(points) : fitHeadRotation(restRoots_, rootsOf(points));
}

void PictureHair::record(gpu::CommandList& list, Quatd head) {
  if (!hairs_) return;
  list.beginStage("follow");
  hairs_->record(list, head);
  list.endStage();
}

std::vector<std::uint32_t> PictureHair::strandOf() const {
  std::vector<std::uint32_t> strands;
  if (plan_) {
    for (const FollowHair& hair : plan_->hairs()) strands.push_back(hair.guide);
  } else {
    for (std::uint32_t s = 0; s < strandCount(); ++s) strands.push_back(s);
  }
  return strands;
}

std::vector<Vec3d> PictureHair::rootsOf(std::span<const Vec3f> points) const {
  std::vector<Vec3d> roots;
  for (std::size_t s = 0; s < strandCount(); ++s)
    roots.push_back(Vec3d(points[firstOfStrand_[s]]) * metresPerUnit_);
  return roots;
}

}  // namespace ringlet
