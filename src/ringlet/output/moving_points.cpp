// Implements output/moving_points.h.
#include "ringlet/output/moving_points.h"

#include <cstddef>
#include <utility>

namespace ringlet {

void seeFromHead(const UsdTransform& head, std::span<Vec3f> points) {
  const UsdTransform fromWorld = head.inverse();
  for (Vec3f& point : points) point = Vec3f(fromWorld(Vec3d(point)));
}

void MovingPoints::take(std::span<const Vec3f> points, const UsdTransform& head) {
  now_.assign(points.begin(), points.end());
  if (head_ != UsdHead::baked) seeFromHead(head, now_);
}

void MovingPoints::keep() {
  if (!keepsFrames_) return;
  std::swap(beforeLast_, last_);
  std::swap(last_, now_);
}

void MovingPoints::resume(std::vector<Vec3f> beforeLast, std::vector<Vec3f> last) {
  beforeLast_ = std::move(beforeLast);
  last_ = std::move(last);
}

std::vector<Vec3f> MovingPoints::velocitiesOfLast() const {
  return beforeLast_.empty() ? between(last_, now_, 1) : between(beforeLast_, now_, 2);
}

std::vector<Vec3f> MovingPoints::velocitiesAtEnd() const {
  return between(beforeLast_.empty() ? last_ : beforeLast_, last_, 1);
}

std::vector<Vec3f> MovingPoints::between(const std::vector<Vec3f>& before, const std::vector<Vec3f>& after,
                                         double frames) const {
  std::vector<Vec3f> velocities(after.size());
  const double rate = rate_ / frames;
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[i] = Vec3f((Vec3d(after[i]) - Vec3d(before[i])) * rate);
  return velocities;
}

}  // namespace ringlet
