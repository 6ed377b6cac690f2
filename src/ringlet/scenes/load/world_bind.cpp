// Implements scenes/load/world_bind.h.
#include "ringlet/scenes/load/world_bind.h"

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

// Frame 1 is the motion's first pose.
double secondsOf(int frame, const SceneFile& scene) { return (frame - 1) / scene.simulation.framesPerSecond; }

BodyPose seenFrom(const HeadPose& carrier, const BodyPose& pose) {
  const Quatd toCarrier = carrier.rotation.conjugate();
  return {rotate(toCarrier, pose.position - carrier.position), normalized(toCarrier * pose.rotation)};
}

}  // namespace

WorldBind worldBindOf(const SceneFile& scene) {
  WorldBind bind;
  if (scene.groom.bind == "world") bind.groom = secondsOf(scene.groom.bindFrame, scene);
  for (const SceneBody& body : scene.bodies) {
    bind.bodies.emplace_back();
    if (body.bind == "world")
      bind.bodies.back() = secondsOf(body.bindFrame.value_or(scene.groom.bindFrame), scene);
  }
  return bind;
}

void bindInWorld(const WorldBind& bind, Motion& head, Groom& groom, std::span<Body> bodies) {
  RINGLET_ASSERT(bind.bodies.size() == bodies.size(), "every body is bound to something");
  if (bind.groom) {
    const HeadPose pose = head.poseAt(*bind.groom);
    head.axes = normalized(pose.rotation.conjugate() * head.axes);
    const Vec3d origin = pose.position / groom.metresPerUnit;
    for (Vec3f& point : groom.points) point = Vec3f(Vec3d(point) - origin);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bind.bodies[b]) continue;
    const Motion& carrier = bodies[b].motion ? *bodies[b].motion : head;
    bodies[b].place = seenFrom(carrier.poseAt(*bind.bodies[b]), bodies[b].place);
  }
}

}  // namespace ringlet
