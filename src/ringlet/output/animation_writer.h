// AnimationWriter: an animation of strands on its way into a file, whatever its format; and the formats there
// are. Programs go through the table.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// Frames come one by one into `PATH.partial`; finish() renames it to PATH, so a PATH that is there is
/// finished. A frame that fails (full disk) leaves the frames before it. Without finish() the partial file
/// stays if it holds a frame.
class AnimationWriter {
 public:
  virtual ~AnimationWriter() = default;
  /// Points in the file's unit, in groom order, finite (see finite_points.h).
  virtual Status addFrame(std::span<const Vec3f> points) = 0;
  /// What was added is on the disk.
  virtual Status sync() = 0;
  /// Closes the file with the frames so far (at least one) and gives it its name.
  virtual Status finish() = 0;
  virtual int frameCount() const = 0;
  /// The farthest that a point of the file may be from the one that was added [m]; nothing: formats that
  /// keep every bit.
  virtual std::optional<double> errorBound() const { return std::nullopt; }

 protected:
  AnimationWriter() = default;
  AnimationWriter(AnimationWriter&&) = default;
};

struct AnimationOptions {
  double framesPerSecond = 24;
  double metresPerUnit = 0.01;  // unit of points and diameter
  UpAxis up = UpAxis::y;
  float diameter = 0.05f;                              // of every strand [file unit]
  int frameCount = 1;                                  // most frames that will come; fewer may
  CachePrecision precision = CachePrecision::float32;  // of formats that have several
};

struct AnimationFormat {
  const char* extension;  // with its dot
  bool hasPrecisions;
  /// Goes on with PATH.partial after its first `frameCount` frames, to the bytes of a file written in one go;
  /// with 0 it begins anew. Only the topology's strand lengths are used. Errors: the file is not that of such
  /// an animation, or has fewer whole frames.
  Result<std::unique_ptr<AnimationWriter>> (*resume)(const std::filesystem::path& path, const Groom& topology,
                                                     const AnimationOptions& options, int frameCount);
};

/// .usda and .rgc.
std::span<const AnimationFormat> animationFormats();
/// By the ending of the name; null for one that is none of theirs.
const AnimationFormat* animationFormatOf(const std::filesystem::path& path);

}  // namespace ringlet
