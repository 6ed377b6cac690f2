// Stepper: what the frames of a run are stepped by, and looked at meanwhile.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/backend.h"
#include "program/frame_poses.h"
#include "program/simulate_run.h"
#include "program/stopwatch.h"
#include "ringlet/base/archive.h"
#include "ringlet/measure/contact_watch.h"

namespace ringlet::program {

/// Steps hair, with frames in flight; where contacts are to be measured step by step instead, to look at
/// each.
class Stepper {
 public:
  static Result<Stepper> make(Backend& backend, const RunInput& input, const RunOptions& options) {
    Stepper stepper(backend, input);
    if (!options.measuresContacts) return stepper;
    auto watch = ContactWatch::make(input.groom, input.material, input.settings);
    if (!watch) return watch.error();
    stepper.watch_.emplace(std::move(*watch));
    if (Status seen = stepper.look(); !seen) return seen.error();
    return stepper;
  }

  /// As Backend::submitFrame and waitFrame.
  Status submitFrame(const FramePoses& poses) {
    return watch_ ? lookAtSteps(poses) : poses.submit(*backend_);
  }
  Status waitFrame() {
    if (!watch_) {
      const Status waited = timedWait();
      if (waited) noteTime();
      return waited;
    }
    waited_ = std::move(looked_.front());
    looked_.pop_front();
    return {};
  }
  /// Of the frame waited for last, once. `room`: memory for them, of whatever size.
  std::vector<Vec3f> framePositions(std::vector<Vec3f> room) {
    if (watch_) return std::move(waited_);
    room.resize(pointCount_);
    Stopwatch stopwatch(copying_);
    backend_->framePositions(room);
    return room;
  }

  /// All that later frames depend on, none being in flight; and back, before the first.
  Status archive(Archive& archive) {
    std::vector<std::byte> hair;
    if (!archive.isReading()) {
      auto state = backend_->checkpoint();
      if (!state) return state.error();
      hair = std::move(*state);
    }
    archive.list(hair);
    if (archive.isReading()) {
      if (Status restored = backend_->restore(hair); !restored) return restored;
    }
    if (watch_) watch_->archive(archive);
    archive.value(worst_);
    return {};
  }

  /// What was seen goes into the outcome.
  Status tell(SimulateOutcome& outcome) const {
    outcome.waitedForDevice = waiting_;
    outcome.copied = copying_;
    outcome.frameTimes = timesOf(times_);
    if (hasContacts_) {
      auto report = backend_->contactReport();
      if (!report) return report.error();
      if (watch_) report->contacts = worst_.contacts, report->momentumError = worst_.momentumError;
      outcome.contacts = *report;
    }
    if (watch_) {
      outcome.contactNumbers = watch_->numbers();
      outcome.stages["measure"] = measuring_;
    }
    return {};
  }

  /// Steps that are frames of their own would be called wrong numbers of steps a frame.
  std::vector<std::string> warnings() const { return watch_ ? watch_->warnings() : backend_->warnings(); }

 private:
  Stepper(Backend& backend, const RunInput& input)
      : backend_(&backend),
        pointCount_(input.groom.points.size()),
        hasContacts_(input.settings.contacts.on),
        before_(sumOf(backend.stageMilliseconds())) {}

  Status timedWait() {
    Stopwatch stopwatch(waiting_);
    return backend_->waitFrame();
  }

  // Stages of stepping.
  static double sumOf(const std::map<std::string, double>& stages) {
    double sum = 0;
    for (const auto& [stage, milliseconds] : stages) sum += stage == kCopyStage ? 0 : milliseconds;
    return sum;
  }
  static std::optional<FrameMilliseconds> timesOf(std::vector<double> times) {
    if (times.empty()) return {};
    FrameMilliseconds told{.first = times.front()};
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::ranges::nth_element(times, middle);
    told.median = *middle;
    told.least = *std::ranges::min_element(times);
    return told;
  }
  // Of the frame that is over now.
  void noteTime() {
    if (!backend_->tellsTimesOfFrames()) return;
    const double now = sumOf(backend_->stageMilliseconds());
    times_.push_back(now - std::exchange(before_, now));
  }

  Status lookAtSteps(const FramePoses& poses) {
    for (std::size_t step = 0; step < poses.heads.size(); ++step) {
      {
        Stopwatch stopwatch(waiting_);
        if (Status stepped = poses.step(*backend_, step, 1); !stepped) return stepped;
      }
      if (Status seen = look(); !seen) return seen;
    }
    looked_.push_back(std::move(now_));
    noteTime();
    Stopwatch stopwatch(measuring_);
    if (!watch_->endFrame() || !hasContacts_) return {};
    auto report = backend_->contactReport();
    if (!report) return report.error();
    worst_ = *report;
    return {};
  }

  Status look() {
    Stopwatch stopwatch(measuring_);
    auto positions = backend_->positions();
    if (!positions) return positions.error();
    watch_->addStep(*positions);
    now_ = std::move(*positions);
    return {};
  }

  Backend* backend_;
  std::size_t pointCount_;  // of the groom
  bool hasContacts_;
  std::optional<ContactWatch> watch_;
  std::vector<Vec3f> now_, waited_;          // positions, where watch_ looks at steps
  std::deque<std::vector<Vec3f>> looked_{};  // of frames not waited for
  ContactReport worst_;
  double waiting_ = 0, measuring_ = 0, copying_ = 0;  // [ms]
  double before_;                                     // of stepping, in frames so far [ms]
  std::vector<double> times_{};                       // of each frame [ms]
};

}  // namespace ringlet::program
