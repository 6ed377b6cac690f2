// AbcReader: the frames of an animation that abc_writer.h wrote, finished or `.partial`, in any order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/frame_reader.h"

namespace ringlet {

class AbcArchive;
struct AbcProperty;
enum class AbcType : std::uint8_t;

/// What stands in front of the frames is read at once; then places of frames, 8 bytes each, and one frame are
/// in memory.
class AbcReader : public FrameReader {
 public:
  /// Whether the file of that name begins as an animation of ours does: another program's is a groom.
  static bool isOurs(const std::filesystem::path& path);

  /// Reads everything but the frames. Errors: no such file, an archive that is damaged or that AbcWriter did
  /// not write.
  static Result<AbcReader> open(const std::filesystem::path& path);

  Status readFrame(int frame, std::vector<Vec3f>& points) override;

 private:
  explicit AbcReader(ReadFile file) : FrameReader(std::move(file)) {}
  Status readFront();
  Status readMeasures(const AbcArchive& archive);
  Status readCurves(const AbcArchive& archive, std::uint32_t object);
  Status readStrands(const AbcArchive& archive, const std::vector<AbcProperty>& geometry);
  Status readHeads(const AbcArchive& archive, std::uint32_t transform);
  Result<std::vector<std::uint64_t>> placesOf(const AbcArchive& archive, const AbcProperty* property,
                                              AbcType type, unsigned width) const;
  Result<std::vector<std::byte>> readSample(std::uint64_t place, std::uint64_t count);

  std::vector<std::uint64_t> points_,
      heads_;  // places of samples, one a frame; no heads: it has no transform
};

}  // namespace ringlet
