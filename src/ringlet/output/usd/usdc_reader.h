// UsdcReader: the frames of an animation that usdc_writer.h wrote, finished or `.partial`, in any order.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

/// The head of the file and one frame are in memory.
class UsdcReader {
 public:
  /// Whether the file of that name begins as an animation of ours does: another program's is a groom.
  static bool isOurs(const std::filesystem::path& path);

  /// Reads everything but the frames. Errors: no such file, a crate that is damaged or that UsdcWriter did
  /// not write.
  static Result<UsdcReader> open(const std::filesystem::path& path);

  /// Frame 1 to frameCount(), in groom order and the file's unit, in the world, finite. Cost: a read of its
  /// bytes, the same for every frame. Where the head's motion is apart, points are brought to the world,
  /// which rounds them to float32. Errors: a frame that is not what the head says.
  Status readFrame(int frame, std::vector<Vec3f>& points);

  int frameCount() const { return frameCount_; }  // of a `.partial` those that are whole
  double framesPerSecond() const { return framesPerSecond_; }
  double metresPerUnit() const { return metresPerUnit_; }
  UpAxis up() const { return up_; }
  float diameter() const { return diameter_; }                                  // of strands at their roots
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }  // as in Groom
  std::uint64_t byteCount() const { return size_; }                             // of the file
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  // A prim's samples, as values of the crate; one a frame.
  struct Curves {
    std::uint32_t pointCount = 0;
    std::vector<std::uint64_t> points, heads;  // none: it has no transform
  };

  UsdcReader() = default;
  Status readHead();
  Status readLayer(const std::vector<std::byte>& head);
  Status readPoints(const Curves& curves, int frame, std::vector<Vec3f>& points);
  Result<std::vector<std::byte>> read(std::uint64_t at, std::uint64_t count);
  Error wrong(const std::string& what) const;

  OpenFile file_;
  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  int frameCount_ = 0;
  double framesPerSecond_ = 0, metresPerUnit_ = 0;
  UpAxis up_ = UpAxis::y;
  float diameter_ = 0;
  std::vector<std::uint32_t> firstPoint_{0};
  std::vector<Curves> curves_;
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
