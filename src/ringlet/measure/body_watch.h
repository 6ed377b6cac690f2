// BodyWatch: how deep hair gets into bodies, over a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/body.h"

namespace ringlet {

/// Over all frames looked at.
struct BodyNumbers {
  double deepest = 0;                       // of any particle in any body, once it was outside of it [m]
  std::int64_t strand = -1, particle = -1;  // which it was, groom order; or -1
  std::int64_t frame = -1;                  // the look it was seen at, from 0
  std::size_t inside = 0;  // particles, times bodies, that have not yet been outside or on the surface
  double nearest = 1e300;  // from a body; half of what it is at least, as what is far is hardly looked at [m]
};

class BodyWatch {
 public:
  /// The first `rootCount` particles of a strand follow the head wherever it goes, and do not count.
  BodyWatch(const Groom& groom, std::span<const Body> bodies, int rootCount);

  /// Positions relative to the head's origin, groom order [m]; the bodies' poses in the world. Cost: some 20
  /// ns a particle and body, 100 of a distance grid; less where the particle before it is far from the body.
  void look(std::span<const Vec3f> positions, const HeadPose& head, std::span<const BodyPose> poses);

  BodyNumbers numbers() const;
  /// What was seen so far, for a checkpoint.
  void archive(Archive& archive) {
    archive.values(std::span(seen_));
    archive.value(numbers_);
    archive.value(looks_);
  }

 private:
  std::vector<std::uint32_t> firstPoint_;
  std::vector<Body> bodies_;
  std::size_t rootCount_;
  std::vector<std::uint8_t> seen_;  // where each was, by body, then particle
  BodyNumbers numbers_;
  std::int64_t looks_ = 0;
};

}  // namespace ringlet
