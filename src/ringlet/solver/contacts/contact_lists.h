// Lists of contact particles in device memory. A list is made of blocks, which kernels take from one store.
// Where the store or a list's table of blocks is too small, the frame stops, and its step is repeated with
// larger buffers (ContactStage::makeRoom).
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
  std::uint32_t blocks = 0;  // in the store
  std::uint32_t most = 0;    // in one list, at most
  bool operator==(const ListRoom&) const = default;

  ListRoom times(int factor) const {
    return {blocks * static_cast<std::uint32_t>(factor), most * static_cast<std::uint32_t>(factor)};
  }
  /// The room for this number of blocks in all and for a longest list of this number of entries; what is
  /// enlarged gets a quarter more than is needed.
  ListRoom grownTo(std::uint32_t wantedBlocks, std::uint32_t longest, std::uint32_t blockSize) const {
    const auto larger = [](std::uint32_t wanted, std::uint32_t now) {
      return wanted > now ? wanted + wanted / 4 + 1 : now;
    };
    return {larger(wantedBlocks, blocks), larger((longest + blockSize - 1) / blockSize, most)};
  }
};

/// The device that lists are made on, and their number.
struct ListMaker {
  gpu::Device* device = nullptr;
  std::size_t contactCount = 0;
  std::uint64_t largestBuffer = 0;  // [bytes]

  struct Part {
    const char* name;
    std::uint64_t bytes;
  };
  /// Makes the buffers of lists of at most `longest` entries, filled with zeros. Fails, with the numbers, if
  /// one of them is larger than a buffer may be, or all together are larger than the memory left.
  Result<std::vector<gpu::Buffer>> make(std::span<const Part> parts, std::uint32_t longest) const;
};

}  // namespace ringlet
