// Implements run/strand_parts.h.
#include "ringlet/run/strand_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#ifdef RINGLET_HAS_METIS
#include <metis.h>
#endif

#include "ringlet/base/assert.h"

namespace ringlet {
namespace {

using Parts = std::vector<std::vector<std::uint32_t>>;

// Deals out strands by rising length, to each part in turn, so that all parts get about as many of each
// length.
Parts dealStrands(const Groom& groom, std::size_t count) {
  std::vector<std::uint32_t> order(groom.strandCount());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t s) { return groom.strand(s).size(); });
  Parts parts(count);
  for (std::size_t k = 0; k < order.size(); ++k) parts[k % count].push_back(order[k]);
  return parts;
}

std::vector<std::int32_t> divide(const StrandGraph& graph, int count) {
  constexpr double kMostImbalance = 1.05;
  if (!hasMetis() || count < 2) return partsAlongCurve(graph, count);
  std::vector<std::int32_t> parts = partsByMetis(graph, count, false);
  if (imbalance(graph, parts, count) <= kMostImbalance) return parts;
  std::vector<std::int32_t> byWays = partsByMetis(graph, count, true);
  return imbalance(graph, byWays, count) < imbalance(graph, parts, count) ? byWays : parts;
}

// Gives every empty part a strand, the last of the largest part.
void fillEmpty(Parts& parts) {
  for (auto& part : parts) {
    if (!part.empty()) continue;
    auto& largest = *std::ranges::max_element(parts, {}, &std::vector<std::uint32_t>::size);
    part.push_back(largest.back());
    largest.pop_back();
  }
}

}  // namespace

std::vector<std::int32_t> partsAlongCurve(const StrandGraph& graph, int count) {
  const double whole = std::accumulate(graph.weights.begin(), graph.weights.end(), 0.0);
  std::vector<std::int32_t> parts;
  double before = 0;
  for (const std::int32_t weight : graph.weights) {
    parts.push_back(std::min(count - 1, static_cast<int>(before / whole * count)));
    before += weight;
  }
  return parts;
}

#ifdef RINGLET_HAS_METIS
bool hasMetis() { return true; }

std::vector<std::int32_t> partsByMetis(const StrandGraph& graph, int count, bool byWays) {
  static_assert(sizeof(idx_t) == sizeof(std::int32_t));
  auto first = graph.first, neighbours = graph.neighbours, overlaps = graph.overlaps, weights = graph.weights;
  idx_t strands = static_cast<idx_t>(graph.strandCount()), constraints = 1, parts = count, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<std::int32_t> of(graph.strandCount());
  (byWays ? METIS_PartGraphKway : METIS_PartGraphRecursive)(
      &strands, &constraints, first.data(), neighbours.data(), weights.data(), nullptr, overlaps.data(),
      &parts, nullptr, nullptr, options, &cut, of.data());
  return of;
}
#else
bool hasMetis() { return false; }

std::vector<std::int32_t> partsByMetis(const StrandGraph&, int, bool) {
  RINGLET_ASSERT(false, "partsByMetis without METIS");
  return {};
}
#endif

double imbalance(const StrandGraph& graph, std::span<const std::int32_t> parts, int count) {
  std::vector<double> weights(static_cast<std::size_t>(count), 0.0);
  for (std::size_t s = 0; s < parts.size(); ++s)
    weights[static_cast<std::size_t>(parts[s])] += graph.weights[s];
  const double whole = std::accumulate(weights.begin(), weights.end(), 0.0);
  return *std::ranges::max_element(weights) * count / whole;
}

Result<Parts> divideStrands(const Groom& groom, const Settings& settings, const WholeRest& rest,
                            std::size_t count) {
  if (count > groom.strandCount())
    return Error{fmt::format("{} parts are more than the groom's {} strands", count, groom.strandCount())};
  if (!rest.contacts || !rest.contacts->kinds.pairs) return dealStrands(groom, count);
  std::optional<RestContacts> near;
  if (!settings.contacts.prunePairs) {  // any pair may touch: take pairs that are near at rest
    ContactSettings pruned = settings.contacts;
    pruned.prunePairs = true, pruned.minOverlaps = 1;
    near = buildRestContacts(rest.state, pruned);
  }
  const auto partOf = divide(strandGraph(rest.state, near ? *near : *rest.contacts), static_cast<int>(count));
  Parts parts(count);
  for (std::size_t s = 0; s < partOf.size(); ++s)
    parts[static_cast<std::size_t>(partOf[s])].push_back(rest.state.strandInGroom[s]);
  // Rigid strands have no contacts, so they may be in any part.
  for (std::size_t k = 0; k < rest.state.rigid.size(); ++k)
    parts[k % count].push_back(rest.state.rigid[k].strandInGroom);
  fillEmpty(parts);
  return parts;
}

}  // namespace ringlet
