// What acts on a scene's hair beside bodies and air: force fields and holds, frame by frame. [[field]] and
// [[hold]] of a scene file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/goal.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/scene/motion.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/scene_keys.h"

namespace ringlet {

class GoalAnimation;

/// Goals of all particles at a time, as Simulation::setGoals takes them.
struct GoalPose {
  std::vector<Vec3f> places;  // [m]
  std::vector<float> strengths;
};

/// What fields and holds do in a frame, or in some of its steps; from its start to its end everything goes
/// evenly.
struct FrameForces {
  std::vector<ForceField> fieldsFrom{}, fields{};
  std::vector<Vec3f> placesFrom{};  // of goals [m]
  GoalPose goals{};
  double goalDamping = 1;

  /// From one share of the way to another.
  FrameForces part(double begin, double end) const;
  /// Hands them to hair, for its next frame.
  template <class Hair>
  Status set(Hair& hair) const {
    if (!fields.empty()) {
      if (Status set = hair.setFields(fields, fieldsFrom); !set) return set;
    }
    if (goals.places.empty()) return {};
    return hair.setGoals(goals.places, goals.strengths, goalDamping, placesFrom);
  }
};

class SceneForces {
 public:
  /// Reads the grids and joints that the scene names. `groom`: as loadScene places it, carried by `head`.
  /// Errors: with the name of the field or hold.
  static Result<SceneForces> load(const SceneFile& scene, const Groom& groom, const Motion& head,
                                  std::vector<std::string>& warnings);

  bool haveFields() const { return !fields_.empty(); }
  /// Whether goals are other than the groom itself all the time.
  bool haveGoals() const {
    return !holds_.empty() || hasGoalFile_ || !goalFactors_.empty() || startSeconds_ > 0;
  }
  /// Holds each particle of the scene's groom to its place, in the head's frame [m], ever less for so long
  /// [s].
  void holdStart(const Groom& groom, std::vector<Vec3f> places, double seconds);

  /// In the world, with the head at `head`. `keys`: of the same scene, or none.
  std::vector<ForceField> fieldsAt(double seconds, const HeadPose& head, const SceneKeys* keys) const;
  /// Those of holds, and of [goal]: where several hold a particle, as all of them together. Errors: an
  /// animation that cannot be read.
  Result<GoalPose> goalsAt(double seconds, const HeadPose& head, const GoalSettings& goal,
                           const SceneKeys* keys) const;
  struct Moment {
    double seconds;
    HeadPose head;
  };
  /// Between two. `goal`: [goal] without keys. Errors: those of goalsAt.
  Result<FrameForces> inFrame(const Moment& begin, const Moment& end, const GoalSettings& goal,
                              const SceneKeys* keys) const;

 private:
  // Where something is carried from its own frame.
  struct Carrier {
    std::optional<Motion> motion{};  // a joint's
    bool isWorld = false;            // neither: the head
    bool isHeads() const { return !motion && !isWorld; }
    BodyPose poseAt(double seconds, const HeadPose& head) const;
  };
  struct Field {
    Carrier carrier;
    ForceField field;  // but for what keys change
  };
  struct Held {
    std::size_t particle;
    Vec3d offset;  // from the middle [m]
  };
  struct Hold {
    Carrier carrier;
    Vec3d middle;            // of the held hair [m]
    std::vector<Held> held;  // all in the carrier's frame, as it was at 0 s
  };

  static Result<Carrier> carrierOf(const SceneFile& scene, const std::string& bind, const std::string& joint,
                                   std::vector<std::string>& warnings);
  static Result<Hold> holdOf(const SceneFile& scene, const SceneHold& stated, const Groom& groom,
                             const Motion& head, std::vector<std::string>& warnings);

  SceneFile scene_;  // its fields and holds
  std::vector<Field> fields_;
  std::vector<Hold> holds_;
  Status loadGoal(const SceneFile& scene, const Groom& groom);

  GroomGoal groom_;  // with goals; of a goal's pose in its place
  bool hasGoalFile_ = false;
  std::vector<float> goalFactors_;            // of maps, on each particle's strength; empty: all 1
  std::shared_ptr<GoalAnimation> animation_;  // that moves it
  std::vector<Vec3f> startPlaces_;            // of holdStart
  double startSeconds_ = 0;
};

}  // namespace ringlet
