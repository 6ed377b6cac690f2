// Pc2Writer: an animation of strands as a point cache (.pc2), for Mesh Cache of Blender 3 and what else reads
// it: the points of every frame, and beside it the strands of the first as an .obj of the same name.
//
//   "POINTCACHE2\0" | version 1 i32 | points i32 | first frame f32 | frames a sample f32 | samples i32
//   points of frame 1, three f32 each | of frame 2 | ...
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/byte_file.h"

namespace ringlet {

/// While frames come, the file is `PATH.partial`, whole at every moment: a sample counts once its bytes are
/// there. Every bit of every point is kept; of unit, up axis, width and frames a second the format says
/// nothing.
class Pc2Writer : public AnimationWriter {
 public:
  /// As UsdWriter::resume. Errors: also more than 2^31 - 1 points, which the format cannot count.
  static Result<Pc2Writer> resume(const std::filesystem::path& path, const Groom& topology,
                                  const AnimationOptions& options, int frameCount);

  Pc2Writer(Pc2Writer&&) = default;
  ~Pc2Writer() override;

  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  Status sync() override { return file_.sync(); }
  Status finish() override;
  int frameCount() const override { return frameCount_; }

 private:
  Pc2Writer(ByteFile file, const std::filesystem::path& path, const Groom& topology)
      : file_(std::move(file)), path_(path), topology_(topology) {}
  std::uint64_t endOf(int frame) const;
  Status writeCount();

  ByteFile file_;
  std::filesystem::path path_;
  Groom topology_;
  int frameCount_ = 0;
};

}  // namespace ringlet
