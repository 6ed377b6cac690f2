// Layouts of a strand on a device and their costs: data for the choice in shape_plan.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ringlet {

/// Particles of a lane. The shortest run holds all particles that can be pinned. The longest in registers is
/// the limit over all devices (of one device: longestRun of shape_plan.h). The longest in memory: a CPU
/// device keeps 8 such runs, 3 MB, on the stack of a thread.
inline constexpr std::uint32_t kShortestRun = 4, kLongestRun = 64, kLongestRunInMemory = 1024;

/// The properties of a device that the plan depends on.
struct DeviceLimits {
  std::uint32_t subgroupSize = 1;  // width for which strand kernels are planned; they ask the driver for it
                                   // where they can
  bool hasSubgroupShuffle = false;
  bool isCpu = false;  // the cost model is that of a CPU device
  std::uint32_t maxGroupCount = 65535;
  bool endsLoopsEarly = false;  // ends an invocation's loops silently after 65,535 turns in all
  std::uint32_t minSubgroupSize = 0, maxSubgroupSize = 0;  // powers of two that can be asked for; 0: only
                                                           // subgroupSize
  std::uint32_t longestRunInMemory = kLongestRunInMemory;
};

/// A strand laid over a device: lanes x run.
struct StrandShape {
  std::uint32_t lanes = 0;             // a power of two, a subgroup at most
  std::uint32_t particlesPerLane = 0;  // the run
  bool inMemory = false;               // the run is in memory: slower than in registers, but it may be long

  bool serial() const { return inMemory && lanes == 1; }  // needs no subgroup operations
  std::uint32_t capacity() const { return lanes * particlesPerLane; }
  std::string describe() const;  // "lanes 4 x 16", "memory 8 x 96" or "serial 1 x 96"
  bool operator==(const StrandShape&) const = default;
};

/// Stands for all serial shapes; its cost is that of a single particle.
inline constexpr StrandShape kAnySerialShape{.lanes = 1, .particlesPerLane = 0, .inMemory = true};

/// Device time, for many strands.
struct ShapeCost {
  StrandShape shape;
  double nanoseconds = 0;  // of one outer step of one strand, whatever its length; kAnySerialShape: of one
                           // particle
};

/// Hash of the code of the strand kernels for hair alone, 16 hexadecimal digits. Measured costs hold for this
/// code only.
std::string strandKernelHash();

}  // namespace ringlet
