// Implements solver/inputs/goals_input.h.
#include "ringlet/solver/inputs/goals_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/base/packed.h"
#include "ringlet/rest/goal.h"
#include "ringlet/solver/diagnostics.h"
#include "ringlet/solver/inputs/frame_inputs.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

Result<GoalsInput> GoalsInput::create(const InputSource& from) {
  GoalsInput self;
  self.chunks_ = from.chunks;
  self.isWritten_.assign(from.slots, false);
  self.own_ = from.goal;
  if (Status status = self.prepare(from); !status) return status.error();
  if (self.own_) self.setOwn(from.settings.goal);
  return self;
}

Status GoalsInput::prepare(const InputSource& from) {
  const bool areThere = !units_.empty();
  units_ = from.goalUnits;
  if (areThere == from.features.goals && !staged_.empty()) return {};
  staged_.clear();
  for (const GroomChunk& chunk : chunks_) {
    const std::uint64_t bytes = units_.empty() ? 0 : chunk.particleCount() * sizeof(layout::vec4);
    for (int k = 0; k < 2; ++k) {
      if (Status status = stage(from, bytes, "goals"); !status) return status;
    }
  }
  if (units_.empty()) return {};
  groomIndices_ = groomIndices(from.rest);
  start_.resize(groomIndices_.size());
  end_.resize(groomIndices_.size());
  return {};
}

void GoalsInput::setOwn(const GoalSettings& settings) {
  set(own_->places, strengthsOf(*own_, settings), settings.damping, {});
}

void GoalsInput::setSettings(const Settings& before, const Settings& wanted) {
  if (own_ && wanted.goal != before.goal) setOwn(wanted.goal);
}

void GoalsInput::set(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                     std::span<const Vec3f> from) {
  for (std::size_t i = 0; i < end_.size(); ++i) {
    const std::uint32_t g = groomIndices_[i];
    const double strength = strengths[g];
    const GoalUnit& unit = units_[i];
    end_[i] = packed(Vec3d(places[g]), strength * unit.stiffness);
    if (!from.empty() || !areSet_) start_[i] = packed(from.empty() ? places[g] : from[g]);
    start_[i].w = static_cast<float>(dampingRatio * std::sqrt(strength) * unit.damping);
  }
  areSet_ = move_ = true;
  isWritten_.assign(isWritten_.size(), false);
}

void GoalsInput::writeFrame(std::size_t slot, const FrameContext&) {
  if (units_.empty() || isWritten_[slot]) return;
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const auto first = static_cast<std::ptrdiff_t>(chunks_[c].particleBegin);
    const auto count = chunks_[c].particleCount();
    std::copy_n(start_.begin() + first, count, before(c).of<layout::vec4>(slot).begin());
    std::copy_n(end_.begin() + first, count, after(c).of<layout::vec4>(slot).begin());
  }
  isWritten_[slot] = !move_;
  if (!std::exchange(move_, false)) return;
  for (std::size_t i = 0; i < end_.size(); ++i)  // w, the damping, stays
    start_[i] = {end_[i].x, end_[i].y, end_[i].z, start_[i].w};
}

gpu::BufferTable GoalsInput::bufferTable(std::size_t chunk) const {
  using namespace layout;
  return {{kBindGoalsBefore, before(chunk).seen()},
          {kBindGoals, after(chunk).seen()},
          {kBindGoalBeforeTexels, before(chunk).seen()},
          {kBindGoalTexels, after(chunk).seen()}};
}

std::uint64_t DeviceMemory::*GoalsInput::kind() const { return &DeviceMemory::particles; }

}  // namespace ringlet
