// UsdReader: the animation that usd_writer.h wrote, frame by frame, for measuring it. Strict: it reads that
// one form of USD text, finished or `.partial`, and refuses everything else.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// Reads a few kilobytes at a time, whatever the size of the file: one frame of points is in memory.
class UsdReader {
 public:
  /// Reads everything before the first frame. Errors: no such file, or text that UsdWriter does not write.
  static Result<UsdReader> open(const std::filesystem::path& path);

  /// Sentences for a person: what is lost of the end of a `.partial`.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The next frame, in groom order and the file's unit; false after the last. Errors: as open(), a frame out
  /// of order, of the wrong number of points or with one that is not finite, a file cut short.
  Result<bool> readFrame(std::vector<Vec3f>& points);

  int frameCount() const {
    return frameCount_;
  }  // as the file states it; of a `.partial` those that are whole
  double framesPerSecond() const { return framesPerSecond_; }
  double metresPerUnit() const { return metresPerUnit_; }
  UpAxis up() const { return up_; }
  float diameter() const { return diameter_; }  // of every strand [file unit]
  const std::vector<std::uint32_t>& particleCounts() const { return particleCounts_; }  // of each strand

 private:
  UsdReader() = default;
  static Result<UsdReader> begin(const std::filesystem::path& path);
  Status readHeader();
  Status expectAll(std::initializer_list<std::string_view> tokens);
  Status readMeasures();
  Status readCounts();
  Status readWidth();
  Status countFrames();
  Status readEnd();
  Status skipAttribute();
  Status readHeads();
  Status readExtents();
  Result<Vec3f> readTuple();

  bool fill();
  char peek();
  void skipSpace();
  bool accept(std::string_view token);
  Status expect(std::string_view token);
  std::string word();
  Result<double> number();
  Result<float> coordinate();
  Error wanted(std::string_view what);

  OpenFile file_;
  std::filesystem::path path_;
  std::string buffer_;             // read, from at_ on not yet used
  std::size_t at_ = 0;             // in buffer_
  std::uint64_t bufferStart_ = 0;  // where buffer_ begins in the file [byte]
  int frameCount_ = 0, framesRead_ = 0;
  double framesPerSecond_ = 0, metresPerUnit_ = 0;
  UpAxis up_ = UpAxis::y;
  float diameter_ = 0;
  std::vector<UsdTransform> heads_;  // of each frame, where the head is apart
  bool isHeadApart_ = false;
  double firstTimeCode_ = 1;
  bool isPartial_ = false, isCounted_ = false, isFinished_ = false;
  std::vector<std::string> warnings_;
  std::vector<std::uint32_t> particleCounts_;
  std::size_t particleCount_ = 0;
};

}  // namespace ringlet
