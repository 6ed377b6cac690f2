// StrandGraph: the strands that touch pair by pair, weighted by their cost, for dividing them among devices.
// Iben et al. 2012, section 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_state.h"

namespace ringlet {

/// Strands in device order; the format of a graph for METIS.
struct StrandGraph {
  std::vector<std::int32_t> first;                 // strandCount + 1 entries, into the next two
  std::vector<std::int32_t> neighbours, overlaps;  // of each strand; number of overlaps at rest with each
                                                   // neighbour
  std::vector<std::int32_t> weights;               // of each strand: its share of a step [100 ns]

  std::size_t strandCount() const { return weights.size(); }
  std::span<const std::int32_t> neighboursOf(std::size_t s) const {
    return std::span(neighbours).subspan(std::size_t(first[s]), std::size_t(first[s + 1] - first[s]));
  }
};

/// Cost: linear in strands and their neighbours.
StrandGraph strandGraph(const RestState& rest, const RestContacts& contacts);

}  // namespace ringlet
