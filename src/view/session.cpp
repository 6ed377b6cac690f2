// Implements view/session.h.
#include "view/session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ringlet/rest/rest_state.h"

namespace ringlet::view {

HeadPose Session::headAt(double seconds, const Drag& drag) const {
  const HeadPose pose = scene_->motion.poseAt(seconds);
  return {pose.position + drag.move, normalized(drag.turn * pose.rotation), pose.shift};
}

Standing Session::beginning(const Settings& settings) const {
  const double earlier = -settings.stepSeconds(), now = 0;
  Standing standing;
  standing.head = headAt(now, {});
  standing.headEarlier = headAt(earlier, {});
  standing.bodies = bodyPosesOf(scene_->bodies, std::span(&standing.head, 1), std::span(&now, 1));
  if (scene_->scalp) {
    standing.roots = scene_->scalp->rootPosesAt(now);
    standing.rootsEarlier = scene_->scalp->rootPosesAt(earlier);
  }
  return standing;
}

Result<Session> Session::create(const ComputeDevice& device, const SceneFile& file,
                                const LoadedScene& scene) {
  Session self(device, file, scene);
  self.bodyDrags.resize(scene.bodies.size());
  self.standing_ = self.beginning(scene.settings);
  auto hair = LiveHair::create(device, scene, {scene.settings, scene.material}, self.standing_);
  if (!hair) return hair.error();
  self.hairs_.push_back(std::move(*hair));
  self.keys_[0] = scene.keys;
  return self;
}

// As keys have them at this moment, with steps enough for every key.
Result<HairNumbers> Session::numbersNow(const SceneFile& edited, std::optional<SceneKeys>& keys) const {
  auto numbers = numbersOf(edited, scene_->groom);
  if (!numbers || edited.timeKeys.empty()) return numbers;
  auto made = SceneKeys::make(edited);
  if (!made) return made.error();
  int steps = numbers->settings.stepsPerFrame;
  for (const double time : made->times()) {
    const auto then = made->at(time, steps);
    if (!then) return then.error();
    if (edited.simulation.stepsPerFrame) continue;
    const auto needed = chooseStepsPerFrame(scene_->groom, then->material, then->settings);
    if (!needed) return needed.error();
    steps = std::max(steps, *needed);
  }
  auto now = made->at(seconds_, steps);
  if (!now) return now.error();
  keys = std::move(*made);
  return HairNumbers{now->settings, std::move(now->material)};
}

// The numbers that keys give a frame that ends then.
Status Session::takeKeys(std::size_t hair, double end) {
  if (!keys_[hair]) return {};
  const auto numbers = keys_[hair]->at(end, hairs_[hair].numbers().settings.stepsPerFrame);
  if (!numbers) return numbers.error();
  const auto taken = hairs_[hair].setNumbers({numbers->settings, numbers->material}, standing_);
  return taken ? Status{} : taken.error();
}

Result<bool> Session::setEdits(const Edits& edits) {
  bool areOthers = false;
  if (!edits.compares && hairs_.size() == 2) hairs_.pop_back(), areOthers = true;
  for (std::size_t k = 0; k < (edits.compares ? 2u : 1u); ++k) {
    std::optional<SceneKeys> keys;
    const auto numbers = numbersNow(sceneWith(*file_, edits, k), keys);
    if (!numbers) return numbers.error();
    if (k < hairs_.size()) {
      const auto change = hairs_[k].setNumbers(*numbers, standing_);
      if (!change) return change.error();
      areOthers = areOthers || *change == LiveHair::Change::rebuilt;
      keys_[k] = std::move(keys);
      continue;
    }
    // B begins as A is.
    auto hair = LiveHair::create(*device_, *scene_, *numbers, standing_);
    if (!hair) return hair.error();
    const auto state = hairs_.front().simulation().state();
    if (!state) return state.error();
    if (Status set = hair->simulation().setState(*state); !set) return set.error();
    hairs_.push_back(std::move(*hair));
    keys_[k] = std::move(keys);
    areOthers = true;
  }
  return areOthers;
}

Status Session::reset() {
  frame_ = 0;
  seconds_ = 0;
  headDrag.reset();
  for (DraggedPose& drag : bodyDrags) drag.reset();
  standing_ = beginning(hairs_.front().numbers().settings);
  for (LiveHair& hair : hairs_) {
    if (Status done = hair.reset(standing_); !done) return done;
  }
  return {};
}

Session::Poses Session::posesOfNext(const Settings& settings) const {
  Poses poses;
  std::vector<double> times;
  for (int step = 1; step <= settings.stepsPerFrame; ++step) {
    times.push_back(seconds_ + step * settings.stepSeconds());
    const double share = static_cast<double>(step) / settings.stepsPerFrame;
    poses.heads.push_back(headAt(times.back(), headDrag.at(share)));
    if (scene_->scalp)
      std::ranges::copy(scene_->scalp->rootPosesAt(times.back()), std::back_inserter(poses.roots));
  }
  poses.bodies = bodyPosesOf(scene_->bodies, poses.heads, times);
  for (std::size_t i = 0; i < poses.bodies.size(); ++i) {
    const std::size_t step = i / bodyDrags.size();
    const Drag drag =
        bodyDrags[i % bodyDrags.size()].at(static_cast<double>(step + 1) / settings.stepsPerFrame);
    poses.bodies[i] = {poses.bodies[i].position + drag.move,
                       normalized(drag.turn * poses.bodies[i].rotation)};
  }
  return poses;
}

Status Session::submitFrame() {
  const double frameSeconds = 1 / framesPerSecond();
  headDrag.advance(frameSeconds);
  for (DraggedPose& drag : bodyDrags) drag.advance(frameSeconds);
  const HeadPose headNow = standing_.head;
  for (std::size_t k = 0; k < hairs_.size(); ++k) {
    LiveHair& hair = hairs_[k];
    if (Status taken = takeKeys(k, seconds_ + frameSeconds); !taken) return taken;
    const Poses poses = posesOfNext(hair.numbers().settings);
    const auto forces =
        scene_->forces.inFrame({seconds_, headNow}, {seconds_ + frameSeconds, poses.heads.back()},
                               hair.numbers().settings.goal, keys_[k] ? &*keys_[k] : nullptr);
    if (!forces) return forces.error();
    if (Status set = forces->set(hair.simulation()); !set) return set;
    if (Status submitted = hair.simulation().submitFrame(poses.heads, poses.bodies, poses.roots); !submitted)
      return submitted;
    if (k > 0) continue;
    const auto last = [](const std::vector<BodyPose>& all, std::size_t steps) {
      return std::vector<BodyPose>(all.end() - static_cast<std::ptrdiff_t>(all.size() / steps), all.end());
    };
    standing_.headEarlier = poses.heads.size() > 1 ? poses.heads[poses.heads.size() - 2] : standing_.head;
    standing_.head = poses.heads.back();
    standing_.bodies = last(poses.bodies, poses.heads.size());
    standing_.rootsEarlier = std::exchange(standing_.roots, last(poses.roots, poses.heads.size()));
  }
  seconds_ += frameSeconds;
  ++frame_;
  return {};
}

Status Session::waitFrame() {
  for (LiveHair& hair : hairs_) {
    if (Status waited = hair.simulation().waitFrame(); !waited) return waited;
  }
  return {};
}

}  // namespace ringlet::view
