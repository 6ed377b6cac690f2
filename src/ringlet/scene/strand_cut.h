// A cut through a strand.
#pragma once

#include <cstdint>

namespace ringlet {

/// Of a strand, groom order, the particles from `keep` on are cut off.
struct StrandCut {
  std::uint32_t strand = 0, keep = 0;
  bool operator==(const StrandCut&) const = default;
};

}  // namespace ringlet
