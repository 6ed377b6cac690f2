// Frames of several heads at once: in one submission, or in a command buffer of a host's. What does not
// depend on each other, the device does at the same time: many small heads together fill a device that one
// alone does not.
//
//   stepFrames({a, b, c})                                        -> a, b, c have stepped
//   recordFrames({a, b, c}, commands); the host submits, waits   -> a, b, c: frameIsOver
#pragma once

#include <span>

#include "ringlet/base/result.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// One frame of one head, as Simulation::stepFrame takes it.
struct HairFrame {
  Simulation* hair = nullptr;
  std::span<const HeadPose> stepPoses{};
  std::span<const BodyPose> bodyPoses{}, rootPoses{};
};

/// Simulation::stepFrame of each, with the same bits, in one submission; stageMilliseconds does not count it.
/// All are on one device, each once, and none has a frame in flight. Fails where stepFrame does; then nothing
/// can be told of any of them.
Status stepFrames(std::span<const HairFrame> frames);

/// The same into `commandBuffer`, a VkCommandBuffer that is being recorded outside a render pass, for a queue
/// of the device's family. What is recorded begins and ends with a barrier between compute, copies and, at
/// the end, the host; commands of the host's that read DevicePositions add one of their own, from compute
/// writes to their reads. It is submitted once, before any frame of these heads that is recorded later.
/// When the device is done with it, the host calls Simulation::frameIsOver of each head; only then is
/// anything else asked of it but a next frame: of which at most Simulation::kFramesInFlight are recorded and
/// not over, and with contacts, or where the head jumps (Settings::teleportDistance), one. Fails, before
/// anything is recorded, where that is not so. Cost: microseconds for each dispatch.
Status recordFrames(std::span<const HairFrame> frames, void* commandBuffer);

}  // namespace ringlet
