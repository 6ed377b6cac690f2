// Implements scenes/frames/scene_frames.h.
#include "ringlet/scenes/frames/scene_frames.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ringlet {
namespace {

constexpr double kRounding = 1e-6;      // of a pre-roll's length, of a frame
constexpr double kTypedSeconds = 1e-9;  // a frame begins at a quotient, and a cut's time is typed in decimals

// The bits stay where nothing is dragged.
HeadPose dragged(const HeadPose& pose, const Drag& drag) {
  if (drag == Drag{}) return pose;
  return {pose.position + drag.move, normalized(drag.turn * pose.rotation), pose.shift};
}
BodyPose dragged(const BodyPose& pose, const Drag& drag) {
  if (drag == Drag{}) return pose;
  return {pose.position + drag.move, normalized(drag.turn * pose.rotation)};
}

double shareOf(std::size_t step, std::size_t count) {
  return static_cast<double>(step) / static_cast<double>(count);
}

}  // namespace

Settings stepByStep(Settings settings) {
  settings.framesPerSecond *= settings.stepsPerFrame;
  settings.stepsPerFrame = 1;
  return settings;
}

SceneFrame SceneFrame::step(std::size_t k) const {
  const auto posesOfStep = [&](const std::vector<BodyPose>& poses) {
    const auto each = poses.size() / heads.size(), first = k * each;
    return std::vector(poses.begin() + static_cast<std::ptrdiff_t>(first),
                       poses.begin() + static_cast<std::ptrdiff_t>(first + each));
  };
  SceneFrame one{.number = number,
                 .ofStep = k,
                 .heads = {heads[k]},
                 .bodies = posesOfStep(bodies),
                 .roots = posesOfStep(roots)};
  for (const std::vector<Vec3d>& all : points) {
    const auto each = static_cast<std::ptrdiff_t>(all.size() / heads.size());
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(k) * each;
    one.points.emplace_back(first, first + each);
  }
  one.forces =
      heads.size() == 1 ? forces : forces.part(shareOf(k, heads.size()), shareOf(k + 1, heads.size()));
  if (k == 0) one.change = change;
  return one;
}

SceneFrames::SceneFrames(const LoadedScene& scene) : scene_(&scene), settings_(scene.settings) { restart(); }

void SceneFrames::restart() {
  first_ = -static_cast<int>(std::ceil(scene_->preRollSeconds * settings_.framesPerSecond - kRounding));
  since_ = 0;
  sinceSeconds_ = 0;
}

const SceneKeys* SceneFrames::keys() const {
  const std::optional<SceneKeys>& keys = isChanged_ ? ownKeys_ : scene_->keys;
  return keys ? &*keys : nullptr;
}

void SceneFrames::change(int frame, const Settings& settings, std::optional<SceneKeys> keys) {
  if (settings.framesPerSecond != settings_.framesPerSecond) {
    sinceSeconds_ = secondsAt(frame);
    since_ = frame;
  }
  settings_ = settings;
  ownKeys_ = std::move(keys);
  isChanged_ = true;
}

double SceneFrames::secondsAt(double frame) const {
  return sinceSeconds_ + (frame - since_) / settings_.framesPerSecond;
}

HeadPose SceneFrames::headAt(double seconds, const Drag& drag) const {
  return dragged(scene_->motion.poseAt(seconds), drag);
}

ScenePlaces SceneFrames::placesAt(int frame, const SceneDrags& before) const {
  const double now = secondsAt(frame), earlier = now - settings_.stepSeconds();
  const double shareEarlier = 1 - shareOf(1, static_cast<std::size_t>(settings_.stepsPerFrame));
  ScenePlaces places{headAt(now, before.head.to), headAt(earlier, before.head.at(shareEarlier))};
  places.bodies = bodyPosesOf(scene_->bodies, std::span(&places.head, 1), std::span(&now, 1));
  for (std::size_t b = 0; b < before.bodies.size(); ++b)
    places.bodies[b] = dragged(places.bodies[b], before.bodies[b].to);
  if (scene_->scalp) {
    places.roots = scene_->scalp->rootPosesAt(now);
    places.rootsEarlier = scene_->scalp->rootPosesAt(earlier);
  }
  return places;
}

std::vector<BodyPose> SceneFrames::bodiesAt(double frame) const {
  const double seconds = secondsAt(frame);
  const HeadPose head = scene_->motion.poseAt(seconds);
  return bodyPosesOf(scene_->bodies, std::span(&head, 1), std::span(&seconds, 1));
}

std::vector<std::vector<Vec3d>> SceneFrames::bodyPointsAt(double frame) const {
  const double seconds = secondsAt(frame);
  std::vector<std::vector<Vec3d>> all;
  for (const MovingBody& moving : scene_->moving)
    all.push_back(moving.pointsSeenAt(seconds, scene_->bodies[moving.body], scene_->motion));
  return all;
}

std::span<const TimedCuts> SceneFrames::cutsBefore(int frame) const {
  if (frame <= first_) return {};
  // Those whose time has come as the frame before begins.
  const std::span<const TimedCuts> cuts = scene_->cuts;
  const auto made =
      std::ranges::upper_bound(cuts, secondsAt(frame - 1) + kTypedSeconds, {}, &TimedCuts::seconds);
  return cuts.first(static_cast<std::size_t>(made - cuts.begin()));
}

std::span<const TimedCuts> SceneFrames::cutsAt(int frame) const {
  return cutsBefore(frame + 1).subspan(cutsBefore(frame).size());
}

void SceneFrames::addSteps(int frame, const SceneDrags& drags, SceneFrame& made) const {
  const auto count = static_cast<std::size_t>(settings_.stepsPerFrame);
  std::vector<double> times;
  for (std::size_t step = 1; step <= count; ++step) {
    const double steps =
        static_cast<double>(frame - since_) * settings_.stepsPerFrame + static_cast<double>(step);
    times.push_back(sinceSeconds_ + steps / (settings_.framesPerSecond * settings_.stepsPerFrame));
    made.heads.push_back(headAt(times.back(), drags.head.at(shareOf(step, count))));
    if (scene_->scalp)
      std::ranges::copy(scene_->scalp->rootPosesAt(times.back()), std::back_inserter(made.roots));
  }
  made.bodies = bodyPosesOf(scene_->bodies, made.heads, times);
  for (const MovingBody& moving : scene_->moving) {
    std::vector<Vec3d>& points = made.points.emplace_back();
    for (const double t : times)
      std::ranges::copy(moving.pointsAt(t, scene_->motion), std::back_inserter(points));
  }
  for (std::size_t i = 0; i < made.bodies.size() && !drags.bodies.empty(); ++i) {
    const std::size_t step = i / drags.bodies.size(), body = i % drags.bodies.size();
    made.bodies[i] = dragged(made.bodies[i], drags.bodies[body].at(shareOf(step + 1, count)));
  }
}

Result<std::optional<SceneNumbers>> SceneFrames::numbersOf(int frame) const {
  if (!keys()) return std::optional<SceneNumbers>();
  auto numbers = keys()->at(secondsAt(frame + 1), settings_.stepsPerFrame);
  if (!numbers) return numbers.error();
  numbers->settings.contacts.takeLists(settings_.contacts);
  return std::optional(std::move(*numbers));
}

// A material that was another and came back has other last bits than one that never changed: the first change
// is one too.
Result<std::vector<HairChange>> SceneFrames::changesBefore(int frame) const {
  std::vector<HairChange> changes;
  for (int before = first_; keys() && before < frame; ++before) {
    auto numbers = numbersOf(before);
    if (!numbers) return numbers.error();
    if (before < frame - 1 && (*numbers)->material == scene_->material) continue;
    changes.push_back({{}, std::move(*numbers)});
    before = std::max(before, frame - 2);  // goes on with the last
  }
  if (const auto cuts = cutsBefore(frame); !cuts.empty()) changes.push_back({cuts, {}});
  return changes;
}

Result<SceneFrame> SceneFrames::at(int frame, const SceneDrags& drags) const {
  SceneFrame made{.number = frame};
  addSteps(frame, drags, made);
  made.change.cuts = cutsAt(frame);
  auto numbers = numbersOf(frame);
  if (!numbers) return numbers.error();
  made.change.numbers = std::move(*numbers);
  const double begin = secondsAt(frame), end = secondsAt(frame + 1);
  auto forces = scene_->forces.inFrame({begin, headAt(begin, drags.head.from)},
                                       {end, headAt(end, drags.head.to)}, settings_.goal, keys());
  if (!forces) return forces.error();
  made.forces = std::move(*forces);
  return made;
}

}  // namespace ringlet
