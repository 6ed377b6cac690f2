// CrossingStage: no hair through hair on a device (crossing_step.h). The stage runs on the host, between a
// step's move and the next step: positions are read back, and written again with the velocities that follow
// from them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/archive.h"
#include "ringlet/base/result.h"
#include "ringlet/crossings/crossing_step.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/scene/head_pose.h"
#include "ringlet/scene/settings.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

class CrossingStage {
 public:
  CrossingStage(const RestState& rest, const Settings& settings);

  /// heads: at the frame's start and after each step of it.
  void beginFrame(std::span<const HeadPose> heads);
  /// Reads where the hair is. Before the frame's first move.
  Status begin(const DeviceGroom& groom);
  /// After the move of a step of the frame.
  Status keepApart(DeviceGroom& groom, const Settings& settings, std::uint32_t step);

  /// Over all steps so far.
  const CrossingReport& report() const { return report_; }
  /// Where hair is says all else.
  void archive(Archive& archive) { archive.value(report_); }

 private:
  CrossingHair hair_;  // device order
  std::vector<Quatd> turns_;
  std::vector<Vec3d> starts_;  // where the step began [m]
  CrossingReport report_;
};

}  // namespace ringlet
