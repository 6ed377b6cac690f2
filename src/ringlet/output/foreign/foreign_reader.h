// ForeignReader: an animation of another program as AnimationReader wants it: the same strands at every
// frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/foreign/foreign_frames.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

class ForeignReader {
 public:
  /// Reads its first frame, which says strands, unit and axis. Errors: those of openForeignFrames() and of
  /// that frame.
  static Result<ForeignReader> open(const std::filesystem::path& path, const ForeignReading& reading);

  /// Frame 1 to frameCount(), in groom order and the file's unit. Errors: the frame's; other strands than the
  /// first frame has.
  Status readFrame(int frame, std::vector<Vec3f>& points);

  int frameCount() const { return frames_->frameCount(); }
  double framesPerSecond() const { return frames_->framesPerSecond(); }
  double metresPerUnit() const { return metresPerUnit_; }
  bool statesUnit() const { return statesUnit_; }  // the file, or ForeignReading
  UpAxis up() const { return reading_.upIsZ ? UpAxis::z : UpAxis::y; }
  float diameter() const { return diameter_; }  // of the first strand at its root
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }
  const char* formatName() const { return frames_->formatName().c_str(); }
  const char* formatKey() const { return frames_->formatKey().c_str(); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  ForeignReader() = default;
  Status takeFirst(const ForeignReading& reading);
  Result<LoadedGroom> frameOf(int frame, const GroomReading& reading);

  std::filesystem::path path_;
  std::unique_ptr<ForeignFrames> frames_;
  GroomReading reading_{};
  double metresPerUnit_ = 0;
  bool statesUnit_ = false;
  float diameter_ = 0;
  std::vector<std::uint32_t> firstPoint_{0};
  std::vector<bool> isTurned_{};  // of each strand, where its last point is its root; empty: none
  std::vector<std::string> warnings_{};
};

}  // namespace ringlet
