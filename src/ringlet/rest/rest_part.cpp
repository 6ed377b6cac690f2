// Implements rest/rest_part.h.
#include "ringlet/rest/rest_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ringlet {
Result<std::vector<bool>> membersOf(std::span<const std::uint32_t> part, std::size_t strandCount) {
  std::vector<bool> isIn(strandCount);
  for (const std::uint32_t strand : part) {
    if (strand >= strandCount)
      return Error{
          fmt::format("a part names strand {}; the groom has {}, numbered from 0", strand, strandCount)};
    if (isIn[strand]) return Error{fmt::format("strand {} is in a part twice", strand)};
    isIn[strand] = true;
  }
  return isIn;
}

Status restrictTo(RestState& state, std::span<const std::uint32_t> part) {
  const auto isIn = membersOf(part, state.groomStrandCount);
  if (!isIn) return isIn.error();
  RestState whole = std::exchange(state, {});
  std::swap(state.rigid, whole.rigid);
  std::swap(state.warnings, whole.warnings);
  state.materialWarningCount = whole.materialWarningCount;
  state.groomStrandCount = whole.groomStrandCount, state.groomParticleCount = whole.groomParticleCount;
  state.longestCalmStep = whole.longestCalmStep;
  state.oneSmoothing = whole.oneSmoothing;
  std::swap(state.wholeCounts, whole.wholeCounts);
  for (std::size_t s = 0; s < whole.strands.size(); ++s) {
    layout::StrandRest strand = whole.strands[s];
    const auto first = whole.points.begin() + strand.firstParticle;
    if (!(*isIn)[whole.strandInGroom[s]]) {
      state.elsewhere.push_back(
          {whole.strandInGroom[s], whole.firstInGroom[s], {first, first + strand.particleCount}});
      continue;
    }
    const auto particles = whole.particles.begin() + strand.firstParticle;
    strand.firstParticle = static_cast<std::uint32_t>(state.points.size());
    state.strands.push_back(strand);
    state.strandInGroom.push_back(whole.strandInGroom[s]);
    state.firstInGroom.push_back(whole.firstInGroom[s]);
    state.points.insert(state.points.end(), first, first + strand.particleCount);
    state.particles.insert(state.particles.end(), particles, particles + strand.particleCount);
    if (whole.edgeFactors.empty()) continue;
    const auto factors = whole.edgeFactors.begin() + whole.strands[s].firstParticle;
    state.edgeFactors.insert(state.edgeFactors.end(), factors, factors + strand.particleCount);
  }
  std::ranges::sort(state.elsewhere, {}, &RigidStrand::strandInGroom);
  return {};
}

}  // namespace ringlet
