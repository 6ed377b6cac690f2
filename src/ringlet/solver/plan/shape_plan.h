// Chooses the shape of each strand: few kernels, and short strands in shapes of their own. Pure arithmetic,
// no device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/solver/simulation.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// Kinds of steps with different costs of shapes.
enum class StrandWork {
  hairAlone,  // `jacobi` without contacts, bodies, air or bending that varies along the strand; one or two
              // lanes solve it from the strand's ends (shaders/integrators/two_way.glsl). `ringlet tune`
              // measures this one
  volume,     // the same with hair as a volume and without contacts of pairs; also solved from the strand's
              // ends
  plain,      // everything else without bodies
  bodies,     // with bodies, which access particles one by one
};
/// `kinds`: of contacts.
StrandWork strandWork(const Settings& settings, const Material& material, ContactKinds kinds, bool hasBodies);

/// The most particles that a lane may hold in registers; few on a GPU. On a CPU device the widest shape may
/// have long runs, and so may one or two lanes, which solve from the strand's ends. lanes 0: the most for any
/// number of lanes.
std::uint32_t longestRun(const DeviceLimits& limits, std::uint32_t lanes, StrandWork work);

/// Strands [begin, end) in device order, all of one shape.
struct StrandRange {
  StrandShape shape;
  std::uint32_t begin = 0, end = 0;
  std::uint32_t longest = 0;  // particles of its longest strand
  std::uint32_t chunk = 0;    // the chunk of the strands (groom_chunks.h)
};

/// Every shape of the device with runs in registers, and last kAnySerialShape, with its cost by the model for
/// this kind of device. Measured costs replace the model's, and scale those of other shapes.
std::vector<ShapeCost> shapeCosts(const DeviceLimits& limits, StrandWork work = StrandWork::hairAlone,
                                  std::span<const ShapeCost> measured = {});

/// Ranges of equal shape, at the least total cost. `particleCounts`: of the strands in device order, rising.
/// By default only strands that fit no run in registers have runs in memory. Fails if the choice asks for
/// lanes that the device or the strands do not allow.
Result<std::vector<StrandRange>> planRanges(std::span<const std::uint32_t> particleCounts,
                                            const DeviceLimits& limits, const KernelChoice& choice,
                                            StrandWork work = StrandWork::hairAlone);

/// The same for some of the strands: each gets the shape that planRanges gave to strands of its length.
std::vector<StrandRange> rangesOfPart(std::span<const StrandRange> whole,
                                      std::span<const std::uint32_t> particleCounts);

}  // namespace ringlet
