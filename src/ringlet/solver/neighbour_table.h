// The table of who may touch whom, as contact_query.comp looks it up: hashed, so that a look costs the same
// for any number of neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/contacts.h"
#include "ringlet/rest/contact_graph.h"
#include "ringlet/rest/volume_strands.h"

namespace ringlet {

/// A record for each strand: (first of its buckets, their number less one, its group, 1 where `isHere` says
/// that another device steps it; none: all are here); then the buckets, each four strands or
/// layout::kNoStrand. A strand s is in the first bucket with room from (s * 2654435761
/// >> 16) on, modulo their number, a power of two; buckets are at most half full on average, so one with room
/// always comes. No buckets for a graph that allows every pair. Cost: linear in neighbours; 8 to 16 bytes
/// each.
std::vector<std::array<std::uint32_t, 4>> neighbourTable(const ContactGraph& graph,
                                                         const VolumeStrands& volume,
                                                         const std::vector<bool>& isHere = {});

}  // namespace ringlet
