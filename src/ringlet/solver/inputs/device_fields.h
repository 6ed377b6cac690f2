// DeviceFields: the force fields on the hair of one head; empty if the hair was built without.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "layout/fields.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class DeviceFields {
 public:
  /// `mostSteps`: of a frame; `slots`: frames in flight. Fails where checkForceField does, and if the device
  /// lacks memory.
  static Result<DeviceFields> create(gpu::Device& device, std::span<const ForceField> fields, int mostSteps,
                                     std::size_t slots);

  /// The fields as they are now.
  std::span<const ForceField> now() const { return from_; }
  std::size_t count() const { return to_.size(); }
  /// Whether these fields fit the buffers: the same number, with the same grids.
  bool hasRoomFor(std::span<const ForceField> fields) const;

  /// Bindings of the strand kernels.
  gpu::BufferTable bufferTable() const {
    using namespace layout;
    return {{kBindFields, steps_.seen()},
            {kBindFieldNodes, nodes_},
            {kBindFieldTexels, steps_.seen()},
            {kBindFieldNodeTexels, nodes_}};
  }
  std::uint64_t largestBuffer() const { return std::max(steps_.bytes(), nodes_.bytes()); }
  std::uint64_t bytes() const { return steps_.bytes() + nodes_.bytes(); }
  /// Host memory for frames in flight [bytes].
  std::uint64_t writtenBytes() const { return steps_.writtenBytes(); }

  /// Sets the fields at the next frame's start and end. They must fit the buffers.
  void set(std::span<const ForceField> from, std::span<const ForceField> to);
  /// Whether the fields are the same in the next frame as in the last one.
  bool areQuiet() const { return from_ == to_; }
  /// Writes a slot's frame. heads[0] is the head at the frame's start, heads[1 + k] at the end of step k.
  void writeFrame(std::size_t slot, std::span<const HeadPose> heads, double stepSeconds);
  /// Ends a frame that is not stepped.
  void endFrame() { from_ = to_; }
  /// Records the copy to the device with which a frame of this slot begins.
  void record(gpu::CommandList& list, std::size_t slot) const { steps_.record(list, slot); }

 private:
  DeviceFields(FrameInput steps, gpu::Buffer nodes) : steps_(std::move(steps)), nodes_(std::move(nodes)) {}

  FrameInput steps_;   // StepField[step][field]
  gpu::Buffer nodes_;  // of all grids, one after another
  std::vector<ForceField> from_, to_;
  std::vector<std::uint32_t> firstNodes_;  // of each field
};

}  // namespace ringlet
