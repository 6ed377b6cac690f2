// Times strand shapes against each other on one device, each first held against another.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "program/device/tune_work.h"
#include "ringlet/base/result.h"
#include "ringlet/solver/compute_device.h"
#include "ringlet/solver/strand_shape.h"

namespace ringlet::program {

struct TuneOutcome;

struct TuneOptions {
  std::vector<TuneWork> works{TuneWork::alone};         // each once
  std::vector<std::uint32_t> lengths{16, 32, 64, 128};  // particles a strand, rising
  std::optional<int> strandCount;                       // of each length; none: enough to fill the device
  double seconds =
      20;  // after which no shape is begun and no round; the first two shapes and three rounds are
  bool showProgress = true;
  /// What is known so far, after each shape that is made and each round; a second apart at least.
  std::function<Status(const TuneOutcome& soFar)> grow{};
};

/// A shape with strands of one length.
struct TimedShape {
  TuneWork work = TuneWork::alone;
  std::uint32_t particleCount = 0;  // of a strand
  StrandShape shape;
  std::uint32_t subgroupSize = 0;
  double nanoseconds = 0;  // device time of a particle and step, the median over rounds
  double model = 0;        // the same by the model
  double difference = 0;   // from `against` after a frame: the farthest particle, as a share of the length
  StrandShape against;
};

/// A shape that is not to be trusted on this device, or cannot be had. Of hair alone: nothing is remembered
/// then.
struct ShapeTrouble {
  TuneWork work = TuneWork::alone;
  std::uint32_t particleCount = 0;  // of a strand
  StrandShape shape;
  std::uint32_t subgroupSize = 0;
  Error error;
};

struct TuneOutcome {
  std::vector<TimedShape> timed;  // by work and length
  std::vector<ShapeTrouble> troubles;
  std::vector<ShapeCost>
      costs;  // of hair alone, for KernelChoice::measured, at the fastest width; none with troubles of it
  std::uint32_t subgroupSize = 0;  // that width
  int rounds = 0;
  std::size_t leftOut = 0;   // shapes there was no time for
  bool interrupted = false;  // Ctrl-C came; what was timed until then is there, without costs
};

/// Of these lengths (of particles, one a strand) four at most that stand for all, the longest among them.
std::vector<std::uint32_t> typicalLengths(std::vector<std::uint32_t> counts);

/// Two shapes that are further apart after a frame than 1e-5 of the strands' length, among bodies 1e-4, and
/// one that cannot be made, are troubles, and the others are timed. Fails where there is nothing to choose
/// from, the device is lost, and no shape can be made. About `seconds` of time, most of it compiling.
Result<TuneOutcome> timeShapes(const ComputeDevice& device, const TuneOptions& options);

}  // namespace ringlet::program
