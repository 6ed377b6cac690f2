// DividedHair: the communication of hair with contacts whose strands are divided among several devices, over
// a PartLink. Each part steps its own strands, and knows those of other parts that they may touch
// (rest/rest_halo.h): it has their contact particles in its search grid, but no lists and no contacts of
// them. With each part of its halo it exchanges the rows of contact particles twice a step:
//
//   v^0 -> rows of the step -> lists, contacts -> solve -> v^1 -> rows of the solve -> contacts -> solve ->
//   move
//
// Those of its border are on their way while a part steps its other strands (divided_frames.cpp).
//
// Of hair as a volume the parts add up the sums at the grid's nodes (volume_stage.h) in each iteration.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/gpu/kernel.h"
#include "ringlet/rest/rest_contacts.h"
#include "ringlet/rest/rest_halo.h"
#include "ringlet/solver/part_link.h"
#include "ringlet/solver/plan/frame_plan.h"
#include "ringlet/solver/strands/device_groom.h"

namespace ringlet {

class DividedHair {
 public:
  /// The link and the hair's buffers must live as long. Errors: a device that lacks memory.
  static Result<DividedHair> create(gpu::Device& device, const RestContacts& contacts, const RestHalo& halo,
                                    PartLink& link, const DeviceChunk& hair);

  /// Records the packing of the own rows, after a barrier, and the unpacking of the others', before one.
  void recordOut(gpu::CommandList& list, Rows rows) const;
  void recordIn(gpu::CommandList& list, Rows rows) const;
  /// Exchanges rows on the host, between the two.
  Status exchange(Rows rows);
  PartLink& link() { return *link_; }
  /// Tells the other parts that this one has failed.
  void fail(const Error& why) { link_->fail(why); }

  std::uint64_t bytes() const;

 private:
  // Contact particles of all peers, one peer after another, and their rows.
  struct Direction {
    std::shared_ptr<const gpu::Kernel> kernel;
    std::optional<gpu::Buffer> particles, rows;
    std::optional<gpu::Bindings> bindings;
    std::vector<std::uint32_t> ends;  // of each peer [particles]

    std::uint32_t count() const { return ends.empty() ? 0 : ends.back(); }
  };
  explicit DividedHair(PartLink& link) : link_(&link) {}
  void record(gpu::CommandList& list, const Direction& direction, Rows rows) const;

  PartLink* link_;
  std::vector<std::size_t> peers_;  // their parts
  Direction out_, in_;
};

}  // namespace ringlet
