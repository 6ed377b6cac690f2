// Implements view/hair_pane.h.
#include "view/hair_pane.h"

#include <algorithm>
#include <utility>

namespace ringlet::view {
namespace {

// Hairs beside the strands they follow, and where hair is a frame later [m].
constexpr double kMargin = 0.03;
constexpr double kMostBox = 1000;  // about hair that still is hair [m]

Bounds boxAbout(std::span<const Vec3d> points) {
  Bounds box{points[0], points[0]};
  for (const Vec3d& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

}  // namespace

Result<HairPane> HairPane::create(gpu::Device& device, const Groom& groom, const PaneLook& look) {
  HairPane self;
  self.size_ = look.size;
  self.firstPoint_ = groom.firstPoint;
  for (const Vec3f& p : groom.points) self.rest_.push_back(Vec3d(p) * groom.metresPerUnit);
  self.box_ = boxAbout(self.rest_);
  if (!look.follow) {
    auto strands = StrandPoints::create(device, groom.firstPoint);
    if (!strands) return strands.error();
    self.strands_ = std::make_unique<StrandPoints>(std::move(*strands));
  } else {
    auto follow = FollowStage::create(device, look.follow->guides(), look.follow->hairs(), look.bodies,
                                      look.follow->isOnScalp(), look.follow->own());
    if (!follow) return follow.error();
    self.follow_ = std::make_unique<FollowStage>(std::move(*follow));
  }
  const DrawnHairs drawn{self.follow_ ? self.follow_->points() : self.strands_->points(),
                         self.follow_ ? self.follow_->firstPoint() : self.strands_->firstPoint(), look.width};
  Look shown = look.look;
  if (look.showsStretch) shown.pigments = scalePigments();
  auto renderer = HairRenderer::create(device, drawn, look.solids, look.size, shown);
  if (!renderer) return renderer.error();
  self.renderer_.emplace(std::move(*renderer));
  if (!look.showsStretch) return self;
  std::vector<std::uint32_t> strandOf;
  if (look.follow)
    for (const FollowHair& hair : look.follow->hairs()) strandOf.push_back(hair.guide);
  for (std::uint32_t s = 0; !look.follow && s < groom.strandCount(); ++s) strandOf.push_back(s);
  auto stretch = StretchColours::create(device, self.follow_ ? self.follow_->pose() : self.strands_->points(),
                                        self.rest_, self.firstPoint_, strandOf, self.renderer_->drawnHairs());
  if (!stretch) return stretch.error();
  self.stretch_.emplace(std::move(*stretch));
  return self;
}

Status HairPane::attach(gpu::Device& device, const Simulation& hair,
                        std::span<const std::uint32_t> cutBeyond) {
  const std::vector<DevicePositions> parts = hair.devicePositions();
  std::vector<PoseSource> sources;
  for (const DevicePositions& part : parts) sources.push_back({*part.own, part.particles});
  auto pose = DevicePose::create(device, sources,
                                 {.rest = rest_,
                                  .firstPoint = firstPoint_,
                                  .cutBeyond = cutBeyond,
                                  .tag = follow_ ? PoseTag::none : PoseTag::strand},
                                 follow_ ? follow_->pose() : strands_->points());
  if (!pose) return pose.error();
  pose_.emplace(std::move(*pose));
  return {};
}

Status HairPane::setFrame(const Camera& camera, const HeadPose& head, std::span<const SolidPlace> solids,
                          const HairSurroundings& about) {
  // Hair is relative to the head's origin, so that everything else is too.
  Camera near = camera;
  near.eye -= head.position;
  near.target -= head.position;
  std::vector<SolidPlace> places(solids.begin(), solids.end());
  for (SolidPlace& place : places) place.position -= head.position;
  if (follow_) {
    follow_->setBodies(about.bodies, about.bodyPoints, head.position);
    if (Status set = follow_->setRoots(about.roots, about.strandRoots); !set) return set;
  }
  const Vec3d margin = Vec3d{1, 1, 1} * kMargin;
  return renderer_->setFrame(near, {box_.low - margin, box_.high + margin}, places);
}

void HairPane::record(gpu::CommandList& list, Quatd head) const {
  list.beginStage("follow");
  pose_->record(list, head);
  if (follow_) follow_->record(list, head);
  if (stretch_) stretch_->record(list);
  list.endStage();
  renderer_->record(list, true);
}

void HairPane::finish() {
  const DevicePose::Box box = pose_->box();
  const double size = length(box.high - box.low);
  if (size < kMostBox) box_ = {box.low, box.high};  // numbers that are none are in no box
}

}  // namespace ringlet::view
