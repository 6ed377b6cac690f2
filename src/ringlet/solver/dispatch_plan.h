// How a groom is cut into dispatches: which strands run in which form of the strand kernel, and how many
// steps each dispatch may do. Pure arithmetic, no device.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

/// What the plan must know of a device.
struct DeviceLimits {
  std::uint32_t subgroupSize = 1;
  bool hasSubgroupShuffle = false;
  bool isCpu = false;
  std::uint32_t maxGroupCount = 65535;
};

/// A strand laid over a device: lanes x run, or one thread per strand (lanes = 0).
struct StrandShape {
  std::uint32_t lanes = 0;
  std::uint32_t particlesPerLane = 0;

  bool serial() const { return lanes == 0; }
  std::uint32_t capacity() const { return lanes * particlesPerLane; }
  std::string describe() const;  // "lanes 4 x 16" or "serial"
  bool operator==(const StrandShape&) const = default;
};

/// Strands [begin, end) in device order, all of one shape.
struct StrandRange {
  StrandShape shape;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t longest = 0;  // particles of its longest strand
  std::uint32_t chunk = 0;    // the strands are within (groom_chunks.h)
};

/// One dispatch of a frame.
struct PlannedDispatch {
  std::uint32_t range = 0;  // index into the ranges
  std::uint32_t strandBegin = 0, strandEnd = 0;
  std::uint32_t stepBegin = 0, stepEnd = 0;
  std::uint32_t phases = 0, loopBegin = 0, loopEnd = 0;  // layout.h: StepParameters
  std::uint32_t groupCount = 0;
};

/// The shape for a strand of this many particles; the serial one where no other fits.
StrandShape chooseShape(std::uint32_t particleCount, const DeviceLimits& limits, const KernelChoice& choice);

/// Ranges of equal shape. `particleCounts`: of the strands in device order, rising. Fails where the choice
/// asks for lanes that the device or the strands do not allow.
Result<std::vector<StrandRange>> planRanges(std::span<const std::uint32_t> particleCounts,
                                            const DeviceLimits& limits, const KernelChoice& choice);

/// One solve with contacts on: which step, what it does, and whether it goes on to the next step's first
/// solve.
struct SolvePass {
  std::uint32_t step = 0;
  bool withContacts = false;  // else the first solve, without
  bool moves = false;         // it is the step's last
  bool goesOn = false;        // and the first of the step after follows
};

/// The dispatches of one pass, in order, as for planFrame. Fails where a step is too long for the device.
Result<std::vector<PlannedDispatch>> planPass(std::span<const StrandRange> ranges, const DeviceLimits& limits,
                                              const Settings& settings, std::size_t bodyCount,
                                              std::uint32_t groupSize, const SolvePass& pass);

/// The dispatches of one frame, in order; those of one range depend on each other, those of different ranges
/// do not. Fails where a step cannot be cut small enough for the device.
Result<std::vector<PlannedDispatch>> planFrame(std::span<const StrandRange> ranges,
                                               const DeviceLimits& limits, const Settings& settings,
                                               std::size_t bodyCount, std::uint32_t groupSize);

}  // namespace ringlet
