// Implements scenes/frames/scene_cuts.h.
#include "ringlet/scenes/frames/scene_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "ringlet/rest/goal.h"
#include "ringlet/scenes/frames/scene_keys.h"
#include "ringlet/scenes/load/scene_maps.h"

namespace ringlet {
namespace {

// How many particles stay: those before the place, at least one edge and all that follow the head.
std::uint32_t keptOf(std::span<const float> shares, double at, int rootCount) {
  const auto before = std::ranges::lower_bound(shares, static_cast<float>(at)) - shares.begin();
  return std::max(static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(std::max(rootCount, 2)));
}

}  // namespace

Result<std::vector<TimedCuts>> cutsOf(const SceneFile& scene, const Groom& groom, int rootCount) {
  const GroomGoal goal = goalOf(groom);
  const auto last = static_cast<std::uint32_t>(groom.strandCount() - 1);
  std::map<double, std::map<std::uint32_t, std::uint32_t>> kept;  // by time and strand
  for (std::size_t i = 0; i < scene.cuts.size(); ++i) {
    const SceneCut& stated = scene.cuts[i];
    auto runs = stated.strands.empty()
                    ? Result<std::vector<StrandRun>>(std::vector<StrandRun>{{0, last, 1.f}})
                    : parseStrands(stated.strands, 1, scene.groups);
    const auto failed = [&](const std::string& why) {
      return Error{fmt::format("the cut {}: {}", nameInKeys(stated.name, i), why)};
    };
    if (!runs) return failed(runs.error().message);
    if (runs->back().last > last)
      return failed(fmt::format("it names strand {}; the groom has {}, numbered from 0", runs->back().last,
                                groom.strandCount()));
    for (const StrandRun& run : *runs) {
      for (std::uint32_t s = run.first; s <= run.last; ++s) {
        const std::uint32_t first = groom.firstPoint[s], count = groom.firstPoint[s + 1] - first;
        const std::uint32_t keep = keptOf(std::span(goal.shares).subspan(first, count), stated.at, rootCount);
        const auto known = kept[stated.time].try_emplace(s, keep).first;
        known->second = std::min(known->second, keep);
      }
    }
  }
  std::map<std::uint32_t, std::uint32_t> left;  // of strands that were cut before
  std::vector<TimedCuts> all;
  for (const auto& [seconds, strands] : kept) {
    TimedCuts now{seconds, {}};
    for (const auto& [strand, keep] : strands) {
      const std::uint32_t count = groom.firstPoint[strand + 1] - groom.firstPoint[strand];
      const auto known = left.try_emplace(strand, count).first;
      if (keep >= known->second) continue;
      known->second = keep;
      now.cuts.push_back({strand, keep});
    }
    if (!now.cuts.empty()) all.push_back(std::move(now));
  }
  return all;
}

}  // namespace ringlet
