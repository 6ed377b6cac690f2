// What a programmer would write by hand in C++ in place of the strand kernel, as its baseline: the same
// arithmetic in float32 (`jacobi`, hair alone), eight strands to an AVX2 vector, as many threads as asked
// for, several steps a call. As a dispatch of the kernel does, a call loads and stores positions and
// velocities as the device keeps them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bench/hand_sweeps.h"
#include "bench/thread_team.h"
#include "layout/strands.h"
#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/head_pose.h"

namespace ringlet::bench {

class HandVectorised {
 public:
  /// The groom at rest. Fails on what buildRestState fails on, on a CPU without AVX2 and FMA, and on what the
  /// loop leaves out: other integrators, contacts, air, bending that varies along a strand.
  static Result<HandVectorised> create(const Groom& groom, const Material& material, const Settings& settings,
                                       unsigned threads);

  /// Steps; poses[k] is the head's at the end of step k. Jumps and shifts of roots are left out.
  void stepFrame(std::span<const HeadPose> poses);
  /// The same on the caller's thread alone.
  void stepFrameAlone(std::span<const HeadPose> poses);

  /// Groom order [m], relative to the head's origin.
  std::vector<Vec3f> positions() const;
  /// Longest edge over the groom's, at any step so far.
  float maxStretch() const { return *std::ranges::max_element(stretches_); }
  unsigned threads() const { return team_->size(); }
  /// What a frame of this many steps costs in arithmetic (operation_count.h), padding not counted.
  std::uint64_t operations(std::uint32_t steps) const;
  /// And the memory a call reads and writes: positions and velocities both ways, constants once [bytes].
  std::uint64_t bytesMoved() const;

 private:
  HandVectorised() = default;
  void addBlock(std::uint32_t firstStrand, const Settings& settings);
  std::vector<layout::StepPose> advance(std::span<const HeadPose> poses);
  void beginFrame(std::span<const layout::StepPose> poses);
  void sweepBlocks(unsigned thread);

  RestState rest_;
  double stepSeconds_ = 0;
  HeadPose oneStepEarlier_, now_;
  SweepRun run_;
  std::vector<Block> blocks_;
  std::vector<std::vector<EdgeRest>> edges_;           // one a block
  std::vector<std::unique_ptr<StrandsRest>> strands_;  // one a block
  std::vector<layout::vec4> positions_, velocities_;   // device order
  std::vector<std::vector<EdgeWork>> work_;            // one a thread
  std::unique_ptr<ThreadTeam> team_;
  std::vector<float> stretches_;                     // one a thread
  std::unique_ptr<std::atomic<std::size_t>> given_;  // blocks of this frame that some thread has
};

}  // namespace ringlet::bench
