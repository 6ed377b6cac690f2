// Session: a scene that is stepped frame by frame as long as somebody watches: it plays, pauses, is reset;
// its head and bodies are dragged; its numbers change; with one material, or with two side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/file/scene_file.h"
#include "ringlet/scenes/frames/scene_frames.h"
#include "ringlet/scenes/load/load_scene.h"
#include "ringlet/solver/compute_device.h"
#include "view/dragged_pose.h"
#include "view/edits.h"
#include "view/live_hair.h"

namespace ringlet::view {

class Session {
 public:
  /// `file` and `scene`, which is what it loads, must live as long. Errors: those of LiveHair.
  static Result<Session> create(const ComputeDevice& device, const SceneFile& file, const LoadedScene& scene);

  bool isPlaying = true;

  /// The hair of A, then of B while they are compared.
  std::vector<LiveHair>& hairs() { return hairs_; }
  const std::vector<LiveHair>& hairs() const { return hairs_; }

  /// Takes the numbers over. Says whether device buffers of hair are others now.
  Result<bool> setEdits(const Edits& edits);
  /// Nothing is dragged, and hair begins again, with the scene's pre-roll. Buffers are others then.
  Status reset();

  /// Hands a frame to the device; and waits for it.
  Status submitFrame();
  Status waitFrame();

  std::size_t frame() const { return static_cast<std::size_t>(std::max(frame_, 0)); }  // since the start
  double seconds() const { return frames_.front().secondsAt(frame_); }
  double framesPerSecond() const { return hairs_.front().numbers().settings.framesPerSecond; }
  const HeadPose& head() const { return head_; }
  const std::vector<BodyPose>& bodies() const { return bodies_; }
  /// Of bodies that bend, in the order of LoadedScene::moving, seen from what carries them [m].
  const std::vector<std::vector<Vec3d>>& bodyPoints() const { return bodyPoints_; }
  /// Where a scalp has the strands' roots now, in the world [m]; none where the head carries them.
  std::vector<Vec3d> strandRoots() const;
  const LoadedScene& scene() const { return *scene_; }
  /// How often hair was cut so far; and the particles, groom order, from which no edge goes on.
  std::size_t cutCount() const { return frames_.front().cutsBefore(frame_).size(); }
  std::vector<std::uint32_t> cutBeyond() const;

  DraggedPose headDrag;
  std::vector<DraggedPose> bodyDrags;  // one a body

 private:
  Session(const ComputeDevice& device, const SceneFile& file, const LoadedScene& scene)
      : device_(&device), file_(&file), scene_(&scene) {}
  Result<HairNumbers> numbersNow(const SceneFile& edited, std::optional<SceneKeys>& keys) const;
  SceneDrags drags() const;
  Status preRoll();

  const ComputeDevice* device_;
  const SceneFile* file_;
  const LoadedScene* scene_;
  std::vector<LiveHair> hairs_;
  std::vector<SceneFrames> frames_;  // of each hair
  int frame_ = 0;                    // that comes next; those of the pre-roll are before 0
  HeadPose head_;
  std::vector<BodyPose> bodies_;
  std::vector<std::vector<Vec3d>> bodyPoints_;
  std::vector<BodyPose> roots_;  // seen from the head
};

}  // namespace ringlet::view
