// UsdcReader: the frames of an animation that usdc_writer.h wrote, finished or `.partial`, in any order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/output/frame_reader.h"

namespace ringlet {

/// The head of the file and one frame are in memory.
class UsdcReader : public FrameReader {
 public:
  /// Whether the file of that name begins as an animation of ours does: another program's is a groom.
  static bool isOurs(const std::filesystem::path& path);

  /// Reads everything but the frames. Errors: no such file, a crate that is damaged or that UsdcWriter did
  /// not write.
  static Result<UsdcReader> open(const std::filesystem::path& path);

  Status readFrame(int frame, std::vector<Vec3f>& points) override;

 private:
  // A prim's samples, as values of the crate; one a frame.
  struct Curves {
    std::uint32_t pointCount = 0;
    std::vector<std::uint64_t> points, heads;  // none: it has no transform
  };

  explicit UsdcReader(ReadFile file) : FrameReader(std::move(file)) {}
  Status readHead();
  Status readLayer(const std::vector<std::byte>& head);
  Status readPoints(const Curves& curves, int frame, std::vector<Vec3f>& points);

  std::vector<Curves> curves_;
};

}  // namespace ringlet
