// BodiesInput: bodies with their distance grids, and their poses from step to step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "layout/bodies.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/rest/packed_bodies.h"
#include "ringlet/scene/body.h"
#include "ringlet/solver/inputs/bending_bodies.h"
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
  /// Whether a body bends.
  bool bends() const { return bending_.areThere(); }
  /// Whether one of them is cloth.
  bool isCloth() const { return std::ranges::any_of(bodies_, &Body::isCloth); }
  /// What the device does in the frame of this slot for the fields of bodies that bend, behind record().
  const BendingBodies::Work& fieldWork(std::size_t slot) const { return work_[slot]; }
  void recordFields(gpu::CommandList& list, std::size_t slot) const { bending_.record(list, work_[slot]); }

  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  void jump(const FrameContext& frame) override;
  bool isQuiet(const FrameContext& frame) const override;
  Status archive(Archive& archive) override {
    archive.values(std::span(now_));
    bending_.archive(archive);
    return {};
  }
  gpu::BufferTable bufferTable(std::size_t chunk) const override;
  std::uint64_t largestBuffer() const override;
  std::uint64_t bytes() const override;

 private:
  explicit BodiesInput(BendingBodies bending) : bending_(std::move(bending)) {}
  Status makeGrids(const InputSource& from, PackedBodies& bodies);

  Status makeLists(const InputSource& from);

  std::vector<gpu::Buffer> lists_;      // ClothList[cloth][particles], by chunk; empty if no body bends
  std::optional<gpu::Buffer> rests_;    // staged: BodyPose[1 + step][body]; points of bodies that bend
  std::unique_ptr<gpu::Buffer> pairs_;  // where it stays: bending_ writes into it
  BendingBodies bending_;
  std::vector<BendingBodies::Work> work_;  // by slot
  std::vector<Body> bodies_;
  std::vector<layout::BodyRest> packed_;  // for their bounds
  std::vector<BodyPose> now_;             // in the world
};

}  // namespace ringlet
