// Stepper: steps the frames of a run, and measures while it does.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/stopwatch.h"
#include "ringlet/measure/contact_watch.h"
#include "ringlet/run/run_outcome.h"
#include "ringlet/run/scene_hair.h"
#include "ringlet/solver/diagnostics.h"

namespace ringlet {

/// Keeps frames in flight; if contacts are to be measured, it steps and measures one step at a time instead.
class Stepper {
 public:
  static Result<Stepper> make(SceneHair& hair, const LoadedScene& scene, bool measuresContacts) {
    Stepper stepper(hair, scene);
    if (!measuresContacts) return stepper;
    auto watch = ContactWatch::make(scene.groom, scene.material, scene.settings);
    if (!watch) return watch.error();
    stepper.watch_.emplace(std::move(*watch));
    if (Status seen = stepper.look(); !seen) return seen.error();
    return stepper;
  }

  /// As the functions of SceneHair.
  Status submit(const SceneFrame& frame) { return watch_ ? lookAtSteps(frame) : hair_->submit(frame); }
  Status wait() {
    if (!watch_) {
      const Status waited = timedWait();
      if (waited) noteTime();
      return waited;
    }
    waited_ = std::move(looked_.front());
    looked_.pop_front();
    return {};
  }
  /// Positions of the frame waited for last; call it once per frame. `room`: memory to use, of any size.
  std::vector<Vec3f> framePositions(std::vector<Vec3f> room) {
    if (watch_) return std::move(waited_);
    room.resize(pointCount_);
    Stopwatch stopwatch(copying_);
    hair_->framePositions(room);
    return room;
  }

  /// Saves the state that later frames depend on, with no frame in flight; restores it before the first
  /// frame, `frame`.
  Status save(Archive& archive) {
    auto state = hair_->checkpoint();
    if (!state) return state.error();
    archive.list(*state);
    archiveSeen(archive);
    return {};
  }
  Status restore(Archive& archive, const SceneFrames& frames, int frame) {
    std::vector<std::byte> state;
    archive.list(state);
    if (Status restored = hair_->restore(frames, frame, state); !restored) return restored;
    archiveSeen(archive);
    return {};
  }

  /// Adds what was measured to the outcome; `contacts`: the hair's present report.
  void tell(const ContactReport& contacts, RunOutcome& outcome) const {
    outcome.waitedForDevice = waiting_;
    outcome.copied = copying_;
    outcome.frameTimes = timesOf(times_);
    if (hasContacts_) outcome.contacts = contacts;
    if (!watch_) return;
    if (hasContacts_)
      outcome.contacts->contacts = worst_.contacts, outcome.contacts->momentumError = worst_.momentumError;
    outcome.contactNumbers = watch_->numbers();
    outcome.stages["measure"] = measuring_;
  }

  /// If contacts are measured, each step is a frame, so the solver's warnings about steps a frame would be
  /// wrong; the watch's warnings are returned instead.
  std::vector<std::string> warnings() const { return watch_ ? watch_->warnings() : hair_->facts().warnings; }

 private:
  Stepper(SceneHair& hair, const LoadedScene& scene)
      : hair_(&hair),
        pointCount_(scene.groom.points.size()),
        hasContacts_(scene.settings.contacts.on),
        before_(sumOf(hair.times().stages)) {}

  void archiveSeen(Archive& archive) {
    if (watch_) watch_->archive(archive);
    archive.value(worst_);
  }

  Status timedWait() {
    Stopwatch stopwatch(waiting_);
    return hair_->wait();
  }

  // Sum of the stages that are stepping.
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
  // Notes the time of the frame that has just ended.
  void noteTime() {
    if (!hair_->tellsTimesOfFrames()) return;
    const double now = sumOf(hair_->times().stages);
    times_.push_back(now - std::exchange(before_, now));
  }

  Status lookAtSteps(const SceneFrame& frame) {
    for (std::size_t step = 0; step < frame.stepCount(); ++step) {
      {
        Stopwatch stopwatch(waiting_);
        if (Status handed = hair_->submit(frame.step(step)); !handed) return handed;
        if (Status waited = hair_->wait(); !waited) return waited;
      }
      if (Status seen = look(); !seen) return seen;
    }
    looked_.push_back(std::move(now_));
    noteTime();
    Stopwatch stopwatch(measuring_);
    if (!watch_->endFrame() || !hasContacts_) return {};
    const auto reports = hair_->reports();
    if (!reports) return reports.error();
    worst_ = reports->contacts;
    return {};
  }

  Status look() {
    Stopwatch stopwatch(measuring_);
    auto positions = hair_->positions();
    if (!positions) return positions.error();
    watch_->addStep(*positions);
    now_ = std::move(*positions);
    return {};
  }

  SceneHair* hair_;
  std::size_t pointCount_;  // of the groom
  bool hasContacts_;
  std::optional<ContactWatch> watch_;
  std::vector<Vec3f> now_, waited_;          // positions, if watch_ measures steps
  std::deque<std::vector<Vec3f>> looked_{};  // positions of frames not waited for yet
  ContactReport worst_;
  double waiting_ = 0, measuring_ = 0, copying_ = 0;  // [ms]
  double before_;                                     // of stepping, over all frames so far [ms]
  std::vector<double> times_{};                       // of each frame [ms]
};

}  // namespace ringlet
