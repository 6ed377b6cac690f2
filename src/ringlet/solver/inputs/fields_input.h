// FieldsInput: the force fields that act on the hair; none for hair without the feature.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/fields.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/scene/force_field.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class FieldsInput : public FrameInput {
 public:
  /// Without fields.
  static Result<FieldsInput> create(const InputSource& from) { return create(from, {}); }
  /// Allocates room for these fields. Fails where checkForceField does, and when the device lacks memory.
  static Result<FieldsInput> create(const InputSource& from, std::span<const ForceField> fields);

  /// The fields as they are now.
  std::span<const ForceField> now() const { return from_; }
  std::size_t count() const { return to_.size(); }
  /// Whether these fields fit the buffers: the same number, with the same grids.
  bool hasRoomFor(std::span<const ForceField> fields) const;
  /// Sets the fields at the next frame's start and end. They must fit the buffers.
  void set(std::span<const ForceField> from, std::span<const ForceField> to);

  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  void jump(const FrameContext&) override { from_ = to_; }
  bool isQuiet(const FrameContext&) const override { return from_ == to_; }
  gpu::BufferTable bufferTable(std::size_t chunk) const override;
  std::uint64_t largestBuffer() const override;
  std::uint64_t bytes() const override { return FrameInput::bytes() + nodes_.bytes(); }

 private:
  explicit FieldsInput(gpu::Buffer nodes) : nodes_(std::move(nodes)) {}

  gpu::Buffer nodes_;  // of all grids, one after another; staged: StepField[step][field]
  std::vector<ForceField> from_, to_;
  std::vector<std::uint32_t> firstNodes_;  // of each field
};

}  // namespace ringlet
