// Implements run/strand_graph.h.
#include "ringlet/run/strand_graph.h"

#include <algorithm>

namespace ringlet {
namespace {

// Times in a step on lavapipe [ns]: a particle, a contact particle, each side of a pair that overlaps.
constexpr double kPerParticle = 80, kPerContactParticle = 82, kPerSide = 60;
constexpr double kUnit = 100;

}  // namespace

StrandGraph strandGraph(const RestState& rest, const RestContacts& contacts) {
  StrandGraph graph;
  graph.first.push_back(0);
  const auto& starts = contacts.particles.firstOfStrand;
  for (std::uint32_t s = 0; s < rest.strands.size(); ++s) {
    double weight =
        kPerParticle * rest.strands[s].particleCount + kPerContactParticle * (starts[s + 1] - starts[s]);
    contacts.eachPartner(s, [&](std::uint32_t other, std::uint32_t count) {
      graph.neighbours.push_back(static_cast<std::int32_t>(other));
      graph.overlaps.push_back(static_cast<std::int32_t>(count));
      weight += kPerSide * count;
    });
    graph.first.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
    graph.weights.push_back(std::max(1, static_cast<std::int32_t>(weight / kUnit)));
  }
  return graph;
}

}  // namespace ringlet
