// UsdcWriter: an animation of strands as a crate (.usdc), frame by frame: USD like usd_writer.h's text in a
// third of the bytes, every bit of every point, and any frame at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/moving_points.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usdc_head.h"

namespace ringlet {

/// The k-th frame becomes the sample at the k-th time code. While frames come, the file is `PATH.partial`,
/// and it is a whole, valid crate at every moment, in which frames that are still to come are samples without
/// a value ("None"): a killed program leaves all finished frames in it. finish() leaves these samples out,
/// where there are fewer frames than were announced, and renames it to PATH. A frame that fails (full disk)
/// leaves the frames before it. Memory: the head, 24 bytes a frame that may come, and one frame; with
/// velocities two more.
/// Velocities are those of moving_points.h, and as late.
class UsdcWriter : public AnimationWriter {
 public:
  /// Creates the file and writes everything but the frames.
  static Result<UsdcWriter> create(const std::filesystem::path& path, const Groom& topology,
                                   const AnimationOptions& options);

  /// Goes on with PATH.partial after its first `frameCount` frames, dropping what follows, to the bytes of a
  /// file written in one go; with 0 it begins anew. Errors: the file is not that of such an animation, or has
  /// fewer whole frames.
  static Result<UsdcWriter> resume(const std::filesystem::path& path, const Groom& topology,
                                   const AnimationOptions& options, int frameCount);

  UsdcWriter(UsdcWriter&&) = default;
  UsdcWriter& operator=(UsdcWriter&&) = delete;
  /// Without finish(): leaves the partial file if it holds a frame, else removes it.
  ~UsdcWriter() override;

  /// Adds a frame. Cost: one write of its bytes, and one of eight bytes for all that moves.
  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  Status sync() override { return file_.sync(); }
  Status finish() override;
  int frameCount() const override { return frameCount_; }
  /// How far the file of the frames so far goes.
  std::uint64_t byteCount() const { return endOf(frameCount_); }

 private:
  // What moves of a prim; null: it has no such.
  struct Moving {
    const UsdcSamples *points = nullptr, *extent = nullptr, *velocities = nullptr, *head = nullptr;
  };

  UsdcWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
             const AnimationOptions& options);
  Moving movingOf(const HairCurves& curves) const;
  std::uint64_t endOf(int frame) const;
  Status writeFrame(std::span<const Vec3f> points, const UsdTransform& head);
  void putCurves(const HairCurves& curves, const UsdTransform& head);
  Status writeVelocities(int frame, std::span<const Vec3f> velocities);
  Status leadTo(int frame, bool later);
  Status forgetAfter(int frame);
  Status writeCounts(int frames);
  Status writeEndTimeCode();
  Status writeU64(std::uint64_t at, std::uint64_t value);
  Status cutAfter(int frame);
  Result<bool> isOurs(int frames) const;
  Status readBack(int frame, std::vector<Vec3f>& points) const;
  Error keepFinishedFrames(const Error& cause);

  ByteFile file_;               // PATH.partial
  std::filesystem::path path_;  // PATH
  std::vector<std::uint32_t> firstPoint_;
  AnimationOptions options_;
  std::vector<HairCurves> curves_;
  UsdcHead head_;
  std::string buffer_;  // a frame on its way to the file
  MovingPoints points_;
  int frameCount_ = 0;
};

}  // namespace ringlet
