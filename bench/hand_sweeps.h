// Eight strands at a time in AVX2: the sweeps of hand_vectorised.h, and the memory they run over. Compiled
// with flags of its own (bench/CMakeLists.txt): its code must not end up in other files, so they share these
// structs only.
#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/strands.h"

namespace ringlet::bench {

/// Strands of a vector.
inline constexpr std::size_t kLanes = 8;

/// One number of each of eight strands.
struct alignas(32) Eight {
  float lane[kLanes] = {};
};

/// Constant per edge: of layout/strands.h's ParticleRest, ready to use. Beyond a tip: scale 0, mass 1, any
/// length.
struct EdgeRest {
  Eight target[3];   // [m]
  Eight restLength;  // of the stretch spring [m]
  Eight longest;     // of the stretch limit [m]
  Eight coreLength;  // |b_i| at rest [m]
  Eight scale;       // 1 / edge length [1/m]
  Eight mass;        // of particle i [mass unit]
};

/// Constant per strand: of layout/strands.h's StrandRest, with the step worked in.
struct StrandsRest {
  Eight bendBeta, coreBeta;
  Eight stretchStiffness, bendStiffness, coreStiffness, coreDamping;  // times an edge's scale
  Eight across, along;                                                // of the implicit edge, likewise
  Eight perCoreLength;                                                // 1 / the core's length at rest [1/m]
  Eight firstEdge[3];                                                 // [m]
  Eight pins[layout::kMaxRootCount][3];                               // [m]
};

/// Eight strands. A block that is not full repeats its last strand.
struct Block {
  std::uint32_t firstParticle[kLanes] = {}, particleCount[kLanes] = {};
  std::uint32_t longest = 0;  // particles
  const EdgeRest* edges = nullptr;
  const StrandsRest* strands = nullptr;
};

/// What changes in a step, of a particle and its edge. Tip to root a record's `work` becomes the edge's M and
/// z, root to tip its h, e^ and the particle's right-hand side.
struct EdgeWork {
  Eight position[3];
  Eight work[12];
};

/// The same for all strands of a call.
struct SweepRun {
  layout::vec4 gravity;  // w: T
  float maxStretch = 0, coreRelaxedShare = 0, coreElongationLow = 0, coreElongationHigh = 0;
  std::uint32_t rootCount = 1, steps = 1;
  bool oneSmoothing = false;
  const layout::StepPose* poses = nullptr;  // steps + 1, as on the device
  layout::vec4* positions = nullptr;        // device order
  layout::vec4* velocities = nullptr;
};

/// All steps of a call for one block: loads positions and velocities, stores them. `work`: `block.longest`
/// records. Returns the longest edge over the groom's.
float runBlock(const SweepRun& run, const Block& block, EdgeWork* work);

/// Whether the sweeps were compiled, and this CPU runs them. runBlock needs it.
bool canSweep();
/// What they were compiled with.
const char* sweepFlags();

}  // namespace ringlet::bench
