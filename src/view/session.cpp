// Implements view/session.h.
#include "view/session.h"

#include <utility>

#include "ringlet/rest/rest_state.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::view {
namespace {

// As takeChange takes hair.
struct Changeable {
  LiveHair& hair;
  SceneMoment now;
  Status cut(std::span<const StrandCut> cuts) { return hair.simulation().cut(cuts); }
  Status setNumbers(const Settings& settings, const Material& material) {
    const auto set = hair.setNumbers({settings, material}, now);
    return set ? Status{} : set.error();
  }
};

}  // namespace

Result<Session> Session::create(const ComputeDevice& device, const SceneFile& file,
                                const LoadedScene& scene) {
  Session self(device, file, scene);
  self.bodyDrags.resize(scene.bodies.size());
  self.frames_.emplace_back(scene);
  const SceneFrames& frames = self.frames_.front();
  auto hair = LiveHair::create(device, scene, {scene.settings, scene.material}, {frames, frames.first()});
  if (!hair) return hair.error();
  self.hairs_.push_back(std::move(*hair));
  if (Status rolled = self.preRoll(); !rolled) return rolled.error();
  return self;
}

SceneDrags Session::drags() const {
  SceneDrags drags{.head = headDrag.way()};
  for (const DraggedPose& drag : bodyDrags) drags.bodies.push_back(drag.way());
  return drags;
}

std::vector<std::uint32_t> Session::cutBeyond() const {
  std::vector<std::uint32_t> points;
  for (const TimedCuts& now : frames_.front().cutsBefore(frame_))
    for (const StrandCut& cut : now.cuts)
      points.push_back(scene_->groom.firstPoint[cut.strand] + cut.keep - 1);
  return points;
}

Status Session::preRoll() {
  for (frame_ = frames_.front().first(); frame_ < 0;) {
    if (Status submitted = submitFrame(); !submitted) return submitted;
    if (Status waited = waitFrame(); !waited) return waited;
  }
  const ScenePlaces now = frames_.front().placesAt(frame_);
  head_ = now.head;
  bodies_ = now.bodies;
  bodyPoints_ = frames_.front().bodyPointsAt(frame_);
  roots_ = now.roots;
  return {};
}

// As keys have them at this moment, with steps enough for every key.
Result<HairNumbers> Session::numbersNow(const SceneFile& edited, std::optional<SceneKeys>& keys) const {
  auto numbers = numbersOf(edited, scene_->groom);
  if (!numbers) return numbers;
  numbers->settings.contacts.takeLists(scene_->settings.contacts);
  if (edited.timeKeys.empty()) return numbers;
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
  auto now = made->at(seconds(), steps);
  if (!now) return now.error();
  now->settings.contacts.takeLists(scene_->settings.contacts);
  keys = std::move(*made);
  return HairNumbers{now->settings, std::move(now->material)};
}

std::vector<Vec3d> Session::strandRoots() const {
  const Groom& groom = scene_->groom;
  std::vector<Vec3d> places;
  for (std::size_t s = 0; s < roots_.size(); ++s) {
    const Vec3d rest = Vec3d(groom.strand(s).front()) * groom.metresPerUnit;
    places.push_back(head_.position +
                     rotate(head_.rotation, roots_[s].position + rotate(roots_[s].rotation, rest)));
  }
  return places;
}

Result<bool> Session::setEdits(const Edits& edits) {
  bool areOthers = false;
  if (!edits.compares && hairs_.size() == 2) hairs_.pop_back(), frames_.pop_back(), areOthers = true;
  for (std::size_t k = 0; k < (edits.compares ? 2u : 1u); ++k) {
    std::optional<SceneKeys> keys;
    const auto numbers = numbersNow(sceneWith(*file_, edits, k), keys);
    if (!numbers) return numbers.error();
    SceneFrames frames = frames_[std::min(k, frames_.size() - 1)];
    frames.change(frame_, numbers->settings, std::move(keys));
    const SceneMoment now{frames, frame_, drags()};
    if (k < hairs_.size()) {
      const auto change = hairs_[k].setNumbers(*numbers, now);
      if (!change) return change.error();
      areOthers = areOthers || *change == LiveHair::Change::rebuilt;
      frames_[k] = std::move(frames);
      continue;
    }
    // B begins as A is.
    auto hair = LiveHair::create(*device_, *scene_, *numbers, now);
    if (!hair) return hair.error();
    const auto state = hairs_.front().simulation().state();
    if (!state) return state.error();
    if (Status set = hair->simulation().setState(*state); !set) return set.error();
    hairs_.push_back(std::move(*hair));
    frames_.push_back(std::move(frames));
    areOthers = true;
  }
  return areOthers;
}

Status Session::reset() {
  headDrag.reset();
  for (DraggedPose& drag : bodyDrags) drag.reset();
  for (std::size_t k = 0; k < hairs_.size(); ++k) {
    frames_[k].restart();
    if (Status done = hairs_[k].reset({frames_[k], frames_[k].first()}); !done) return done;
  }
  return preRoll();
}

Status Session::submitFrame() {
  const SceneDrags before = drags();
  const double frameSeconds = 1 / framesPerSecond();
  headDrag.advance(frameSeconds);
  for (DraggedPose& drag : bodyDrags) drag.advance(frameSeconds);
  for (std::size_t k = 0; k < hairs_.size(); ++k) {
    const auto frame = frames_[k].at(frame_, drags());
    if (!frame) return frame.error();
    Changeable changeable{hairs_[k], {frames_[k], frame_, before}};
    if (Status taken = takeChange(frame->change, false, changeable); !taken) return taken;
    Simulation& hair = hairs_[k].simulation();
    if (Status set = frame->forces.set(hair); !set) return set;
    if (Status submitted = hair.submitFrame(frame->heads, frame->bodies, frame->roots, frame->bodyPoints());
        !submitted)
      return submitted;
    if (k > 0) continue;
    head_ = frame->heads.back();
    bodies_.assign(frame->bodiesAtEnd().begin(), frame->bodiesAtEnd().end());
    bodyPoints_ = frames_.front().bodyPointsAt(frame_ + 1);
    roots_.assign(frame->rootsAtEnd().begin(), frame->rootsAtEnd().end());
  }
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
