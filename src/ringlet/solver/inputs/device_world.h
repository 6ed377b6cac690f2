// DeviceWorld: bodies with their distance grids, and the air, on a device.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/settings.h"
#include "ringlet/scene/wind.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class DeviceWorld {
 public:
  /// Fails where checkBody does, and when the device lacks memory. `start`: the head's pose now. `slots`:
  /// frames in flight.
  static Result<DeviceWorld> create(gpu::Device& device, std::span<const Body> bodies,
                                    const Settings& settings, const HeadPose& start, std::size_t slots);

  std::size_t bodyCount() const { return bodies_.size(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// The poses of bodies now, in the world.
  const std::vector<BodyPose>& places() const { return now_; }
  bool isTurbulent() const { return !waves_.empty(); }

  /// Bindings of the strand kernels.
  gpu::BufferTable bufferTable() const {
    using namespace layout;
    return {{kBindBodies, rests_},         {kBindBodyPoses, poses_.seen()},
            {kBindGridCells, cells_},      {kBindAir, air_.seen()},
            {kBindWindModes, waveBuffer_}, {kBindBodyTexels, rests_},
            {kBindGridCellTexels, cells_}, {kBindBodyPoseTexels, poses_.seen()},
            {kBindAirTexels, air_.seen()}, {kBindWindModeTexels, waveBuffer_}};
  }
  std::uint64_t largestBuffer() const { return std::max(cells_.bytes(), poses_.bytes()); }
  std::uint64_t bytes() const {
    return rests_.bytes() + poses_.bytes() + cells_.bytes() + air_.bytes() + waveBuffer_.bytes();
  }
  /// Host memory for frames in flight [bytes].
  std::uint64_t writtenBytes() const { return poses_.writtenBytes() + air_.writtenBytes(); }

  /// Sets the poses of bodies before the next step, in the world.
  void placeBodies(std::span<const BodyPose> poses) { now_.assign(poses.begin(), poses.end()); }
  /// Sets another step length and other air; the turbulence stays.
  void setSettings(const Settings& settings) {
    airSettings_ = settings.air;
    stepSeconds_ = settings.stepSeconds();
  }
  /// Writes poses and air of the frame of a slot. heads[0] is the head at the frame's start, heads[1 + k] at
  /// the end of step k; `poses` as bodyPosesOf gives them, or none: then the head carries all. `seconds`:
  /// since the simulation began.
  void writeFrame(std::size_t slot, std::span<const HeadPose> heads, std::span<const BodyPose> poses,
                  double seconds);
  /// Records the copy to the device with which a frame of this slot begins.
  void record(gpu::CommandList& list, std::size_t slot) const {
    poses_.record(list, slot);
    air_.record(list, slot);
  }
  /// The poses of bodies now.
  void archive(Archive& archive) { archive.values(std::span(now_)); }
  /// Whether bodies stay at rest in a frame, `poses` as above, and the air does not change.
  bool isQuiet(std::span<const BodyPose> poses) const;
  /// Ends a frame that is not stepped: bodies are at their last poses, `poses` as above.
  void endFrame(const HeadPose& head, std::span<const BodyPose> poses);

 private:
  DeviceWorld(gpu::Buffer rests, FrameInput poses, gpu::Buffer cells, FrameInput air, gpu::Buffer waves)
      : rests_(std::move(rests)),
        poses_(std::move(poses)),
        cells_(std::move(cells)),
        air_(std::move(air)),
        waveBuffer_(std::move(waves)) {}
  void writeAir(std::span<layout::StepAir> out, std::span<const HeadPose> heads, double seconds) const;

  gpu::Buffer rests_;
  FrameInput poses_;  // BodyPose[step][body]
  gpu::Buffer cells_;
  FrameInput air_;  // StepAir[step]
  gpu::Buffer waveBuffer_;
  std::vector<Body> bodies_;
  std::vector<layout::BodyRest> packed_;  // for their bounds
  std::vector<BodyPose> now_;             // in the world
  std::vector<WindMode> waves_;
  AirSettings airSettings_;
  double stepSeconds_ = 0;
};

}  // namespace ringlet
