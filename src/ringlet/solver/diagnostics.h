// Diagnostics: internals of a simulation, for tests, benchmarks, profiling and debugging.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/solver/simulation.h"

namespace ringlet {

struct BufferContent {
  std::string name;
  std::vector<std::byte> bytes;
};

/// Sizes of a simulation's buffers in bytes (docs/memory.md).
struct DeviceMemory {
  std::uint64_t particles = 0;     // state, rest, taps, contact terms of a solve
  std::uint64_t strands = 0;       // constants, reports
  std::uint64_t rootPoses = 0;     // of strands that have poses of their own
  std::uint64_t contacts = 0;      // contact particles, their grid, pairs of strands that may touch
  std::uint64_t contactLists = 0;  // at their present length
  std::uint64_t volume = 0;        // of strands in contact as a volume: particles, grid
  std::uint64_t world = 0;         // the head's poses, bodies with their distance grids, air
  std::uint64_t frames = 0;        // in flight, in the host's memory: positions read back, poses, air
  std::uint64_t shared = 0;        // of particles and strands: held once for all simulations of an asset

  std::uint64_t total() const {
    return particles + strands + rootPoses + contacts + contactLists + volume + world + frames;
  }
};

/// A pair of contact particles in a list, by groom order. With the time taper: its present shares of
/// stiffness and damping (ContactSettings). With the distance taper: stiffness 1 where its spring acts in the
/// last iterate, damping 1 where the pair is near enough for spring or damper.
struct ListedContact {
  std::uint32_t a = 0, b = 0;  // a < b
  float stiffnessShare = 0, dampingShare = 0;
};

/// Name of the stage that copies positions to the host; it is not part of stepping.
inline constexpr const char* kCopyStage = "copy_out";

/// Time of one dispatch or one copy of a frame.
struct StageSpan {
  std::string stage;
  double begin = 0;  // on the device's clock, from an arbitrary zero; without timestamps from the submission
                     // on [ms]
  double milliseconds = 0;  // as stageMilliseconds counts them
};

/// Host time spent on the device [ms].
struct HostMilliseconds {
  double submit = 0;  // submitting frames, and recording them if they are new
  double fence = 0;   // waiting for its fences
};

/// Of one simulation, which must outlive this. All functions except `kernels`, `rigidStrandCount` and the
/// times wait for frames in flight.
class Diagnostics {
 public:
  explicit Diagnostics(const Simulation& hair) : hair_(&hair) {}

  /// The pairs of particles in the lists (groom order, a < b, sorted). Empty without contacts; rigid strands
  /// are in none.
  Result<std::vector<ListedContact>> listedContacts() const;
  /// One intermediate of the last step in groom order, four floats a particle (an edge's at its particle i);
  /// 0 for rigid strands. `field` is a kTap... constant of layout/strands.h. Needs KernelChoice::taps.
  Result<std::vector<std::array<float, 4>>> tap(std::uint32_t field) const;
  /// The contents of each device buffer that the hair's kernels use and that is not empty; a buffer of the
  /// groom's second chunk is called NAME_1, and so on. Layouts: shaders/shared and shaders/layout.
  Result<std::vector<BufferContent>> bufferContents() const;
  /// The commands of the last frame submitted, or of the first one (Recorder::recorded).
  std::vector<std::string> recordedFrame() const;
  /// Present sizes; a frame in flight may still enlarge contact lists. The driver may need a little more for
  /// each of some dozen buffers.
  DeviceMemory memory() const;
  /// The kernel variants in use, e.g. "lanes 4 x 16 (subgroup 8)".
  std::string kernels() const;
  /// Number of strands that are carried rigidly.
  std::size_t rigidStrandCount() const;

  /// Milliseconds spent on the device, by stage, summed over all frames waited for; by GPU timestamps where
  /// the device has them, and then with kCopyStage.
  std::map<std::string, double> stageMilliseconds() const;
  /// The dispatches of the frame waited for last, in order. May be called whenever framePositions may.
  std::vector<StageSpan> frameStages() const;
  /// Host time spent on the device, over all frames waited for.
  HostMilliseconds hostMilliseconds() const;
  /// Time to make the kernels, mostly the driver's compiler [ms]. It is part of create. A device compiles
  /// each kernel once for all its simulations.
  double compileMilliseconds() const;

 private:
  const Simulation* hair_;
};

}  // namespace ringlet
