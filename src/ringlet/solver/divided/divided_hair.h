// DividedHair: the communication of hair with contacts whose strands are divided among several devices, over
// a PartLink. Each part steps its own strands and has a copy of those strands of other parts that they may
// touch, its halo (rest/rest_halo.h): the halo's contact particles are in its search grid, but have no lists
// and no contacts there. A part exchanges rows of contact particles with each part of its halo twice a step:
//
//   v^0 -> rows of the step -> lists, contacts -> solve -> v^1 -> rows of the solve -> contacts -> solve ->
//   move
//
// While the rows of its border are exchanged, a part steps its other strands (divided_frames.cpp).
//
// For hair as a volume the parts add up the sums at the grid's nodes (volume_stage.h) in each iteration.
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
  /// The link and the hair's buffers must outlive this. Fails when the device lacks memory.
  static Result<DividedHair> create(gpu::Device& device, const RestContacts& contacts, const RestHalo& halo,
                                    PartLink& link, const DeviceChunk& hair);

  /// recordOut packs this part's rows, after a barrier; recordIn unpacks the others' rows, before a barrier.
  void recordOut(gpu::CommandList& list, Rows rows) const;
  void recordIn(gpu::CommandList& list, Rows rows) const;
  /// Exchanges rows on the host, between recordOut and recordIn.
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
