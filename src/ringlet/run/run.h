// Run: steps a scene's frames one after another, and writes the resulting files.
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

/// Is called for every frame, in order, on a thread of its own, and for the last one before Run::finish
/// returns: points in the groom's unit and order, finite; and the head's pose. With RunOptions::observesLast
/// it may be called for the last frame only.
using FrameObserver = std::function<Status(std::span<const Vec3f> points, const HeadPose& head)>;

/// Callbacks of a run; each may be empty.
struct RunEvents {
  /// Called before each frame, also of the pre-roll. True: the run ends early.
  std::function<bool()> isStopped{};
  /// Called before each frame and after the last with the number of frames written so far.
  std::function<void(int written)> progress{};
  /// Called once when the first frame has been stepped, in which drivers compile; also if it failed or does
  /// not exist.
  std::function<void()> firstFrame{};
  /// Called when a frame has been stepped, while the device computes the next.
  std::function<void(const ComputedFrame& frame)> computed{};
  /// Called on the writer's thread when this frame, counted from 1, has been given to its files.
  std::function<void(int frame)> written{};
  FrameObserver observe{};
};

/// Used by one thread. A run that is destroyed before finish leaves the same files as one that is killed.
class Run {
 public:
  /// Opens folder and hair, and steps the pre-roll or restores a checkpoint. The scene must outlive the run.
  /// Errors: of the folder (RunFolder), of the checkpoint, of the hair.
  static Result<Run> open(const LoadedScene& scene, RunOptions options, const HairMaker& makeHair,
                          RunEvents events = {});
  Run(Run&&) noexcept;
  ~Run();

  /// Number of frames that an earlier run had done.
  int resumedFrom() const;
  /// Steps a frame, while earlier ones are read back and written. Returns false if all are stepped or the run
  /// was stopped. Errors: one sentence; frames finished before the error are kept.
  Result<bool> next();
  /// Writes the remaining frames and closes the files. A run that was stopped ends properly: with the frames
  /// finished so far, or, if it has checkpoints, with a checkpoint. No function may be called afterwards.
  Result<RunOutcome> finish();

 private:
  class Work;
  explicit Run(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

/// Does the whole run.
Result<RunOutcome> runScene(const LoadedScene& scene, const RunOptions& options, const HairMaker& makeHair,
                            RunEvents events = {});

}  // namespace ringlet
