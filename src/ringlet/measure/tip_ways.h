// TipWays: how far the tips of hair in motion are from where a rigid head would carry them, in one run and in
// another, and from each other. With what contacts keep apart (contact_quality.h) it says whether contacts
// let hair move as it should: what only holds hair still keeps everything apart too.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet {

/// Means over strands, and over frames where there are several [m]. Each tip is seen from its strand's root,
/// in the head's frame.
struct TipWays {
  double way = 0;    // from where the tip is at rest
  double other = 0;  // the same in the other run
  double apart = 0;  // from the tip of the other run

  /// Of the way that tips go in the other run; nothing where they rest in it.
  std::optional<double> wayShare() const { return share(way); }
  std::optional<double> apartShare() const { return share(apart); }

 private:
  std::optional<double> share(double of) const {
    return other > 0 ? std::optional(of / other) : std::nullopt;
  }
};

/// Of a frame: points and other are groom `rest` in two runs, in its order and unit; the head is fitted to
/// the roots of each (head_fit.h). Errors: a tip or a root that is not finite, with its strand. Cost: linear
/// in strands.
Result<TipWays> tipWays(const GroomRuler& ruler, const Groom& rest, std::span<const Vec3f> points,
                        std::span<const Vec3f> other);

}  // namespace ringlet
