// SceneFrames: what a scene says of each frame. Pure: no device, no hair.
//
// Frame 0 is the first that counts; those of the pre-roll are before it. Times are exact quotients, so they
// do not drift.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// A host's frame is from -kMostFrame to kMostFrame.
inline constexpr int kMostFrame = 1'000'000;

/// How far somebody holds a head or a body away from where its scene has it.
struct Drag {
  Vec3d move{};  // [m]
  Quatd turn{};  // about its own origin, before it is moved
  bool operator==(const Drag&) const = default;
};
inline Drag between(const Drag& a, const Drag& b, double share) {
  return {a.move + (b.move - a.move) * share, slerp(a.turn, b.turn, share)};
}

/// Through a frame, evenly.
struct DragWay {
  Drag from{}, to{};
  Drag at(double share) const { return between(from, to, share); }
};
struct SceneDrags {
  DragWay head{};
  std::vector<DragWay> bodies{};  // one a body, or none
};

/// Where everything that moves by itself is at a moment, and where it was one step before.
struct ScenePlaces {
  HeadPose head, headEarlier;
  std::vector<BodyPose> bodies{};
  std::vector<BodyPose> roots{}, rootsEarlier{};  // of each strand, seen from the head; none: it carries them
};

/// What changes in hair for good as a frame begins.
struct HairChange {
  std::span<const TimedCuts> cuts{};      // of the scene
  std::optional<SceneNumbers> numbers{};  // of a scene with keys: those of the frame's end

  bool isNone() const { return !numbers && cuts.empty(); }
};

struct SceneFrame {
  int number = 0;
  std::optional<std::size_t> ofStep{};      // it is this step of the frame, alone
  std::vector<HeadPose> heads{};            // at the end of each step
  std::vector<BodyPose> bodies{}, roots{};  // [step][body], [step][strand] (none: the head carries them)
  std::vector<std::vector<Vec3d>>
      points{};  // of each body that bends: of its mesh at the end of each step [m]
  FrameForces forces{};
  HairChange change{};  // with one, no earlier frame is in flight as hair takes the frame

  std::size_t stepCount() const { return heads.size(); }
  /// One of its steps alone.
  SceneFrame step(std::size_t k) const;
  /// `points` as Simulation::stepFrame takes them.
  std::vector<std::span<const Vec3d>> bodyPoints() const { return {points.begin(), points.end()}; }
  std::span<const BodyPose> bodiesAtEnd() const {
    return std::span(bodies).last(bodies.size() / heads.size());
  }
  std::vector<std::vector<Vec3d>> pointsAtEnd() const {
    std::vector<std::vector<Vec3d>> ends;
    for (const auto& each : points)
      ends.emplace_back(each.end() - static_cast<std::ptrdiff_t>(each.size() / heads.size()), each.end());
    return ends;
  }
  std::span<const BodyPose> rootsAtEnd() const { return std::span(roots).last(roots.size() / heads.size()); }
};

class SceneFrames {
 public:
  /// `scene` must live as long.
  explicit SceneFrames(const LoadedScene& scene);

  /// The first frame of the pre-roll, in which hair comes to rest or to speed; without one 0.
  int first() const { return first_; }
  /// The start's, or what change() was given last.
  const Settings& settings() const { return settings_; }
  /// From this frame on the numbers are others than the scene's, its keys too. Time goes on.
  void change(int frame, const Settings& settings, std::optional<SceneKeys> keys);
  /// Time begins anew, with the numbers that there are.
  void restart();

  /// When a frame begins, or a share of one before it [s].
  double secondsAt(double frame) const;
  /// As a frame begins; `before`: the drags of the frame before it.
  ScenePlaces placesAt(int frame, const SceneDrags& before = {}) const;
  /// Where bodies are as a frame begins, or a share of one before; one pose each.
  std::vector<BodyPose> bodiesAt(double frame) const;
  /// Likewise the points of bodies that bend, in the order of LoadedScene::moving, seen from what carries
  /// them [m].
  std::vector<std::vector<Vec3d>> bodyPointsAt(double frame) const;
  /// What is cut as a frame begins; and in all frames before it.
  std::span<const TimedCuts> cutsAt(int frame) const;
  std::span<const TimedCuts> cutsBefore(int frame) const;
  /// What frames before this one changed, of which a checkpoint knows nothing, in the order in which hair
  /// takes it.
  Result<std::vector<HairChange>> changesBefore(int frame) const;
  /// Errors: an animation of the scene that cannot be read; numbers of keys that spoil each other.
  Result<SceneFrame> at(int frame, const SceneDrags& drags = {}) const;

 private:
  HeadPose headAt(double seconds, const Drag& drag) const;
  Result<std::optional<SceneNumbers>> numbersOf(int frame) const;
  const SceneKeys* keys() const;
  void addSteps(int frame, const SceneDrags& drags, SceneFrame& made) const;

  const LoadedScene* scene_;
  Settings settings_;
  std::optional<SceneKeys> ownKeys_;  // of change()
  bool isChanged_ = false;
  int first_ = 0;
  // Since which frame there are as many a second, and when that began [s].
  int since_ = 0;
  double sinceSeconds_ = 0;
};

/// As many steps a second, each of which is a frame.
Settings stepByStep(Settings settings);

}  // namespace ringlet
