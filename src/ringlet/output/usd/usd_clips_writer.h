// UsdClipsWriter: an animation of strands as USD in parts: `hair.usda`, which says all but what moves, and
// value clips beside it, crates of so many frames each.
//
//   hair.usda                     the prim, and which clip holds which time
//   hair_clips/manifest.usda      the attributes of the clips
//   hair_clips/hair.0001.usdc     frames 1 to N; 0002: N + 1 to 2 N; ...
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/usd/usdc_writer.h"

namespace ringlet {

/// Every clip is an animation of its own (usdc_writer.h), whose first time code is that of its first frame,
/// and whole once its frames are there. While frames come, `PATH.partial` lists the clips that are; the
/// frames after them are in the next clip's own `.partial`. Velocities of a clip's first and last frame are
/// of what the points move within it. Between the last frame of a clip and the first of the next USD takes
/// the former.
class UsdClipsWriter : public AnimationWriter {
 public:
  /// Goes on after so many frames, as UsdcWriter::resume does; options.usd.clipFrames of them in each clip.
  static Result<UsdClipsWriter> resume(const std::filesystem::path& path, const Groom& topology,
                                       const AnimationOptions& options, int frameCount);

  UsdClipsWriter(UsdClipsWriter&&) = default;
  ~UsdClipsWriter() override;

  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  Status sync() override;
  Status finish() override;
  int frameCount() const override { return frameCount_; }

  /// Where the clip stands, from 1, of an animation of that name.
  static std::filesystem::path clipPath(const std::filesystem::path& path, int clip);

 private:
  UsdClipsWriter(const std::filesystem::path& path, const Groom& topology, const AnimationOptions& options)
      : path_(path), topology_(topology), options_(options) {}
  void removeStale() const;
  Status openClip(int framesOfIt);
  Status closeClip();
  Status writeManifest() const;
  Status writeTop(const std::filesystem::path& as) const;
  int framesBefore(int clip) const { return (clip - 1) * options_.usd.clipFrames; }

  std::filesystem::path path_;
  Groom topology_;
  AnimationOptions options_;
  std::unique_ptr<UsdcWriter> clip_;  // that frames go into; none: the next begins with the next frame
  int wholeClips_ = 0, frameCount_ = 0;
};

}  // namespace ringlet
