// DeviceGroom: the buffers of one groom on one device, and the ways in and out of them. Constant and changing
// data never share a buffer; all upload at creation and in setState, all download here.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/frame_input.h"
#include "shared/layout.h"

namespace ringlet {

struct DeviceGroom {
  gpu::Buffer positions, velocities, particles, strands, reports, scratch;
  FrameInput poses;                                    // StepPose[kMaxStepPoses]
  gpu::Buffer solved, contactSystems, contactControl;  // empty without contacts

  /// `scratchRecords`: vec4s of scratch (serial form) and taps. `slots`: frames in flight.
  /// `keepsSolved`: a solve's result stands beside the velocities it began from.
  static Result<DeviceGroom> create(gpu::Device& device, const RestState& rest, std::uint64_t scratchRecords,
                                    bool withContacts, bool keepsSolved, std::size_t slots);

  /// The buffers in binding order (layout.h).
  std::vector<std::reference_wrapper<const gpu::Buffer>> inBindingOrder() const {
    return {positions,      velocities,     particles, strands,    reports,   scratch, poses.seen(),  solved,
            contactSystems, contactControl, positions, velocities, particles, strands, contactSystems};
  }
  /// Whether the device sees all of them as texels.
  bool fitsTexels(const gpu::Device& device) const;
};

/// The groom's index of each particle, in device order.
std::vector<std::uint32_t> groomIndices(const RestState& rest);

/// From device order to groom order and back, a value per particle.
template <class To, class From, class Convert>
std::vector<To> inGroomOrder(const RestState& rest, std::span<const From> deviceValues, Convert convert) {
  std::vector<To> values(deviceValues.size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const std::size_t from = rest.strands[s].firstParticle, to = rest.firstInGroom[s];
    for (std::size_t i = 0; i < rest.strands[s].particleCount; ++i)
      values[to + i] = convert(deviceValues[from + i]);
  }
  return values;
}
template <class To, class From, class Convert>
std::vector<To> inDeviceOrder(const RestState& rest, std::span<const From> groomValues, Convert convert) {
  std::vector<To> values(groomValues.size());
  for (std::size_t s = 0; s < rest.strands.size(); ++s) {
    const std::size_t to = rest.strands[s].firstParticle, from = rest.firstInGroom[s];
    for (std::size_t i = 0; i < rest.strands[s].particleCount; ++i)
      values[to + i] = convert(groomValues[from + i]);
  }
  return values;
}

}  // namespace ringlet
