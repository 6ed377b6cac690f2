// The strand kernel and its baselines on the same hair, first verified, then turn by turn, so that what else
// the machine does falls on all alike.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/hand_vectorised.h"
#include "bench/thread_team.h"
#include "reference/step.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/simulation.h"

namespace ringlet::bench {

/// Seconds of one outer step of all strands, a sample a round; of what was not measured, none.
struct ContestSamples {
  std::vector<double> kernel;                    // device time
  std::vector<double> kernelWall, kernelCpu;     // of the frame; the process's CPU time, all cores together
  std::vector<double> handAlone, hand, handCpu;  // one thread; all cores, and their CPU time together
  std::vector<double> referenceDouble, referenceFloat;  // one thread
  std::vector<double> referenceCpu;                     // CPU time of the double one
  std::vector<double> peak;  // seconds the step's operations would take at the peak
};

/// Who runs beside the kernel.
enum class Baselines { all, none };

class Contest {
 public:
  /// Curls of these particle counts, `steps` steps a dispatch. The reference is measured on no more than
  /// 16,384 particles, and its time scaled. Fails where the kernel or the loop disagrees with the double
  /// reference by 1e-5 of a strand's length, the bound of tests/support/tolerances.h, after a shaken frame.
  static Result<Contest> create(const ComputeDevice& device, const std::vector<int>& particleCounts,
                                int steps, Baselines baselines = Baselines::all,
                                const KernelChoice& choice = {});

  /// Everyone once.
  Status round();
  Status rounds(int count);

  const ContestSamples& samples() const { return samples_; }
  double particles() const { return particles_; }
  double operationsPerStep() const { return operationsPerStep_; }  // operation_count.h; 0 without the loop
  double bytesPerStep() const { return bytesPerStep_; }            // a dispatch's, over its steps
  std::string kernel() const { return Diagnostics(*simulation_).kernels(); }

 private:
  Contest() = default;
  Status addHand(const Groom& groom);
  Status verifyFrame(std::vector<int> particleCounts);
  void addReferences(const std::vector<int>& particleCounts);
  Status stepKernel();
  void stepHand();
  void stepReferences();

  Settings settings_;
  std::vector<HeadPose> poses_;  // where the head stands after it was shaken
  double particles_ = 0, operationsPerStep_ = 0, bytesPerStep_ = 0, referenceShare_ = 1;
  std::optional<Simulation> simulation_;
  std::optional<HandVectorised> hand_;
  std::unique_ptr<reference::Simulation<double>> referenceDouble_;
  std::unique_ptr<reference::Simulation<float>> referenceFloat_;
  std::unique_ptr<ThreadTeam> team_;
  ContestSamples samples_;
};

}  // namespace ringlet::bench
