// The writers of a run: what happens to a frame once it is stepped.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/sheet.h"
#include "ringlet/pictures/full_hair.h"
#include "ringlet/run/run_options.h"
#include "ringlet/scenes/frames/cut_list.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// The files of a run, made when there is a frame to write: until then nothing in the folder is touched.
class RunWriters {
 public:
  /// The scene must live as long. `hairs`: what animations have in place of the strands. `frameCount`: frames
  /// that a run before left and this one goes on with; they are in the files, and archive() brings back what
  /// is not.
  RunWriters(const LoadedScene& scene, const RunOptions& options, std::optional<FullHair> hairs,
             int frameCount);

  /// Frames in order, 1 is the first; points in the groom's unit and order, finite; where head and bodies
  /// are.
  Status addFrame(int frame, std::vector<Vec3f> points, const HeadPose& head,
                  std::span<const BodyPose> bodies);
  /// What was added is on the disk.
  Status sync();
  /// What is kept beside the files, for a checkpoint; but not the last frame's points, since at least one
  /// follows.
  void archive(Archive& archive);
  /// Closes the files, after at least one frame, and says which there are.
  Result<std::vector<std::filesystem::path>> finish();

  /// How far a point of an animation may be from its particle [m]; none where all keep every bit.
  std::optional<double> errorBound() const;

 private:
  Status open();
  UsdExtras usdExtras() const;

  const LoadedScene& scene_;
  const RunOptions& options_;
  SceneFrames frames_;
  CutList cuts_;  // of strands
  std::optional<FullHair> hairs_;
  int frameCount_;
  bool isOpen_ = false;
  std::vector<std::unique_ptr<AnimationWriter>> animations_;
  std::optional<Sheet> sheet_;
  std::vector<Vec3f> lastPoints_;  // [file unit]
};

}  // namespace ringlet
