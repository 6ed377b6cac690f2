// AirInput: the air around the hair, with its wind and turbulence.
#pragma once

#include <vector>

#include "ringlet/gpu/buffer.h"
#include "ringlet/scene/wind.h"
#include "ringlet/solver/inputs/frame_input.h"

namespace ringlet {

class AirInput : public FrameInput {
 public:
  /// Fails when the device lacks memory.
  static Result<AirInput> create(const InputSource& from);

  bool isTurbulent() const { return !waves_.empty(); }

  void writeFrame(std::size_t slot, const FrameContext& frame) override;
  bool isQuiet(const FrameContext&) const override;
  /// The turbulence does not change.
  void setSettings(const Settings&, const Settings& wanted) override { settings_ = wanted.air; }
  gpu::BufferTable bufferTable(std::size_t chunk) const override;
  std::uint64_t bytes() const override { return FrameInput::bytes() + waveBuffer_.bytes(); }

 private:
  explicit AirInput(gpu::Buffer waves) : waveBuffer_(std::move(waves)) {}

  gpu::Buffer waveBuffer_;  // staged: StepAir[step]
  std::vector<WindMode> waves_;
  AirSettings settings_;
};

}  // namespace ringlet
