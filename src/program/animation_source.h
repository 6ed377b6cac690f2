// AnimationSource: the frames of an animation that `ringlet simulate` or `ringlet convert` wrote, whichever
// its format; finished or `.partial`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/usd_reader.h"

namespace ringlet::program {

/// float32, 16bit: as the user writes a cache's precision.
std::vector<std::string> precisionNames();
CachePrecision precisionByName(const std::string& name);
std::string nameOf(CachePrecision precision);

/// Whether the name is that of an animation: .usda or .rgc, and .partial after it.
bool isAnimation(const std::filesystem::path& path);

/// Whether it can be one by its name and, of .usda, which others write too, by its first lines as well.
bool holdsAnimation(const std::filesystem::path& path);

class AnimationSource {
 public:
  /// Errors: the name is of neither format, and those of the format's reader.
  static Result<AnimationSource> open(const std::filesystem::path& path);

  /// Makes frame 1 to frameCount() the groom's points; a later one than the call before. Errors: the
  /// reader's.
  Status readFrame(int frame);

  /// The strands; their points are those of the latest frame, none before the first.
  const Groom& groom() const { return groom_; }
  /// Of USD text, too, whose precision is float32.
  const CacheHeader& header() const { return header_; }
  int frameCount() const { return frameCount_; }
  bool isCache() const { return std::holds_alternative<CacheReader>(reader_); }
  bool isFinished() const { return isFinished_; }
  std::uint64_t byteCount() const { return byteCount_; }  // of the file
  /// The farthest that a point may be from the one that was written [m].
  double errorBound() const;
  double errorBound(int frame) const;
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Status checkEnd();

  explicit AnimationSource(std::variant<UsdReader, CacheReader> reader) : reader_(std::move(reader)) {}

  std::variant<UsdReader, CacheReader> reader_;
  Groom groom_;
  CacheHeader header_;
  int frameCount_ = 0, latest_ = 0;
  bool isFinished_ = true;
  std::uint64_t byteCount_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace ringlet::program
