// GoalAnimation: poses that hair is pulled to, of an animation's file. [goal] file of a scene.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/foreign/foreign_frames.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet {

class AnimationReader;

/// May be asked from several threads, of any times; rising ones are read once.
class GoalAnimation {
 public:
  /// Of the same strands as the groom's, with the same up axis. Errors: the reader's; another groom.
  /// `reading`, which says the axis, is for files of other programs.
  static Result<std::shared_ptr<GoalAnimation>> open(const std::filesystem::path& path, const Groom& groom,
                                                     const ForeignReading& reading);
  ~GoalAnimation();

  /// In the groom's axes, with the head at `head` [m]. Its frame k is at k / (frames a second), between two
  /// it goes evenly, and before the first and after the last it stays. Errors: the reader's.
  Result<std::vector<Vec3f>> placesAt(double seconds, const HeadPose& head);

 private:
  GoalAnimation(std::filesystem::path path, const ForeignReading& reading);
  Status read(int frame);  // makes it the latest of the two that are kept
  Status show(int frame);  // makes it and the one before the two

  std::filesystem::path path_;
  ForeignReading reading_;
  std::mutex mutex_;
  std::unique_ptr<AnimationReader> reader_;
  int latest_ = 0;                     // number of the frame that `after_` is; 0: none
  std::vector<Vec3d> before_, after_;  // in the world [m]
};

}  // namespace ringlet
