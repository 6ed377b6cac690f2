// FollowWatch: how far hairs that follow are from where they would be, by some that are simulated as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/vec3.h"
#include "ringlet/measure/follow_numbers.h"
#include "ringlet/scenes/load/load_scene.h"

namespace ringlet {

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
