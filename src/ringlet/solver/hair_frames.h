// Frames of several heads at once: in one submission, or in a command buffer of a host. The device computes
// independent heads at the same time; many small heads together fill a device that one alone does not.
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
  BodyPoints bodyPoints{};
};

/// Simulation::stepFrame of each head, with the same bits, in one submission; stageMilliseconds does not
/// count it. One dispatch steps the heads of an asset that was built for many (KernelChoice::heads), where
/// their settings are equal and none has a material or root shifts of its own. All heads are on one device,
/// each is named once, and none has a frame in flight. Fails where stepFrame fails; the state of all heads is
/// then undefined.
Status stepFrames(std::span<const HairFrame> frames);

/// Records the same into `commandBuffer`, a VkCommandBuffer that is being recorded outside a render pass, for
/// a queue of the device's family. The commands begin and end with a barrier between compute, copies and, at
/// the end, the host; commands of the host that read DevicePositions need a barrier from compute writes to
/// their reads. The host submits the command buffer once, before any frame of these heads that is recorded
/// later. When the device has finished it, the host calls frameIsOver of each head. Until then
/// the host may only record further frames of a head: at most Simulation::kFramesInFlight may be recorded and
/// not over, and with contacts, or where the head jumps (Settings::teleportDistance), one. Fails, before
/// anything is recorded, where this is violated. Cost: microseconds for each dispatch.
Status recordFrames(std::span<const HairFrame> frames, void* commandBuffer);

/// To be called when the oldest frame of this head that recordFrames put into a host's command buffer is
/// done, and the host's commands that read it too; framePositions then returns it, as after waitFrame.
/// Without such a frame it does nothing. Where contact lists had no room for the frame, which happens in the
/// first frames of a run, it submits the rest of the frame to the device's queue and waits.
Status frameIsOver(Simulation& hair);

}  // namespace ringlet
