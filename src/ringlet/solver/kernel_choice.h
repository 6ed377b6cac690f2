// KernelChoice: options of the kernels of some hair, and an observer of their compilation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/solver/features.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet {

class PartLink;
struct StrandGeometry;
struct WholeRest;

/// Is notified when the driver begins to compile a simulation's kernels, which may take seconds, and when it
/// has finished. Not called where all kernels have been compiled on this device before.
class CompileObserver {
 public:
  virtual ~CompileObserver() = default;
  virtual void begin(std::size_t kernelCount) = 0;
  virtual void end() = 0;  // also after a failure
};

/// The shape of the strand kernel and its variants. The defaults choose by device and strand length.
struct KernelChoice {
  // lanes: runs in registers; memory: runs in memory, for long strands; serial: one lane with its run in
  // memory
  enum class Form { automatic, lanes, memory, serial };
  Form form = Form::automatic;
  int particlesPerLane = 0;  // see longestRun in shape_plan.h; 0: chosen by the plan
  int lanes = 0;             // of a strand, a power of two; 0: chosen by the plan
  int subgroupSize = 0;      // see subgroupSizes in subgroup_choice.h; 0: chosen by device
  int groupSize = 0;         // invocations of a workgroup, to compare times; 0: chosen by device
  std::span<const ShapeCost>
      measured{};            // on this device, read until build or create returns; none: a cost model is used
  bool manyKernels = false;  // use the best shape for every strand, however long kernels take to compile
  // Expected number of heads with this hair. With many heads a long compilation pays. With 2 or more, heads
  // whose hair is alone share buffers, and one dispatch steps many of them (hair_frames.h).
  int heads = 1;
  // The strands, groom order, that are simulated here, if other devices simulate the rest. They have the same
  // bits as in the whole groom; positions of the others are unknown here. Not possible with sleep, and with
  // contacts only by `link`. Read until build or create returns; empty: all.
  std::span<const std::uint32_t> part{};
  // In place of `part` for hair with contacts: the exchange with the other parts, which are simulated at the
  // same time. Used by one simulation at a time, which it must outlive.
  PartLink* link = nullptr;
  // Geometry of the groom's strands, if it is known (measureGeometry of rest/rest_state.h); read until build
  // or create returns.
  const std::vector<StrandGeometry>* geometry = nullptr;
  // The whole groom's rest state for this material and these settings, if it is known; read until then too.
  const WholeRest* rest = nullptr;
  CompileObserver* observer = nullptr;  // must live as long as simulations are created with this choice
  bool residual = false;  // measure the velocity solve's residual (SimulationReport), a few per cent slower
  Features features{};    // simulations start with these; others are added when they are first used
  bool taps = false;      // write every intermediate of the last step (Diagnostics::tap); slower, for tests
                          // (RINGLET_BUILD_TAPS)
  // Approximate longest device time of a submission [s]: a desktop resets a device whose submission takes too
  // long. 0: 0.3 s, and no limit on a CPU device.
  double longestSubmissionSeconds = 0;
  // Smaller limits than the device's, for tests [bytes]; 0: the device's.
  std::uint64_t mostBufferBytes = 0;  // of one buffer; larger grooms are cut into chunks
  std::uint64_t mostDeviceBytes = 0;  // of all buffers
  int contactRoom = 1;                // factor on the initial room of contact lists, for tests
  double volumeRange = 1;             // factor on ContactSettings::volumeMostRate, a power of two, for tests
};

}  // namespace ringlet
