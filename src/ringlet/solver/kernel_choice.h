// KernelChoice: how the kernels of some hair are chosen, and who is told when they are compiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ringlet/solver/strand_shape.h"

namespace ringlet {

/// Told when the driver begins to compile a simulation's kernels, which may take seconds, and when it is
/// done. Not told where a simulation before has compiled them all on this device.
class CompileObserver {
 public:
  virtual ~CompileObserver() = default;
  virtual void begin(std::size_t kernelCount) = 0;
  virtual void end() = 0;  // also after a failure
};

/// How the strand kernel is laid over the device; the defaults choose by device and strand length.
struct KernelChoice {
  enum class Form { automatic, lanes, serial };
  Form form = Form::automatic;  // lanes x run, or one thread per strand
  int particlesPerLane = 0;     // see longestRun in shape_plan.h; 0: choose
  int lanes = 0;                // of a strand, a power of two; 0: choose
  int subgroupSize = 0;         // see subgroupSizes in subgroup_choice.h; 0: choose
  std::span<const ShapeCost>
      measured{};            // on this device, needed until build or create returns; none: a model's
  bool manyKernels = false;  // the best shape for every strand, whatever kernels cost to make
  int heads = 1;             // with this hair, about: for many a kernel that is long in the making pays
  CompileObserver* observer = nullptr;  // needed as long as simulations are created with this
  bool residual = false;  // measure the velocity solve's residual (SimulationReport), a few per cent slower
  bool movingRoots = false;  // strands have poses of their own (Simulation::stepFrame)
  bool forces = false;       // particles are pulled from outside (Simulation::setForces)
  bool taps = false;         // write every intermediate of the last step (Simulation::tap); slower, for tests
  // [s] of one submission, about: a desktop whose device works longer at one piece takes it for hung. 0: 0.3,
  // and on a CPU device without bound.
  double longestSubmissionSeconds = 0;
  // Less than the device has, for tests; 0: what it has [bytes].
  std::uint64_t mostBufferBytes = 0;  // of one buffer: more is cut into chunks
  std::uint64_t mostDeviceBytes = 0;  // of all
  int contactRoom = 1;                // contact lists begin with so many times the room, for tests
};

}  // namespace ringlet
