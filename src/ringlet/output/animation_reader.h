// AnimationReader: the frames of an animation: one that an AnimationWriter wrote, of any format that can be
// read, finished or `.partial`; or another program's (foreign/foreign_frames.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/alembic/abc_reader.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/foreign/foreign_reader.h"
#include "ringlet/output/usd/usd_reader.h"
#include "ringlet/output/usd/usdc_reader.h"

namespace ringlet {

/// Whether the name is that of an animation: one of animationFormats() that is read, and .partial after it.
bool isAnimation(const std::filesystem::path& path);

/// Whether AnimationReader would find frames: by the name and, of USD and Alembic, which others write too, by
/// how the file begins or by whether its curves move.
bool holdsAnimation(const std::filesystem::path& path);

/// The file that `path` stands for: of a run's folder the animation in it, a finished one rather than one
/// that is not; else itself. An Error where the folder holds none.
Result<std::filesystem::path> animationFileOf(const std::filesystem::path& path);

class AnimationReader {
 public:
  /// `reading` is for files of other programs. Errors: the name is of no format, and those of the format's
  /// reader.
  static Result<AnimationReader> open(const std::filesystem::path& path, const ForeignReading& reading = {});

  /// Makes frame 1 to frameCount() the groom's points; a later one than the call before. Errors: the
  /// reader's. Cost: text that Ringlet wrote is read from frame to frame, all else at once.
  Status readFrame(int frame);

  /// The strands; their points are those of the latest frame, none before the first.
  const Groom& groom() const { return groom_; }
  /// Of USD and Alembic, too, whose precision is float32.
  const CacheHeader& header() const { return header_; }
  int frameCount() const { return frameCount_; }
  bool isCache() const { return std::holds_alternative<CacheReader>(reader_); }
  bool isForeign() const { return std::holds_alternative<ForeignReader>(reader_); }
  /// Whether header().metresPerUnit is what the file, or ForeignReading, says; else it is only the usual one.
  bool statesUnit() const {
    const auto* foreign = std::get_if<ForeignReader>(&reader_);
    return !foreign || foreign->statesUnit();
  }
  /// For people "USD text", "USD crate", "Alembic" or "cache"; for programs "usd", "usdc", "abc" or "cache".
  /// Of another program's as ForeignFrames has them.
  const char* formatName() const;
  const char* formatKey() const;
  bool isFinished() const { return isFinished_; }
  std::uint64_t byteCount() const { return byteCount_; }  // of the file
  /// The farthest that a point may be from the one that was written [m].
  double errorBound() const;
  double errorBound(int frame) const;
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  using Reader = std::variant<UsdReader, UsdcReader, AbcReader, CacheReader, ForeignReader>;
  explicit AnimationReader(Reader reader) : reader_(std::move(reader)) {}
  void take(const UsdReader& usd);
  void take(const FrameReader& frames);
  void take(const CacheReader& cache);
  void take(const ForeignReader& foreign);
  void takeHeader(const auto& reader);
  Status checkEnd(UsdReader& usd);

  Reader reader_;
  Groom groom_;
  CacheHeader header_;
  int frameCount_ = 0, latest_ = 0;
  bool isFinished_ = true;
  std::uint64_t byteCount_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
