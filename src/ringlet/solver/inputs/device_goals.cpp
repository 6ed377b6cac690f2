// Implements solver/inputs/device_goals.h.
#include "ringlet/solver/inputs/device_goals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/base/packed.h"
#include "ringlet/rest/goal.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

Result<DeviceGoals> DeviceGoals::create(gpu::Device& device, const RestState& rest,
                                        const std::vector<GoalUnit>* units,
                                        std::span<const GroomChunk> chunks, std::size_t slots) {
  DeviceGoals goals(units, slots);
  goals.chunks_.assign(chunks.begin(), chunks.end());
  for (const GroomChunk& chunk : chunks) {
    const std::uint64_t bytes = goals.areThere() ? chunk.particleCount() * sizeof(layout::vec4) : 0;
    for (auto* inputs : {&goals.before_, &goals.after_}) {
      auto input = FrameInput::create(device, bytes, slots, "goals");
      if (!input) return input.error();
      inputs->push_back(std::move(*input));
    }
  }
  if (goals.areThere()) {
    goals.groomIndices_ = groomIndices(rest);
    goals.start_.resize(goals.groomIndices_.size());
    goals.end_.resize(goals.groomIndices_.size());
  }
  return goals;
}

void DeviceGoals::set(std::span<const Vec3f> places, std::span<const float> strengths, double dampingRatio,
                      std::span<const Vec3f> from) {
  for (std::size_t i = 0; i < end_.size(); ++i) {
    const std::uint32_t g = groomIndices_[i];
    const double strength = strengths[g];
    const GoalUnit& unit = (*units_)[i];
    end_[i] = packed(Vec3d(places[g]), strength * unit.stiffness);
    if (!from.empty() || !areSet_) start_[i] = packed(from.empty() ? places[g] : from[g]);
    start_[i].w = static_cast<float>(dampingRatio * std::sqrt(strength) * unit.damping);
  }
  areSet_ = move_ = true;
  isWritten_.assign(isWritten_.size(), false);
}

void DeviceGoals::writeFrame(std::size_t slot) {
  if (!areThere() || isWritten_[slot]) return;
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const auto first = static_cast<std::ptrdiff_t>(chunks_[c].particleBegin);
    const auto count = chunks_[c].particleCount();
    std::copy_n(start_.begin() + first, count, before_[c].of<layout::vec4>(slot).begin());
    std::copy_n(end_.begin() + first, count, after_[c].of<layout::vec4>(slot).begin());
  }
  isWritten_[slot] = !move_;
  if (!std::exchange(move_, false)) return;
  for (std::size_t i = 0; i < end_.size(); ++i)  // the damping stays
    start_[i] = {end_[i].x, end_[i].y, end_[i].z, start_[i].w};
}

}  // namespace ringlet
