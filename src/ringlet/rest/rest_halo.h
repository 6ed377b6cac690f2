// RestHalo: if strands with contacts are divided into parts, the strands of other parts that those of one
// part may touch. Like the graph it is chosen once in the rest pose, so that communication between parts is
// static. Iben et al. 2012, section 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/rest/rest_contacts.h"

namespace ringlet {

/// The halo of one part; strands are in device order.
struct RestHalo {
  /// Another part with strands that may touch some of this one's. The `out` of each is the `in` of the other,
  /// in the same order.
  struct Peer {
    std::size_t part = 0;
    std::vector<std::uint32_t> out;  // strands of this part that its strands may touch, ascending
    std::vector<std::uint32_t> in;   // its strands that those of this part may touch, ascending
  };
  std::vector<std::uint32_t> here;    // strands of this part: its border ascending, then the others ascending
  std::size_t borderCount = 0;        // number of border strands: strands of other parts may touch them
  std::vector<std::uint32_t> around;  // its halo, ascending; for a part without strands, one strand of
                                      // another part
  std::vector<Peer> peers;            // by rising part
};

/// partOf: the part of each strand. Cost: linear in strands and pairs; quadratic if any two strands may
/// touch.
RestHalo haloOf(const RestContacts& contacts, std::span<const std::size_t> partOf, std::size_t own);

}  // namespace ringlet
