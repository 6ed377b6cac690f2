// Implements follow_watch.h.
#include "ringlet/pictures/follow_watch.h"

#include <algorithm>
#include <cmath>

namespace ringlet {

FollowWatch::FollowWatch(const LoadedScene& scene) {
  const LevelOfDetail& level = *scene.level;
  const std::size_t guides = scene.groom.strandCount() - level.sample.size();
  for (std::size_t k = 0; k < level.sample.size(); ++k) {
    const auto strand = scene.groom.strand(guides + k);
    double sum = 0;
    for (std::size_t i = 1; i < strand.size(); ++i) sum += length(Vec3d(strand[i]) - Vec3d(strand[i - 1]));
    sample_.push_back(
        {scene.groom.firstPoint[guides + k], level.own.firstPoint[level.sample[k]], strand.size(), sum});
  }
}

void FollowWatch::look(std::span<const Vec3f> strands, std::span<const Vec3f> hairs) {
  for (const Sampled& each : sample_) {
    double squares = 0;
    for (std::size_t i = 0; i < each.points; ++i) {
      const Vec3d apart = Vec3d(strands[each.strand + i]) - Vec3d(hairs[each.hair + i]);
      squares += dot(apart, apart);
    }
    squares /= each.length * each.length;
    sum_ += squares;
    count_ += each.points;
    worst_ = std::max(worst_, std::sqrt(squares / static_cast<double>(each.points)));
  }
}

std::optional<FollowNumbers> FollowWatch::numbers() const {
  if (count_ == 0) return {};
  return FollowNumbers{sample_.size(), std::sqrt(sum_ / static_cast<double>(count_)), worst_};
}

}  // namespace ringlet
