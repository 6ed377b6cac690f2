// SubmissionPace: how frames are cut into submissions. A desktop takes a device that works on one submission
// for seconds for hung, and does not draw meanwhile. How long work takes is known from the frame before.
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

  /// `longestSeconds`: of one submission; 0: a frame is one, however long.
  explicit SubmissionPace(double longestSeconds) : target_(longestSeconds / 2) {}

  /// Particles times outer steps that one dispatch of the strand kernel may do.
  std::uint64_t mostParticleSteps() const;

  /// A recording begins, and with it its first submission.
  void beginRecording() { openSeconds_ = 0; }
  /// Whether work that follows is to begin a new submission. Of so many particles times steps of strands:
  bool cutsBeforeStrands(double particleSteps) { return cutsBefore(particleSteps * strandRate_); }
  /// Begins a stage, in a new submission where the open one would become too long.
  void beginStage(gpu::CommandList& list, const std::string& name);

  /// Of a recording that has run: its stages and their times [ms], and the particles times steps of those
  /// named kStrandStage. Whether recordings are to be made anew: nothing was known when they were made, or
  /// something takes twice what it took then.
  bool learn(std::span<const std::pair<std::string, double>> stageMilliseconds, double particleSteps);

 private:
  bool cutsBefore(double seconds);
  double secondsOf(const std::string& stage) const;

  double target_;  // [s] what submissions are planned for: half of what they may take. 0: anything
  // What the recordings there are were made with; infinite: not known, and then all work is submitted alone.
  double strandRate_ = std::numeric_limits<double>::infinity();  // [s] of a particle and step
  std::map<std::string, double> stageSeconds_;                   // longest of each other stage
  double openSeconds_ = 0;                                       // planned in the open submission
};

}  // namespace ringlet
