// Session: a scene that is stepped frame by frame as long as somebody watches: it plays, pauses, is reset;
// its head and bodies are dragged; its numbers change; with one material, or with two side by side.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scenes/load_scene.h"
#include "ringlet/scenes/scene_file.h"
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
  /// At rest at the beginning, nothing dragged. Buffers are others then.
  Status reset();

  /// Hands a frame to the device; and waits for it.
  Status submitFrame();
  Status waitFrame();

  std::size_t frame() const { return frame_; }  // number of frames since the beginning
  double seconds() const { return seconds_; }
  double framesPerSecond() const { return hairs_.front().numbers().settings.framesPerSecond; }
  const HeadPose& head() const { return standing_.head; }
  const std::vector<BodyPose>& bodies() const { return standing_.bodies; }
  const LoadedScene& scene() const { return *scene_; }

  DraggedPose headDrag;
  std::vector<DraggedPose> bodyDrags;  // one a body

 private:
  Session(const ComputeDevice& device, const SceneFile& file, const LoadedScene& scene)
      : device_(&device), file_(&file), scene_(&scene) {}
  Result<HairNumbers> numbersNow(const SceneFile& edited, std::optional<SceneKeys>& keys) const;
  Status takeKeys(std::size_t hair, double end);
  HeadPose headAt(double seconds, const Drag& drag) const;
  Standing beginning(const Settings& settings) const;

  struct Poses {
    std::vector<HeadPose> heads;
    std::vector<BodyPose> bodies, roots;
  };
  Poses posesOfNext(const Settings& settings) const;

  const ComputeDevice* device_;
  const SceneFile* file_;
  const LoadedScene* scene_;
  std::vector<LiveHair> hairs_;
  std::array<std::optional<SceneKeys>, 2> keys_;  // of A's and B's scene, where it has some
  Standing standing_;
  std::size_t frame_ = 0;
  double seconds_ = 0;
};

}  // namespace ringlet::view
