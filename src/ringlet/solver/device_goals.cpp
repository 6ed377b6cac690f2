// Implements solver/device_goals.h.
#include "ringlet/solver/device_goals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ringlet/base/packed.h"
#include "ringlet/rest/goal.h"
#include "ringlet/solver/device_groom.h"

namespace ringlet {

std::vector<DeviceGoals::Unit> DeviceGoals::unitsOf(const RestState& rest, Kind kind) {
  const double k = goalStiffness(1);
  std::vector<Unit> units(rest.particles.size(), {k, goalDamping(k, 1)});
  if (kind == Kind::places) return units;
  for (const layout::StrandRest& strand : rest.strands) {
    const std::span particles(rest.particles.begin() + strand.firstParticle, strand.particleCount);
    double mass = 0, arc = 0;  // [mass unit], [m]
    for (const layout::ParticleRest& particle : particles) mass += static_cast<double>(particle.mass);
    for (const layout::ParticleRest& particle : particles.first(particles.size() - 1))
      arc += static_cast<double>(particle.edgeLength);
    for (std::size_t i = 0; i + 1 < particles.size(); ++i) {
      const double l = particles[i].edgeLength, m = particles[i].mass;
      units[strand.firstParticle + i] = {shapeStiffness(1, mass, l, m), shapeDamping(1, 1, mass, arc, l, m)};
    }
  }
  return units;
}

Result<DeviceGoals> DeviceGoals::create(gpu::Device& device, const RestState& rest, Kind kind,
                                        std::span<const GroomChunk> chunks, std::size_t slots) {
  DeviceGoals goals(slots);
  const bool areThere = kind != Kind::none;
  goals.chunks_.assign(chunks.begin(), chunks.end());
  for (const GroomChunk& chunk : chunks) {
    const std::uint64_t bytes = areThere ? chunk.particleCount() * sizeof(layout::vec4) : 0;
    for (auto* inputs : {&goals.before_, &goals.after_}) {
      auto input = FrameInput::create(device, bytes, slots, "goals");
      if (!input) return input.error();
      inputs->push_back(std::move(*input));
    }
  }
  if (areThere) {
    goals.groomIndices_ = groomIndices(rest);
    goals.units_ = unitsOf(rest, kind);
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
    end_[i] = packed(Vec3d(places[g]), strength * units_[i].stiffness);
    if (!from.empty() || !areSet_) start_[i] = packed(from.empty() ? places[g] : from[g]);
    start_[i].w = static_cast<float>(dampingRatio * std::sqrt(strength) * units_[i].damping);
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
