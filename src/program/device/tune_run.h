// Times strand shapes against each other on one device; first the results of each are compared with
// another's.
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
  std::optional<int> strandCount;                       // for each length; none: enough to fill the device
  double seconds =
      20;  // afterwards no shape and no round is started; the first two shapes and three rounds always are
  bool showProgress = true;
  /// Called with the results so far after each shape and each round, at most once a second.
  std::function<Status(const TuneOutcome& soFar)> grow{};
};

/// A shape with strands of one length.
struct TimedShape {
  TuneWork work = TuneWork::alone;
  std::uint32_t particleCount = 0;  // of a strand
  StrandShape shape;
  std::uint32_t subgroupSize = 0;
  double nanoseconds = 0;  // device time of a particle and step, the median over rounds
  double model = 0;        // the same according to the cost model
  double difference = 0;   // of the positions from those of `against` after a frame: the largest, relative to
                           // the strand's length
  StrandShape against;
};

/// A shape that gives wrong results on this device, or cannot be made. If it concerns hair alone, nothing is
/// stored.
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
  std::uint32_t subgroupSize = 0;  // the fastest width
  int rounds = 0;
  std::size_t leftOut = 0;   // number of shapes for which there was no time
  bool interrupted = false;  // Ctrl-C came; results so far are kept, without costs
};

/// At most four of these lengths (particles of each strand) that represent all, including the longest.
std::vector<std::uint32_t> typicalLengths(std::vector<std::uint32_t> counts);

/// If two shapes differ after a frame by more than 1e-5 of the strands' length (1e-4 with bodies), or a shape
/// cannot be made, that is a trouble, and the others are timed. Fails where there is no choice of shapes,
/// where the device is lost, and where no shape can be made. Takes about `seconds`, most of it compiling.
Result<TuneOutcome> timeShapes(const ComputeDevice& device, const TuneOptions& options);

}  // namespace ringlet::program
