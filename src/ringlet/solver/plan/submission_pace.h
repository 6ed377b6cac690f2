// SubmissionPace: cuts frames into submissions. A desktop takes a device for hung if one submission runs for
// seconds, and does not draw meanwhile. How long work takes is estimated from the last frame.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace ringlet {
namespace gpu {
class CommandList;
}

class SubmissionPace {
 public:
  static constexpr const char* kStrandStage = "strand_step";

  /// `longestSeconds`: limit of a submission; 0: a frame is one submission.
  explicit SubmissionPace(double longestSeconds) : target_(longestSeconds / 2) {}

  /// Limit of particles times outer steps in one dispatch of the strand kernel.
  std::uint64_t mostParticleSteps() const;

  /// Begins a recording and its first submission.
  void beginRecording() { openSeconds_ = 0; }
  /// Whether the next work, of this number of particles times steps, must begin a new submission.
  bool cutsBeforeStrands(double particleSteps) { return cutsBefore(particleSteps * strandRate_); }
  /// Begins a stage, in a new submission if the open one would become too long.
  void beginStage(gpu::CommandList& list, const std::string& name);

  /// Learns from a recording that has run: its stages [ms], and the particles times steps of those named
  /// kStrandStage. Returns whether recordings must be made again: no time was known when they were made, or a
  /// stage takes twice as long as it did then.
  bool learn(std::span<const std::pair<std::string, double>> stageMilliseconds, double particleSteps);

 private:
  bool cutsBefore(double seconds);
  double secondsOf(const std::string& stage) const;

  double target_;  // planned duration of a submission, half its limit [s]; 0: no limit
  // The times with which the present recordings were made. Infinite: unknown; then each piece of work is a
  // submission.
  double strandRate_ = std::numeric_limits<double>::infinity();  // [s] per particle and step
  std::map<std::string, double> stageSeconds_;                   // longest of each other stage
  double openSeconds_ = 0;                                       // of the open submission, as planned
};

}  // namespace ringlet
