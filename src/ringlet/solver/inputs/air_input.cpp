// Implements solver/inputs/air_input.h.
#include "ringlet/solver/inputs/air_input.h"

#include <utility>

#include "layout/bodies.h"
#include "ringlet/base/assert.h"
#include "ringlet/base/packed.h"
#include "ringlet/gpu/device_buffers.h"
#include "ringlet/solver/inputs/frame_inputs.h"

namespace ringlet {

Result<AirInput> AirInput::create(const InputSource& from) {
  const Settings& settings = from.settings;
  const std::vector<WindMode> waves = settings.air.on ? windModes(settings.air) : std::vector<WindMode>{};
  RINGLET_ASSERT(waves.empty() || waves.size() == layout::kWindWaves,
                 "turbulence has as many waves as kernels add");
  std::vector<layout::WindWave> packedWaves;
  for (const WindMode& wave : waves) packedWaves.push_back({packed(wave.wave), packed(wave.amplitude)});
  auto waveBuffer = createFilled(from.device, packedWaves, "turbulence");
  if (!waveBuffer) return waveBuffer.error();
  AirInput self(std::move(*waveBuffer));
  const auto steps = static_cast<std::uint64_t>(settings.stepsPerFrame);
  if (Status status = self.stage(from, settings.air.on ? steps * sizeof(layout::StepAir) : 0, "air"); !status)
    return status.error();
  self.waves_ = waves;
  self.settings_ = settings.air;
  return self;
}

// A step uses the air at its end. Its positions are relative to the place of the head at the step's start.
void AirInput::writeFrame(std::size_t slot, const FrameContext& frame) {
  if (!settings_.on) return;
  const auto out = staged_[0].of<layout::StepAir>(slot);
  for (std::size_t k = 0; k < frame.steps(); ++k) {
    const Vec3d from = frame.heads[1 + k].position, to = frame.heads[2 + k].position;
    const double t = frame.seconds + static_cast<double>(k + 1) * frame.stepSeconds;
    const Vec3d travel = (to - from) / frame.stepSeconds;
    layout::StepAir air{};
    air.wind = packed(evenWindAt(settings_, t) - travel);
    float phases[layout::kWindWaves] = {};
    for (std::size_t wave = 0; wave < waves_.size(); ++wave)
      phases[wave] = static_cast<float>(phaseAt(waves_[wave], from, t));
    for (std::size_t part = 0; part < 3; ++part)
      air.phases[part] = {phases[4 * part], phases[4 * part + 1], phases[4 * part + 2], phases[4 * part + 3]};
    out[k] = air;
  }
}

bool AirInput::isQuiet(const FrameContext&) const {
  return !settings_.on || (settings_.gust <= 0 && waves_.empty());
}

gpu::BufferTable AirInput::bufferTable(std::size_t) const {
  using namespace layout;
  return {{kBindAir, staged_[0].seen()},
          {kBindWindModes, waveBuffer_},
          {kBindAirTexels, staged_[0].seen()},
          {kBindWindModeTexels, waveBuffer_}};
}

}  // namespace ringlet
