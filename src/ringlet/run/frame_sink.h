// FrameSink: what becomes of a frame once it is computed. The frame loop hands frames over; they are looked
// at, turned into the file's points and written on a WriterThread, in order.
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

/// Who gets frames, each or none; all are called on the WriterThread.
struct FrameReaders {
  BodyWatch* bodies = nullptr;
  /// `points`: in the groom's unit and order, finite.
  std::function<Status(const ComputedFrame&, std::span<const Vec3f> points)> observe;
  std::function<Status(int number, std::vector<Vec3f> points, const ComputedFrame& frame)> write;
  /// Of the frames they need only the last; observe and write may get none before it.
  bool needLastOnly = false;
};

class FrameSink {
 public:
  /// `groom` must live as long.
  FrameSink(const Groom& groom, FrameReaders readers);

  /// Waits while too many frames are on their way. The failure of an earlier frame comes back here or from
  /// finish; what was handed over after it is dropped.
  Status hand(ComputedFrame frame);
  /// Memory of a frame that is done with, for positions of the next; empty if there is none yet.
  std::vector<Vec3f> takeRoom();
  Status finish();
  /// After the frames handed over so far, as one of them.
  Status handJob(WriterThread::Job job) { return thread_.hand(std::move(job)); }

  /// What is known of the frames so far, for a checkpoint: in a job, or before the first frame. Not their
  /// positions: at least one frame follows.
  void archive(Archive& archive);

  /// Frames done so far, at any time.
  int frameCount() const { return frameCount_; }

  // After finish:
  /// Most particles of a frame without a finite position.
  std::size_t mostReplaced() const { return mostReplaced_; }
  /// None: there was no frame.
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
  bool isShown_ = true;  // the last frame, to observe and write
  double watching_ = 0, writing_ = 0;
  std::mutex roomMutex_{};
  std::vector<Vec3f> room_{};
  WriterThread thread_;  // goes first: it works on the rest
};

}  // namespace ringlet
