// Implements reference_mover.h.
#include "program/simulate/reference_mover.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <thread>
#include <vector>

#include "reference/follow_guide.h"
#include "ringlet/base/in_parallel.h"
#include "ringlet/pictures/follow_plan.h"

namespace ringlet::program {
namespace {

class ReferenceMover : public FollowMover {
 public:
  ReferenceMover(const FollowPlan& plan, std::span<const Body> bodies)
      : plan_(plan),
        bodies_(bodies.begin(), bodies.end()),
        firstHair_(plan.guides().size() + 1),
        isBlended_(std::ranges::any_of(plan.hairs(), [](const FollowHair& hair) {
          return hair.others[0].share > 0 || hair.others[1].share > 0;
        })) {
    for (const FollowHair& each : plan.hairs()) ++firstHair_[each.guide + 1];
    for (std::size_t s = 0; s + 1 < firstHair_.size(); ++s) firstHair_[s + 1] += firstHair_[s];
    order_.resize(plan.hairs().size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, {}, [&](std::size_t h) { return plan.hairs()[h].guide; });
  }

  Status move(const StrandsPose& pose, std::span<Vec3f> hairs) override {
    const Quatd head = plan_.headOf(pose.points);
    const std::vector<Body> met =
        pose.bodies.empty() ? std::vector<Body>() : reference::bodiesMetAt(bodies_, pose.bodyPoints);
    std::vector<reference::GuidePose> poses(plan_.guides().size());
    const auto poseGuide = [&](std::size_t s) {
      poses[s] = reference::poseGuide(plan_.guides()[s], plan_.strandOf(pose.points, s), head);
    };
    const auto moveHairs = [&](std::size_t s) {
      for (std::size_t k = firstHair_[s]; k < firstHair_[s + 1]; ++k) {
        const std::size_t h = order_[k];
        const auto root = pose.roots.empty() ? std::nullopt : std::optional(pose.roots[h]);
        std::uint32_t at = plan_.firstPoint()[h];
        for (const Vec3d& p :
             reference::followGuides(plan_.hairs()[h], poses, met, pose.bodies, root, plan_.own().of(h)))
          hairs[at++] = Vec3f(p / plan_.metresPerUnit());
      }
    };
    if (isBlended_) {
      forEachStrand(poseGuide);
      forEachStrand(moveHairs);
    } else {  // few strands at a time, so that they stay in the caches
      forEachStrand([&](std::size_t s) {
        poseGuide(s);
        moveHairs(s);
        poses[s].places = {};
      });
    }
    return {};
  }

 private:
  template <class Use>
  void forEachStrand(const Use& use) const {
    std::atomic<std::size_t> next = 0;
    inParallel(std::max(1u, std::thread::hardware_concurrency()), [&] {
      for (std::size_t s; (s = next++) < plan_.guides().size();) use(s);
    });
  }

  const FollowPlan& plan_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> order_;      // hairs by strand
  std::vector<std::size_t> firstHair_;  // of each strand among these, and the end
  bool isBlended_;                      // hairs follow several strands
};

}  // namespace

FollowMoverMaker followByReference() {
  return [](const FollowPlan& plan, std::span<const Body> bodies) -> Result<std::unique_ptr<FollowMover>> {
    return std::unique_ptr<FollowMover>(std::make_unique<ReferenceMover>(plan, bodies));
  };
}

}  // namespace ringlet::program
