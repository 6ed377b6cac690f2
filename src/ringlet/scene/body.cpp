// Implements scene/body.h.
#include "ringlet/scene/body.h"

#include "ringlet/base/assert.h"

namespace ringlet {

BodyPose Body::poseAt(double t, const HeadPose& head) const {
  const HeadPose carrier = motion ? motion->poseAt(t) : head;
  return {carrier.position + rotate(carrier.rotation, place.position),
          normalized(carrier.rotation * place.rotation)};
}

std::vector<BodyPose> bodyPosesOf(std::span<const Body> bodies, std::span<const HeadPose> stepPoses,
                                  std::span<const double> times) {
  RINGLET_ASSERT(stepPoses.size() == times.size(), "every step has a time");
  std::vector<BodyPose> poses;
  poses.reserve(bodies.size() * stepPoses.size());
  for (std::size_t k = 0; k < stepPoses.size(); ++k) {
    for (const Body& body : bodies) poses.push_back(body.poseAt(times[k], stepPoses[k]));
  }
  return poses;
}

}  // namespace ringlet
