// Implements bodies/body_distance.h.
#include "ringlet/bodies/body_distance.h"

#include "ringlet/bodies/grid_sample.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet {

double distanceTo(const Body& body, Vec3d place) {
  const BodyForm& form = formOf(body.shape);
  const double distance = form.distance ? form.distance(body, place) : sampleGrid(*body.grid, place).distance;
  return distance - body.thickness;
}

double distanceTo(const Body& body, const BodyPose& pose, Vec3d place) {
  return distanceTo(body, seenFrom(pose, place));
}

}  // namespace ringlet
