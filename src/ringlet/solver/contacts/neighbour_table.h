// The hash table of pairs of strands that may touch, for contact_query.comp. A look-up has the same cost for
// any number of neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/volume_strands.h"

namespace ringlet {

/// A record per strand: (its first bucket, the number of its buckets minus 1, its group, 1 if another device
/// steps it: the last `haloCount` strands); then the buckets, each of four strands or layout::kNoStrand.
/// Neighbour s is in the first bucket with a free place, starting from bucket (s * 2654435761 >> 16), modulo
/// the number of buckets, which is a power of two; at most half of the places are taken, so there is one. A
/// graph that allows every pair has no buckets. Cost: linear in neighbours; 8 to 16 bytes each.
std::vector<std::array<std::uint32_t, 4>> neighbourTable(const ContactGraph& graph,
                                                         const VolumeStrands& volume,
                                                         std::size_t haloCount = 0);

}  // namespace ringlet
