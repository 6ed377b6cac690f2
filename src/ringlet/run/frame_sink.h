// FrameSink: processes computed frames. The frame loop hands frames over; they are measured, converted to the
// file's points and written on a WriterThread, in order.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/body_watch.h"
#include "ringlet/run/computed_frame.h"
#include "ringlet/run/writer_thread.h"

namespace ringlet {

/// Optional receivers of a frame, called on the writer's thread.
struct FrameReaders {
  BodyWatch* bodies = nullptr;
  /// `points`: in the groom's unit and order, finite.
  std::function<Status(const ComputedFrame&, std::span<const Vec3f> points)> observe;
  std::function<Status(int number, std::vector<Vec3f> points, const ComputedFrame& frame)> write;
  /// They need only the last frame; observe and write may get none before it.
  bool needLastOnly = false;
};

class FrameSink {
 public:
  /// `groom` must outlive this.
  FrameSink(const Groom& groom, FrameReaders readers);

  /// Waits while too many frames are waiting. An error of an earlier frame is returned here or by finish;
  /// frames handed over after it are dropped.
  Status hand(ComputedFrame frame);
  /// Memory of a processed frame, for the positions of the next; empty if there is none yet.
  std::vector<Vec3f> takeRoom();
  Status finish();
  /// Runs a job after the frames handed over so far, in order with them.
  Status handJob(WriterThread::Job job) { return thread_.hand(std::move(job)); }

  /// Archives what is known of the frames so far, for a checkpoint. Call it in a job, or before the first
  /// frame. Positions are not archived: at least one frame follows.
  void archive(Archive& archive);

  /// Number of frames processed so far; may be called at any time.
  int frameCount() const { return frameCount_; }

  // After finish:
  /// The largest number of particles without a finite position in one frame.
  std::size_t mostReplaced() const { return mostReplaced_; }
  /// Empty if there was no frame.
  std::vector<Vec3f> takeLastPositions() { return std::move(last_.positions); }
  double millisecondsWatching() const { return watching_; }
  double millisecondsWriting() const { return writing_; }

 private:
  Status take(ComputedFrame frame);
  Status show();

  const Groom& groom_;
  FrameReaders readers_;
  std::atomic<int> frameCount_ = 0;
  std::size_t mostReplaced_ = 0;
  ComputedFrame last_;
  bool isShown_ = true;  // whether the last frame was given to observe and write
  double watching_ = 0, writing_ = 0;
  std::mutex roomMutex_{};
  std::vector<Vec3f> room_{};
  WriterThread thread_;  // destroyed first: it uses the other members
};

}  // namespace ringlet
