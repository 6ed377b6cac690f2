// BodiesInput: bodies with their distance grids, and their poses from step to step.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class BodiesInput : public FrameInput {
 public:
  /// The bodies of InitialState. Fails where checkBody does, and when the device lacks memory.
  static Result<BodiesInput> create(const InputSource& from);
  /// Other bodies, for a head at `head`. places: their poses in the world; empty: the head carries them.
  static Result<BodiesInput> create(const InputSource& from, std::span<const Body> bodies,
                                    std::span<const BodyPose> places, const HeadPose& head);

  std::size_t count() const { return bodies_.size(); }

  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  void jump(const FrameContext& frame) override;
  bool isQuiet(const FrameContext& frame) const override;
  Status archive(Archive& archive) override {
    archive.values(std::span(now_));
    return {};
  }
  gpu::BufferTable bufferTable(std::size_t chunk) const override;
  std::uint64_t largestBuffer() const override;
  std::uint64_t bytes() const override;

 private:
  BodiesInput(gpu::Buffer rests, gpu::Buffer cells) : rests_(std::move(rests)), cells_(std::move(cells)) {}

  gpu::Buffer rests_;  // staged: BodyPose[1 + step][body]
  gpu::Buffer cells_;
  std::vector<Body> bodies_;
  std::vector<layout::BodyRest> packed_;  // for their bounds
  std::vector<BodyPose> now_;             // in the world
};

}  // namespace ringlet
