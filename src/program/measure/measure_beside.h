// MeasureBeside: a motion beside others of the same groom, frame by frame; `ringlet measure --against RUN`
// and
// `--without RUN`.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "program/measure/measure_report.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/contact_quality.h"
#include "ringlet/output/animation_reader.h"

namespace ringlet::program {

class MeasureBeside {
 public:
  /// The runs hold the strands of `rest`. Errors: those of ContactRuler::make.
  static Result<MeasureBeside> make(const Groom& rest, AnimationReader against,
                                    std::optional<AnimationReader> without);

  /// Frame `frame`, from 1, of the motion; in order. Those that another run lacks are passed over.
  Status addFrame(int frame, const GroomRuler& ruler, std::span<const Vec3f> points);

  MotionBeside result() const;
  /// The last frame that all have: of the motion, and of --against.
  std::span<const Vec3f> lastPoints() const { return lastPoints_; }
  std::span<const Vec3f> lastAgainst() const { return lastAgainst_; }

 private:
  MeasureBeside(const Groom& rest, AnimationReader against, std::optional<AnimationReader> without)
      : rest_(&rest), against_(std::move(against)), without_(std::move(without)) {}
  double overlapOf(std::span<const Vec3f> points) const;
  Result<std::vector<Vec3f>> pointsOf(AnimationReader& run, int frame) const;

  const Groom* rest_;
  AnimationReader against_;
  std::optional<AnimationReader> without_;
  std::optional<ContactRuler> contacts_;  // with without_
  std::vector<TipWays> frames_;
  std::vector<Vec3f> lastPoints_, lastAgainst_;                   // in the unit of `rest_`
  double overlap_ = 0, overlapAgainst_ = 0, overlapWithout_ = 0;  // beyond rest, of the worst frame
};

}  // namespace ringlet::program
