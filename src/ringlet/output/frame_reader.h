// FrameReader: the frames of an animation whose file says in front where each of them is: a crate
// (usd/usdc_reader.h) or an Alembic archive (alembic/abc_reader.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/up_axis.h"

namespace ringlet {

inline constexpr double kUsualWidth = 0.0005;  // of strands whose file does not say it [m]

class FrameReader {
 public:
  virtual ~FrameReader() = default;

  /// Frame 1 to frameCount(), in groom order and the file's unit, in the world, finite. Cost: a read of its
  /// bytes, the same for every frame. Where the head's motion is apart, points are brought to the world,
  /// which rounds them to float32. Errors: a frame that is not what the file says in front.
  virtual Status readFrame(int frame, std::vector<Vec3f>& points) = 0;

  int frameCount() const { return frameCount_; }  // of a `.partial` those that are whole
  double framesPerSecond() const { return framesPerSecond_; }
  double metresPerUnit() const { return metresPerUnit_; }
  UpAxis up() const { return up_; }
  float diameter() const { return diameter_; }                                  // of strands at their roots
  const std::vector<std::uint32_t>& firstPoint() const { return firstPoint_; }  // as in Groom
  std::uint64_t byteCount() const { return file_.size(); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 protected:
  static constexpr std::size_t kPointBytes = 12, kMatrixBytes = 128;

  explicit FrameReader(ReadFile file) : file_(std::move(file)) {}
  FrameReader(FrameReader&&) = default;
  FrameReader& operator=(FrameReader&&) = default;

  const std::filesystem::path& path() const { return file_.path(); }
  Error wrong(const std::string& what) const;
  Result<std::vector<std::byte>> read(std::uint64_t at, std::uint64_t count);

  /// What the file says of itself. Errors: numbers that no animation has. `names`: what the file calls rate
  /// and unit.
  Status takeMeasures(double rate, double unit, UpAxis up, const char* names);
  Status addStrand(double particles);
  /// After the measures and all strands; nothing: the file does not say it.
  Status takeDiameter(std::optional<double> diameter);
  /// So many frames; of one whose bytes were lost, what is in front may know: those are left out.
  void takeFrameCount(std::size_t count);

  /// Adds points of a frame; `head`: brings them to the world. Errors: one that is not finite.
  Status addPoints(int frame, std::span<const std::byte> bytes, const std::optional<UsdTransform>& head,
                   std::vector<Vec3f>& points) const;
  Error damaged(int frame, const char* what) const;
  static UsdTransform transformOf(std::span<const std::byte> matrix);

 private:
  ReadFile file_;
  int frameCount_ = 0;
  double framesPerSecond_ = 0, metresPerUnit_ = 0;
  UpAxis up_ = UpAxis::y;
  float diameter_ = 0;
  std::vector<std::uint32_t> firstPoint_{0};
  std::vector<std::string> warnings_;
};

}  // namespace ringlet
