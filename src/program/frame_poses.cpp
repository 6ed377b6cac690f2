// Implements frame_poses.h.
#include "program/frame_poses.h"

#include <algorithm>
#include <iterator>

namespace ringlet::program {

Result<FramePoses> posesOfFrame(const RunInput& input, int frame) {
  const Settings& settings = input.settings;
  FramePoses poses;
  std::vector<double> times;
  for (int step = 1; step <= settings.stepsPerFrame; ++step) {
    const double steps = static_cast<double>(frame) * settings.stepsPerFrame + step;
    times.push_back(steps / (settings.framesPerSecond * settings.stepsPerFrame));
    poses.heads.push_back(input.motion.poseAt(times.back()));
    if (input.scalp)
      std::ranges::copy(input.scalp->rootPosesAt(times.back()), std::back_inserter(poses.roots));
  }
  if (input.forces) {
    auto forces =
        input.forces->inFrame(frame / settings.framesPerSecond, (frame + 1) / settings.framesPerSecond,
                              input.motion, settings, input.keys);
    if (!forces) return forces.error();
    poses.forces = std::move(*forces);
  }
  poses.bodies = bodyPosesOf(input.bodies, poses.heads, times);
  return poses;
}

}  // namespace ringlet::program
