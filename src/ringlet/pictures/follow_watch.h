// FollowWatch: how far hairs that follow are from where they would be, by some that are simulated as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/vec3.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

/// Distances as shares of a hair's length, over all frames.
struct FollowNumbers {
  std::size_t hairs = 0;  // that were measured
  double rms = 0;         // of all their points
  double worst = 0;       // of the hair whose points are farthest off, their root mean square in a frame
};

class FollowWatch {
 public:
  /// Of a scene with LevelOfDetail::sample, which is copied.
  explicit FollowWatch(const LoadedScene& scene);

  /// A frame: of the strands that are simulated, and of all hairs, in one unit. Cost: points of the sample.
  void look(std::span<const Vec3f> strands, std::span<const Vec3f> hairs);

  /// None before the first frame.
  std::optional<FollowNumbers> numbers() const;
  void archive(Archive& archive) {
    archive.value(sum_);
    archive.value(worst_);
    archive.value(count_);
  }

 private:
  struct Sampled {
    std::size_t strand, hair, points;  // where its points begin, and their number
    double length;                     // at rest, in the groom's unit
  };
  std::vector<Sampled> sample_;
  double sum_ = 0, worst_ = 0;
  std::uint64_t count_ = 0;  // of points
};

}  // namespace ringlet
