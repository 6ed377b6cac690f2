// AbcWriter: an animation of strands as an Alembic archive (.abc), frame by frame. All that leads to frames
// stands in front of them:
//
//   0   header: "Ogawa", 0xff, 00 01, the place of the root group
//   16  data that nothing leads to: kAbcMark, u64 the size of all in front, a digest of the tree of 0 frames
//   64  samples of what never moves; of what moves a group with a word for each frame that may come
//       room 0, room 1: a tree each (abc_out.h): headers with the counts of samples, and the root group
//   frame 1 | frame 2 | ...
//
// The tree of k frames stands in room k mod 2. A frame is written in this order:
//   1  its bytes, behind all others, where nothing leads yet
//   2  a word for each property that moves, which was empty data and leads to these bytes now. No count says
//      that it is there
//   3  the tree that counts it, in the room that the header does not lead to
//   4  the eight bytes of the header that lead to a room
// So the header leads to a whole tree at every moment, and all that the tree counts is there: an archive
// that was closed, of the frames so far. Trees of other counts differ in counts and hashes only: who reads
// one while it is written over, two frames later, finds counts whose frames are there. Words and the header's
// eight bytes are within a page each: a kill leaves such a write whole or undone (ByteFile).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/alembic/abc_stage.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/moving_points.h"

namespace ringlet {

/// What tells an animation of ours, and where it and the size of all in front of the frames stand.
inline constexpr std::string_view kAbcMark = "Ringlet frames 1";
inline constexpr std::uint64_t kAbcMarkAt = 16 + 8, kAbcFrontSizeAt = kAbcMarkAt + kAbcMark.size();

/// While frames come, the file is `PATH.partial`, and it is a whole archive at every moment: a killed program
/// leaves all finished frames in it. finish() renames it to PATH. A frame that fails (full disk) leaves the
/// frames before it. Memory: what is in front, which has 8 or 16 bytes a frame that may come of each property
/// that moves; 16 bytes a frame; and MovingPoints, by which velocities are as late as they are.
class AbcWriter : public AnimationWriter {
 public:
  /// Creates the file and writes everything but the frames.
  static Result<AbcWriter> create(const std::filesystem::path& path, const Groom& topology,
                                  const AnimationOptions& options);

  /// Goes on with PATH.partial after its first `frameCount` frames, dropping what follows, to the bytes of a
  /// file written in one go; with 0 it begins anew. Errors: the file is not that of such an animation, or has
  /// fewer whole frames.
  static Result<AbcWriter> resume(const std::filesystem::path& path, const Groom& topology,
                                  const AnimationOptions& options, int frameCount);

  AbcWriter(AbcWriter&&) = default;
  AbcWriter& operator=(AbcWriter&&) = delete;
  /// Without finish(): leaves the partial file if it holds a frame, else removes it.
  ~AbcWriter() override;

  /// Adds a frame. Cost: one write of its bytes, one of eight bytes for all that moves, one of the tree (some
  /// kilobytes).
  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  Status sync() override { return file_.sync(); }
  Status finish() override;
  int frameCount() const override { return frameCount_; }

 private:
  // What moves, and where its bytes are, from where those of a frame begin.
  struct Moving {
    AbcOutProperty* property = nullptr;
    std::uint64_t slot = 0;
  };

  AbcWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
            const AnimationOptions& options);
  void findMoving(std::vector<AbcOutProperty>& properties);
  void makeFront();

  std::uint64_t placeOf(int frame, const Moving& moving) const;
  std::uint64_t wordAt(int frame, const Moving& moving) const;
  std::uint64_t endOf(int frame) const;
  AbcTree treeOf(int room, int frames, int laterFrames);

  Status writeFrame(std::span<const Vec3f> points, const UsdTransform& head);
  void putSample(const Moving& moving, std::string_view values);
  void putPoints(const Moving& moving, std::span<const Vec3f> points);
  void signSample(const Moving& moving);
  Status writeVelocities(int frame, std::span<const Vec3f> velocities);
  Status leadTo(int frame, bool later);
  Status switchTo(int room, int frames, int laterFrames);
  Status writeCounts(int frames);
  Status writeU64(std::uint64_t at, std::uint64_t value);
  Status cutAfter(int frame);
  Result<bool> isOurs(int frames);
  Status readContents(int frames);
  Status readBack(int frame, std::vector<Vec3f>& points) const;
  Error keepFinishedFrames(const Error& cause);

  ByteFile file_;               // PATH.partial
  std::filesystem::path path_;  // PATH
  std::size_t pointCount_ = 0;
  AnimationOptions options_;
  AbcStage stage_;
  std::vector<Moving> moving_;  // what comes later last
  std::string front_;           // all in front of the frames, as it is before the first
  std::array<std::uint64_t, 2> rooms_{};
  std::uint64_t roomBytes_ = 0, earlyBytes_ = 0, frameBytes_ = 0;
  int room_ = 0;          // that the header leads to
  std::string contents_;  // digests of all that does not move, and with frame 1, 2, ...
  std::string buffer_;    // a frame on its way to the file, and what comes later of the one before
  MovingPoints points_;
  int frameCount_ = 0;
};

}  // namespace ringlet
