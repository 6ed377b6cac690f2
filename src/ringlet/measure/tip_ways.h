// TipWays: how far tips of hair in motion are from where a rigid head would carry them, in two runs, and from
// each other. Together with contact_quality.h it tells whether contacts let hair move as it should: something
// that only holds hair still also keeps everything apart.
#pragma once

#include <optional>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/measure/groom_measure.h"

namespace ringlet {

/// Means over strands, and over frames if there are several [m]. Each tip is relative to its strand's root,
/// in the head's frame.
struct TipWays {
  double way = 0;    // distance from the tip's place at rest
  double other = 0;  // the same in the other run
  double apart = 0;  // distance from the tip of the other run

  /// Relative to the other run's distance from rest; none if tips are at rest in it.
  std::optional<double> wayShare() const { return share(way); }
  std::optional<double> apartShare() const { return share(apart); }

 private:
  std::optional<double> share(double of) const {
    return other > 0 ? std::optional(of / other) : std::nullopt;
  }
};

/// For a frame: points and other are groom `rest` in two runs, in its order and unit; the head's rotation is
/// fitted to the roots of each (head_fit.h). Errors: a tip or a root that is not finite, with its strand.
/// Cost: linear in strands.
Result<TipWays> tipWays(const GroomRuler& ruler, const Groom& rest, std::span<const Vec3f> points,
                        std::span<const Vec3f> other);

}  // namespace ringlet
