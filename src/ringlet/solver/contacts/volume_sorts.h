// VolumeSorts: which steps put the volume's particles into the grid's cells.
#pragma once

#include <cstdint>

#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// The first step of a run does, and then one in volumeSortSteps, however the run is cut into frames.
class VolumeSorts {
 public:
  /// From the next step on whose turn it is.
  void setStep(double stepSeconds) { every_ = volumeSortSteps(stepSeconds); }
  /// Begins a frame of so many steps. Until the next, `sorts` is about this one.
  void beginFrame(std::uint32_t steps) {
    until_ = untilNext_;
    const std::uint32_t past = steps > until_ ? steps - until_ : 0;  // steps since the first that sorts
    untilNext_ = past == 0 ? until_ - steps : (every_ - past % every_) % every_;
  }
  bool sorts(std::uint32_t stepOfFrame) const {
    return stepOfFrame >= until_ && (stepOfFrame - until_) % every_ == 0;
  }
  /// Steps of this frame before the first that sorts.
  std::uint32_t until() const { return until_; }
  /// The next step is the first again.
  void forget() { until_ = untilNext_ = 0; }

  template <class Archive>
  void archive(Archive& archive) {
    archive.value(untilNext_);
  }
  bool isBetweenSorts() const { return untilNext_ > 0; }

 private:
  std::uint32_t every_ = 1, until_ = 0, untilNext_ = 0;
};

}  // namespace ringlet
