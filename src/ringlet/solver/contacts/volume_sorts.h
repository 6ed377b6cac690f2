// VolumeSorts: the steps in which the volume's particles are sorted into the grid's cells.
#pragma once

#include <cstdint>

#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// The first step of a simulation sorts, and then every volumeSortSteps-th, independently of frames.
class VolumeSorts {
 public:
  /// Applies from the next step that sorts.
  void setStep(double stepSeconds) { every_ = volumeSortSteps(stepSeconds); }
  /// Begins a frame of this many steps; `sorts` and `until` then refer to this frame.
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
  /// Makes the next step count as the first.
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
