// Run: a scene's frames, stepped one after the other, and the files that come of them.
//
//   auto outcome = runScene(scene, options, hairOn({device}));
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/run/computed_frame.h"
#include "ringlet/run/run_options.h"
#include "ringlet/run/run_outcome.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Sees every frame, in order, on a thread of its own, the last before Run::finish returns: points in the
/// groom's unit, in its order, finite; and where the head is. RunOptions::observesLast: it may miss all but
/// the last.
using FrameObserver = std::function<Status(std::span<const Vec3f> points, const HeadPose& head)>;

/// What a run asks and tells while it goes on; each may be empty.
struct RunEvents {
  /// Asked before each frame, of the pre-roll too: whether the run is to end early.
  std::function<bool()> isStopped{};
  /// Frames written so far; before each frame, and after the last.
  std::function<void(int written)> progress{};
  /// The first frame is stepped, in which drivers compile; or it failed, or there is none.
  std::function<void()> firstFrame{};
  /// A frame is stepped. While the device computes the next.
  std::function<void(const ComputedFrame& frame)> computed{};
  /// On the thread that writes: this frame, 1 being the first, is handed to its files.
  std::function<void(int frame)> written{};
  FrameObserver observe{};
};

/// Used by one thread. A run that is destroyed before finish leaves what a killed one leaves.
class Run {
 public:
  /// Opens folder and hair, and rolls the hair in or brings it back from a checkpoint. The scene must live as
  /// long. Errors: of the folder (RunFolder), of the checkpoint, of the hair.
  static Result<Run> open(const LoadedScene& scene, RunOptions options, const HairMaker& makeHair,
                          RunEvents events = {});
  Run(Run&&) noexcept;
  ~Run();

  /// Frames that a run before had done.
  int resumedFrom() const;
  /// Steps a frame, while those before it are read back and written. False: all are stepped, or the run was
  /// stopped. Errors: one sentence; frames finished before it are kept.
  Result<bool> next();
  /// Writes what is under way and closes the files. A run that has frames left ends early, but well: with
  /// what is finished, or, where it has checkpoints, with one. Nothing may be called after it.
  Result<RunOutcome> finish();

 private:
  class Work;
  explicit Run(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

/// The whole run.
Result<RunOutcome> runScene(const LoadedScene& scene, const RunOptions& options, const HairMaker& makeHair,
                            RunEvents events = {});

}  // namespace ringlet
