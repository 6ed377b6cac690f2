// ForeignFrames: the frames of an animation that another program wrote: curves of USD or Alembic files that
// move, one groom file a frame, or a point cache over a groom.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// What such files may leave open.
struct ForeignReading {
  std::optional<double> metresPerUnit{};  // unset: what the file states, else 0.01
  std::optional<bool> upIsZ{};            // USD is turned to it; unset: what the file states, else Y
  RootEnd rootEnd = RootEnd::first;
  std::uint32_t pointsPerStrand = 0;  // as of GroomReading
  double framesPerSecond = 24;        // of a sequence and a point cache, which do not say it
  std::filesystem::path groom{};      // whose points a point cache moves; empty: the .obj of its name
};

class ForeignFrames {
 public:
  virtual ~ForeignFrames() = default;
  /// Frame 1 to frameCount(), in any order, as readGroom() gives it. Errors: the reader's.
  virtual Result<LoadedGroom> frame(int frame, const GroomReading& reading) = 0;

  int frameCount() const { return frameCount_; }
  double framesPerSecond() const { return framesPerSecond_; }
  /// For people "USD", "Alembic", "sequence of .obj files"; for programs "usda", "abc", "sequence" ...
  const std::string& formatName() const { return formatName_; }
  const std::string& formatKey() const { return formatKey_; }
  /// What a person should hear beside what frames say.
  const std::vector<std::string>& warnings() const { return warnings_; }

 protected:
  int frameCount_ = 0;
  double framesPerSecond_ = 0;
  std::string formatName_{}, formatKey_{};
  std::vector<std::string> warnings_{};
};

/// Whether the name says that frames are files of their own: "hair.####.obj", where the #s stand for as many
/// digits or more.
bool isSequence(const std::filesystem::path& path);

/// Whether openForeignFrames() would find frames. Cost: of USD and Alembic a read of the file.
bool holdsForeignFrames(const std::filesystem::path& path);

/// Frames of curves are those at even steps that all samples are on, or as many as there are samples. Errors:
/// a name that is none of theirs; nothing that moves; a sequence with gaps; a cache without a groom or with
/// other points than it; those of the files' readers.
Result<std::unique_ptr<ForeignFrames>> openForeignFrames(const std::filesystem::path& path,
                                                         const ForeignReading& reading);

}  // namespace ringlet
