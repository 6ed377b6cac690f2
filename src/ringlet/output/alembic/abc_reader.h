// AbcReader: the frames of an animation that abc_writer.h wrote, finished or `.partial`, in any order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

class AbcArchive;
struct AbcProperty;
enum class AbcType : std::uint8_t;

/// What stands in front of the frames is read at once; then places of frames, 8 bytes each, and one frame are
/// in memory.
class AbcReader {
 public:
  /// Whether the file of that name begins as an animation of ours does: another program's is a groom.
  static bool isOurs(const std::filesystem::path& path);

  /// Reads everything but the frames. Errors: no such file, an archive that is damaged or that AbcWriter did
  /// not write.
  static Result<AbcReader> open(const std::filesystem::path& path);

  /// Frame 1 to frameCount(), in groom order and the file's unit, in the world, finite. Cost: a read of its
  /// bytes, the same for every frame. Where the head's motion is apart, points are brought to the world,
  /// which rounds them to float32. Errors: a frame that is not what the archive says.
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
  AbcReader() = default;
  Status readFront();
  Status readMeasures(const AbcArchive& archive);
  Status readCurves(const AbcArchive& archive, std::uint32_t object);
  Status readStrands(const AbcArchive& archive, const std::vector<AbcProperty>& geometry);
  Status readHeads(const AbcArchive& archive, std::uint32_t transform);
  void leaveTornOut();
  Result<std::vector<std::uint64_t>> placesOf(const AbcArchive& archive, const AbcProperty* property,
                                              AbcType type, unsigned width) const;
  Result<std::vector<std::byte>> readSample(std::uint64_t place, std::uint64_t count);
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
  std::vector<std::uint64_t> points_,
      heads_;  // places of samples, one a frame; no heads: it has no transform
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
