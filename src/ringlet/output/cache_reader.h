// CacheReader: the frames of a cache (.rgc), finished or `.partial`, in any order.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/cache_format.h"

namespace ringlet {

/// One frame is in memory at a time. Whatever the file says, memory stays below 1,000 times its size.
class CacheReader {
 public:
  /// Reads the strands and where the frames are: from the index, or, where that is missing or damaged, by
  /// going from frame to frame. Errors: no such file, no cache, a damaged beginning.
  static Result<CacheReader> open(const std::filesystem::path& path);

  /// Frame 1 to frameCount(), in groom order and the file's unit, finite. Cost: the same for every frame.
  /// Errors: a frame whose bytes are not those that were written; others can still be read.
  Status readFrame(int frame, std::vector<Vec3f>& points);

  int frameCount() const { return static_cast<int>(frames_.size()); }
  const CacheHeader& header() const { return header_; }
  std::size_t strandCount() const { return firstPoint_.size() - 1; }
  std::size_t particleCount() const { return firstPoint_.back(); }
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }  // as in Groom
  std::uint64_t byteCount() const { return file_.size(); }
  /// The farthest that a point of this frame, or of any, may be from the one that was written [m].
  double errorBound(int frame) const { return frames_[static_cast<std::size_t>(frame) - 1].errorBound; }
  double errorBound() const;
  /// Where a frame's bytes begin and end in the file.
  std::uint64_t frameOffset(int frame) const { return frames_[static_cast<std::size_t>(frame) - 1].offset; }
  std::uint64_t endOf(int frame) const;
  /// Whether its writer came to the end. Of others the frames so far are here.
  bool isFinished() const { return isFinished_; }
  /// Sentences for a person: what was lost of the file's end.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Frame {
    std::uint64_t offset = 0;  // of its chunk [byte]
    double errorBound = 0;     // [m]
  };

  explicit CacheReader(ReadFile file) : file_(std::move(file)) {}
  Status readHeader();
  Status readStrands();
  bool readIndex();
  void scan();
  bool readChunk(std::uint64_t offset, cache::ChunkKind kind, std::uint64_t number,
                 std::uint64_t contentBytes, std::vector<std::byte>& content);
  Error damaged(std::string_view what) const;

  ReadFile file_;
  std::uint64_t framesAt_ = 0;  // where the first frame's chunk begins [byte]
  CacheHeader header_;
  std::vector<std::uint32_t> firstPoint_{0};
  std::vector<Frame> frames_;
  std::uint64_t framesEnd_ = 0;             // where the last frame's chunk ends [byte]
  std::vector<std::byte> chunk_, content_;  // kept from one frame to the next
  bool isFinished_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
