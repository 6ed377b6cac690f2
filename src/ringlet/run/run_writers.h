// RunWriters: the files of a run, and what is written for each frame.
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
#include "ringlet/pictures/follow_watch.h"
#include "ringlet/pictures/full_hair.h"
#include "ringlet/run/run_options.h"
#include "ringlet/scenes/frames/cut_list.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Files are made with the first frame; before it nothing in the folder is touched.
class RunWriters {
 public:
  /// The scene must outlive this. `hairs`: animations contain these in place of the strands. `frameCount`:
  /// frames of an earlier run that this one resumes; they are in the files already, and archive() restores
  /// the rest.
  RunWriters(const LoadedScene& scene, const RunOptions& options, std::optional<FullHair> hairs,
             int frameCount);

  /// Frames in order, from 1; points in the groom's unit and order, finite; with the poses of head and
  /// bodies.
  Status addFrame(int frame, std::vector<Vec3f> points, const HeadPose& head,
                  std::span<const BodyPose> bodies);
  /// Waits until everything added is on the disk.
  Status sync();
  /// Archives the state that is not in the files, for a checkpoint; without the last frame's points, since at
  /// least one frame follows.
  void archive(Archive& archive);
  /// Closes the files, after at least one frame, and returns their paths.
  Result<std::vector<std::filesystem::path>> finish();

  /// Largest distance of a point of an animation from its particle [m]; none if all files have full
  /// precision.
  std::optional<double> errorBound() const;
  /// How far hairs that follow are from where they would be; none if none is simulated as well.
  std::optional<FollowNumbers> followNumbers() const {
    return followWatch_ ? followWatch_->numbers() : std::nullopt;
  }
  std::size_t hairCount() const { return hairs_ ? hairs_->groom().strandCount() : 0; }  // that follow

 private:
  Status open();
  UsdExtras usdExtras() const;
  void addGroups(UsdExtras& extras) const;

  const LoadedScene& scene_;
  const RunOptions& options_;
  SceneFrames frames_;
  CutList cuts_;  // of strands
  std::optional<FullHair> hairs_;
  std::optional<FollowWatch> followWatch_;
  int frameCount_;
  bool isOpen_ = false;
  std::vector<std::unique_ptr<AnimationWriter>> animations_;
  std::optional<Sheet> sheet_;
  std::vector<Vec3f> lastPoints_;  // [file unit]
};

}  // namespace ringlet
