// GoalsInput: places that particles are pulled to; empty for hair without the feature.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/strands.h"
#include "ringlet/base/vec3.h"
#include "ringlet/rest/goal_units.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

struct GroomGoal;

class GoalsInput : public FrameInput {
 public:
  /// Starts with the groom's own goal if Settings::goal is on; otherwise all strengths are 0. Fails when the
  /// device lacks memory.
  static Result<GoalsInput> create(const InputSource& from);

  /// As Simulation::setGoals: the goals at the end of the next written frame, and from then on.
  void set(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
           std::span<const Vec3f> from);

  Status prepare(const InputSource& from) override;
  void writeFrame(std::size_t slot, const FrameContext&) override;
  void setSettings(const Settings& before, const Settings& wanted) override;
  gpu::BufferTable bufferTable(std::size_t chunk) const override;

 private:
  std::uint64_t DeviceMemory::*kind() const override;
  GoalsInput() = default;
  void setOwn(const GoalSettings& settings);
  const StagedBuffer& before(std::size_t chunk) const { return staged_[2 * chunk]; }
  const StagedBuffer& after(std::size_t chunk) const { return staged_[2 * chunk + 1]; }

  bool areSet_ = false;
  std::span<const GroomChunk> chunks_;       // staged, of each: vec4[particle] before and after a frame
  std::vector<std::uint32_t> groomIndices_;  // of each particle, in device order
  const GroomGoal* own_ = nullptr;           // of the groom; null: none
  std::span<const GoalUnit> units_;          // of each particle, in device order; empty: no goals
  std::vector<layout::vec4> start_, end_;    // of the next frame, in device order
  bool move_ = false;                        // whether goals move in the next frame
  std::vector<bool> isWritten_;              // by slot: the slot has the present goals
};

}  // namespace ringlet
