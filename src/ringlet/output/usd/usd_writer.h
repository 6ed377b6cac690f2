// UsdWriter: an animation of strands as USD text (.usda), one BasisCurves prim with time-sampled points,
// frame by frame. Houdini, usdview, Blender 4 and Maya play the file as it is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// Frame k (1 for the first) becomes the sample at time code k. While frames come, the file is
/// `PATH.partial`, and it is a whole, valid USD file at every moment, also in the middle of a frame: a killed
/// program leaves all finished frames in it. finish() renames it to PATH, so a PATH that is there is
/// finished. A frame that fails (full disk) leaves the frames before it.
class UsdWriter : public AnimationWriter {
 public:
  /// What every file begins with.
  static constexpr std::string_view kBegin = "#usda 1.0\n(\n    defaultPrim = \"Hair\"\n    endTimeCode = ";

  /// Creates the file and writes everything but the samples. Only the groom's strand lengths are used.
  static Result<UsdWriter> create(const std::filesystem::path& path, const Groom& topology,
                                  const AnimationOptions& options);

  /// Goes on with PATH.partial after its first `frameCount` frames, dropping what follows, to the bytes of a
  /// file written in one go; with 0 it begins anew. Errors: the file is not that of such an animation, or has
  /// fewer whole frames.
  static Result<UsdWriter> resume(const std::filesystem::path& path, const Groom& topology,
                                  const AnimationOptions& options, int frameCount);

  UsdWriter(UsdWriter&&) = default;
  UsdWriter& operator=(UsdWriter&&) = delete;
  /// Without finish(): leaves the partial file if it holds a frame, else removes it.
  ~UsdWriter() override;

  /// Adds a frame; points in the file's unit, in groom order, finite (see finite_points.h).
  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  /// What was added is on the disk.
  Status sync() override { return file_.sync(); }
  /// Closes the file with the frames so far (at least one) and gives it its name.
  Status finish() override;

  int frameCount() const override { return frameCount_; }
  std::uint64_t byteCount() const { return end_; }

 private:
  UsdWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
            const AnimationOptions& options);
  std::string headerText(const Groom& topology);
  Status writeFrame(std::span<const Vec3f> points, const UsdTransform& head);
  Status writeLine(std::span<const Vec3f> points);
  Status writeExtent(int frame, std::string text);
  Status writeHead(int frame, std::string text);
  Status clearPlaces(int frame);
  Status writeEndTimeCode();
  int timeCodeOf(int frame) const { return options_.usd.firstTimeCode - 1 + frame; }
  Status cutAfter(std::uint64_t lineBegin, std::uint64_t lineEnd);
  Status flush(std::uint64_t& offset);
  Error keepFinishedFrames(const Error& cause);

  ByteFile file_;                          // PATH.partial
  std::filesystem::path path_;             // PATH
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  AnimationOptions options_;
  std::string buffer_;               // text on its way to the file
  std::uint64_t endTimeCodeAt_ = 0;  // where the header's reserved last time code stands [byte]
  std::uint64_t extentsAt_ = 0;      // where the reserved lines for the extents begin [byte]
  std::uint64_t headsAt_ = 0;        // and those for the head's transforms
  float margin_ = 0;                 // of extents [file unit]
  std::vector<Vec3f> fromHead_;      // a frame, where the head is apart
  std::uint64_t end_ = 0;            // of what is valid: where the next frame's line begins [byte]
  std::uint64_t lineBytes_ = 0;      // of the line written last
  int frameCount_ = 0;
};

}  // namespace ringlet
