// Implements measure/pose_numbers.h.
#include "ringlet/measure/pose_numbers.h"

#include <algorithm>

#include "ringlet/base/assert.h"

namespace ringlet {

PoseNumbers poseNumbers(const Groom& rest, std::span<const Vec3f> points, Vec3d up, Quatd headRotation) {
  RINGLET_ASSERT(points.size() == rest.points.size(), "as many points as in the groom");
  PoseNumbers numbers;
  double droop = 0, lengths = 0, restLengths = 0;
  for (std::size_t s = 0; s < rest.strandCount(); ++s) {
    const std::span<const Vec3f> was = rest.strand(s), is = points.subspan(rest.firstPoint[s], was.size());
    const Vec3d restTip = Vec3d(was.back()) - Vec3d(was.front()), tip = Vec3d(is.back()) - Vec3d(is.front());
    droop += dot(rotate(headRotation, restTip) - tip, up);
    for (std::size_t i = 1; i < was.size(); ++i) {
      const double restLength = length(Vec3d(was[i]) - Vec3d(was[i - 1]));
      if (!(restLength > 0)) continue;
      const double now = length(Vec3d(is[i]) - Vec3d(is[i - 1]));
      lengths += now;
      restLengths += restLength;
      numbers.maxStretch = std::max(numbers.maxStretch, now / restLength);
    }
  }
  if (rest.strandCount() > 0)
    numbers.droop = droop * rest.metresPerUnit / static_cast<double>(rest.strandCount());
  if (restLengths > 0) numbers.meanStretch = lengths / restLengths;
  return numbers;
}

}  // namespace ringlet
