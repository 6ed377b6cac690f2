// HairKernels: the strand kernels of one head, bound to its buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "ringlet/gpu/kernel.h"
#include "ringlet/solver/inputs/head_places.h"
#include "ringlet/solver/plan/shape_plan.h"

namespace ringlet {

/// The buffers and bindings with which a dispatch steps this head and some that follow it in its row.
struct BoundHeads {
  HeadBuffers buffers;
  std::vector<gpu::Bindings> bindings;  // one a range
};

/// Kernels for these ranges.
struct StrandKernels {
  const std::vector<StrandRange>* ranges = nullptr;
  std::vector<std::shared_ptr<const gpu::Kernel>> kernels{};  // one per shape
  std::vector<std::size_t> kernelOf{};                        // index into kernels, by range
  std::vector<gpu::Bindings> bindings{};                      // one per range
  std::shared_ptr<const gpu::Kernel>
      cloth{};  // lists the cloth near to their particles; null: there is no cloth
  std::vector<gpu::Bindings> clothBindings{};     // one per range
  bool areOfHeads = false;                        // StrandKernelOptions::heads
  bool areFallen = false;                         // StrandKernelOptions::falls
  std::map<std::uint32_t, BoundHeads> ofHeads{};  // by number of heads; for a single head
                                                  // `bindings` are used

  const gpu::Bindings& bindingsOf(std::uint32_t range, std::uint32_t heads) const {
    return heads > 1 ? ofHeads.at(heads).bindings[range] : bindings[range];
  }
  bool areThere() const { return !kernels.empty(); }
};

struct HairKernels {
  StrandKernels strands;
  StrandKernels firstSolve;  // for the first solve of a step; none: `strands` are used
  StrandKernels fallen;      // for fallen hair
};

}  // namespace ringlet
