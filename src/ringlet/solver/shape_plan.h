// Which strands run in which shape: few kernels, and short strands that do not pay for long ones. Pure
// arithmetic, no device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// What a step asks of a strand, as far as shapes matter.
enum class StrandWork {
  hairAlone,  // `jacobi` without contacts, bodies, air or bending that varies along the strand: one or two
              // lanes solve it from its ends (shaders/integrators/two_way.glsl). What `ringlet tune` measures
  volume,     // the same with hair as a volume, without contacts of pairs: solved from its ends as well
  plain,      // all else but
  bodies,     // which ask for particles one by one
};
/// `kinds`: of contacts.
StrandWork strandWork(const Settings& settings, const Material& material, ContactKinds kinds, bool hasBodies);

/// Particles a lane can hold in registers: a GPU's registers are full long before a CPU device minds. There
/// the widest shape takes long runs, and one or two lanes that solve from the strand's ends. lanes 0: the
/// most of any number of lanes.
std::uint32_t longestRun(const DeviceLimits& limits, std::uint32_t lanes, StrandWork work);

/// Strands [begin, end) in device order, all of one shape.
struct StrandRange {
  StrandShape shape;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t longest = 0;  // particles of its longest strand
  std::uint32_t chunk = 0;    // the strands are within (groom_chunks.h)
};

/// Every shape the device has with runs in registers, and kAnySerialShape last, with the cost a model by kind
/// of device gives it. Where `measured` has some, theirs in place of it, and the others' in proportion.
std::vector<ShapeCost> shapeCosts(const DeviceLimits& limits, StrandWork work = StrandWork::hairAlone,
                                  std::span<const ShapeCost> measured = {});

/// Ranges of equal shape, the cheapest of all ways to cut. `particleCounts`: of the strands in device order,
/// rising. Where nobody asks for more, only strands that no run in registers holds have theirs in memory.
/// Fails where the choice asks for lanes that the device or the strands do not allow.
Result<std::vector<StrandRange>> planRanges(std::span<const std::uint32_t> particleCounts,
                                            const DeviceLimits& limits, const KernelChoice& choice,
                                            StrandWork work = StrandWork::hairAlone);

/// The same for some of the strands: each has the shape that planRanges gave strands as long.
std::vector<StrandRange> rangesOfPart(std::span<const StrandRange> whole,
                                      std::span<const std::uint32_t> particleCounts);

}  // namespace ringlet
