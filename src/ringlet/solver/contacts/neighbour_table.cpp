// Implements solver/contacts/neighbour_table.h.
#include "ringlet/solver/contacts/neighbour_table.h"

#include <algorithm>
#include <bit>
#include <span>

#include "layout/contacts.h"

namespace ringlet {

std::vector<std::array<std::uint32_t, 4>> neighbourTable(const ContactGraph& graph,
                                                         const VolumeStrands& volume, std::size_t haloCount) {
  constexpr std::array<std::uint32_t, 4> kEmpty{layout::kNoStrand, layout::kNoStrand, layout::kNoStrand,
                                                layout::kNoStrand};
  const std::size_t strandCount = volume.groups.size();
  std::vector<std::array<std::uint32_t, 4>> table(strandCount);
  for (std::size_t s = 0; s < strandCount; ++s)
    table[s] = {0, 0, volume.groups[s], s + haloCount < strandCount ? 0u : 1u};
  if (graph.everyPair) return table;
  for (std::size_t s = 0; s < strandCount; ++s) {
    const std::span neighbours(graph.neighbours.begin() + graph.firstNeighbour[s],
                               graph.neighbours.begin() + graph.firstNeighbour[s + 1]);
    const std::uint32_t buckets =
        std::bit_ceil(static_cast<std::uint32_t>(std::max<std::size_t>(1, (neighbours.size() + 1) / 2)));
    const std::size_t first = table.size();
    table[s][0] = static_cast<std::uint32_t>(first);
    table[s][1] = buckets - 1;
    table.resize(first + buckets, kEmpty);
    for (const std::uint32_t neighbour : neighbours) {
      std::uint32_t bucket = neighbour * 2654435761u >> 16;
      const auto room = [&] {
        return std::ranges::find(table[first + (bucket & (buckets - 1))], layout::kNoStrand);
      };
      while (room() == table[first + (bucket & (buckets - 1))].end()) ++bucket;
      *room() = neighbour;
    }
  }
  return table;
}

}  // namespace ringlet
