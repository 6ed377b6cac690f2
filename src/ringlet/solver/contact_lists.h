// Lists of contact particles in device memory. A list is as long as it must be, in blocks that kernels take
// from one store; where the store or a list's own table of blocks is too small, the frame stops and begins
// its step anew with more room (ContactStage::makeRoom).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/device.h"

namespace ringlet {

struct ListRoom {
  std::uint32_t blocks = 0;  // there are, for all lists
  std::uint32_t most = 0;    // of one list
  bool operator==(const ListRoom&) const = default;

  ListRoom times(int factor) const {
    return {blocks * static_cast<std::uint32_t>(factor), most * static_cast<std::uint32_t>(factor)};
  }
  /// Room for so many blocks in all, the longest list being of so many entries; where it is too small, that
  /// and a quarter more.
  ListRoom grownTo(std::uint32_t wantedBlocks, std::uint32_t longest, std::uint32_t blockSize) const {
    const auto larger = [](std::uint32_t wanted, std::uint32_t now) {
      return wanted > now ? wanted + wanted / 4 + 1 : now;
    };
    return {larger(wantedBlocks, blocks), larger((longest + blockSize - 1) / blockSize, most)};
  }
};

/// Where lists are made, and for how many.
struct ListMaker {
  gpu::Device* device = nullptr;
  std::size_t contactCount = 0;
  std::uint64_t largestBuffer = 0;  // [bytes]

  struct Part {
    const char* name;
    std::uint64_t bytes;
  };
  /// The parts of lists of at most `longest` entries, filled with zeros. Fails, with the numbers, where a
  /// part is larger than a buffer may be or all of them than what memory there is.
  Result<std::vector<gpu::Buffer>> make(std::span<const Part> parts, std::uint32_t longest) const;
};

}  // namespace ringlet
