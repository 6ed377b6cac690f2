// FrameInput: one kind of outside influence on a head's hair, which the host sets frame by frame.
// frame_inputs.h lists them all; to add one, write a class and add it to the list there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/scene/body.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/inputs/staged_buffer.h"

namespace ringlet {

struct DeviceMemory;
struct InputSource;

/// The poses of a frame.
struct FrameContext {
  // [0]: one outer step before the frame; [1]: at its start; [2 + k]: at the end of its step k.
  std::span<const HeadPose> heads;
  std::span<const BodyPose> bodyPoses, rootPoses;  // as Simulation::stepFrame takes them
  BodyPoints bodyPoints;                           // likewise
  double seconds = 0;                              // since the simulation began, at the frame's start
  double stepSeconds = 0;

  std::size_t steps() const { return heads.size() - 2; }
  const HeadPose& end() const { return heads.back(); }
};

class FrameInput {
 public:
  virtual ~FrameInput() = default;

  /// Makes what the hair's features need and this lacks; its state stays. Bindings must then be made anew.
  /// Fails when the device lacks memory.
  virtual Status prepare(const InputSource&) { return {}; }
  /// Writes what kernels read in the frame of this slot.
  virtual void writeFrame(std::size_t slot, const FrameContext& frame) = 0;
  /// In place of writeFrame for a frame in which the head jumps, which is not stepped.
  virtual void jump(const FrameContext&) {}
  /// Whether this input does not change in this frame.
  virtual bool isQuiet(const FrameContext&) const { return true; }
  /// Changes from the first settings to the second, between frames.
  virtual void setSettings(const Settings&, const Settings&) {}
  /// Adapts to a step length multiplied by this share; velocities stay.
  virtual void rescale(double) {}
  /// Archives the state that later frames depend on and that the host does not set anew. Fails where the
  /// device does.
  virtual Status archive(Archive&) { return {}; }

  /// Bindings of the strand kernels for a chunk.
  virtual gpu::BufferTable bufferTable(std::size_t chunk) const = 0;
  /// Size of the largest buffer that kernels read as texels, and of all buffers on the device [bytes].
  virtual std::uint64_t largestBuffer() const;
  virtual std::uint64_t bytes() const;
  void addTo(DeviceMemory& memory) const;

  /// Records the copies to the device at the start of a frame of this slot.
  void record(gpu::CommandList& list, std::size_t slot) const {
    for (const StagedBuffer& staged : staged_) staged.record(list, slot);
  }

 protected:
  /// The member of DeviceMemory that `bytes` are added to.
  virtual std::uint64_t DeviceMemory::*kind() const;

  FrameInput() = default;
  FrameInput(FrameInput&&) = default;
  FrameInput& operator=(FrameInput&&) = default;
  /// Adds a buffer that is written for every frame; `bytes` may be 0. Fails when the device lacks memory.
  Status stage(const InputSource& from, std::uint64_t bytes, const char* name);
  std::uint64_t writtenBytes() const;  // host memory for all frames in flight

  std::vector<StagedBuffer> staged_;  // in the order they were added
};

}  // namespace ringlet
