// Implements pictures/follow_mover.h.
#include "ringlet/pictures/follow_mover.h"

#include <bit>
#include <utility>
#include <vector>

#include "layout/types.h"
#include "ringlet/follow/follow_stage.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/gpu/recorder.h"
#include "ringlet/pictures/follow_plan.h"

namespace ringlet {
namespace {

class DeviceMover : public FollowMover {
 public:
  DeviceMover(ComputeDevice device, const FollowPlan& plan, FollowStage stage, gpu::Recorder recorder)
      : device_(std::move(device)), plan_(plan), stage_(std::move(stage)), recorder_(std::move(recorder)) {}

  Status move(const StrandsPose& pose, std::span<Vec3f> hairs) override {
    std::vector<Vec3d> metres;
    metres.reserve(pose.points.size());
    for (const Vec3f& p : pose.points) metres.push_back(Vec3d(p) * plan_.metresPerUnit());
    if (Status set = stage_.setPose(metres, pose.roots); !set) return set;
    stage_.setBodies(pose.bodies, pose.bodyPoints);
    if (Status begun = recorder_.begin(); !begun) return begun;
    stage_.record(recorder_, plan_.headOf(pose.points));
    if (Status done = recorder_.submitAndWait(); !done) return done;
    const auto records = downloadAll<layout::uvec4>(stage_.points(), stage_.pointCount());
    if (!records) return records.error();
    for (std::size_t i = 0; i < hairs.size(); ++i) {
      const layout::uvec4& at = (*records)[i];
      const Vec3f p{std::bit_cast<float>(at.x), std::bit_cast<float>(at.y), std::bit_cast<float>(at.z)};
      hairs[i] = Vec3f(Vec3d(p) / plan_.metresPerUnit());
    }
    return {};
  }

 private:
  ComputeDevice device_;
  const FollowPlan& plan_;
  FollowStage stage_;
  gpu::Recorder recorder_;
};

}  // namespace

FollowMoverMaker followOn(ComputeDevice device) {
  return [device = std::move(device)](const FollowPlan& plan,
                                      std::span<const Body> bodies) -> Result<std::unique_ptr<FollowMover>> {
    auto stage =
        FollowStage::create(device.gpu(), plan.guides(), plan.hairs(), bodies, plan.isOnScalp(), plan.own());
    if (!stage) return stage.error();
    auto recorder = gpu::Recorder::create(device.gpu(), "hairs that follow strands");
    if (!recorder) return recorder.error();
    return std::unique_ptr<FollowMover>(
        std::make_unique<DeviceMover>(device, plan, std::move(*stage), std::move(*recorder)));
  };
}

}  // namespace ringlet
