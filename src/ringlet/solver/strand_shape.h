// How a strand may lie over a device, and what that costs: data for the choice in shape_plan.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ringlet {

/// Particles a lane holds: not fewer than can be pinned; of any device. A device's longest run: shape_plan.h.
inline constexpr std::uint32_t kShortestRun = 4, kLongestRun = 64;

/// What the plan must know of a device.
struct DeviceLimits {
  std::uint32_t subgroupSize = 1;  // the strand kernels are planned for, and ask for where they can
  bool hasSubgroupShuffle = false;
  bool isCpu = false;  // costs are those of a CPU device
  std::uint32_t maxGroupCount = 65535;
  bool endsLoopsEarly = false;  // ends all loops of an invocation after 65,535 turns together, without a word
  std::uint32_t minSubgroupSize = 0, maxSubgroupSize = 0;  // the powers of two that can be asked for; 0: none
                                                           // but subgroupSize
};

/// A strand laid over a device: lanes x run, or one thread per strand (lanes = 0).
struct StrandShape {
  std::uint32_t lanes = 0;  // a power of two, a subgroup at most
  std::uint32_t particlesPerLane = 0;

  bool serial() const { return lanes == 0; }
  std::uint32_t capacity() const { return lanes * particlesPerLane; }  // particles; serial: any number
  std::string describe() const;                                        // "lanes 4 x 16" or "serial"
  bool operator==(const StrandShape&) const = default;
};

/// Device time, strands being many.
struct ShapeCost {
  StrandShape shape;
  double nanoseconds = 0;  // of one outer step of one strand, however long; serial: of one of its particles
};

/// Of the code of the strand kernels for hair alone, 16 hexadecimal digits: with other code measured costs
/// mean nothing.
std::string strandKernelHash();

}  // namespace ringlet
