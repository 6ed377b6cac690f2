// DividedHair: hair in contact whose strands several devices step. Every part holds all strands and steps its
// own; lists and contacts it has of its own strands only, with any strand. The grids in which strands find
// each other all parts make alike. What a part's strands do goes to the others over a PartLink, twice a step:
//
//   v^0 -> rows of the step -> lists, contacts, volume -> solve -> v^1 -> rows of the solve -> ... -> move
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/contact_stage.h"
#include "ringlet/solver/device_groom.h"
#include "ringlet/solver/part_link.h"
#include "ringlet/solver/shape_plan.h"

namespace ringlet {

/// Of each strand, device order: whether it is among `part`, groom order. Errors: as restrictTo.
Result<std::vector<bool>> strandsHere(const RestState& rest, std::span<const std::uint32_t> part);

/// The runs of strands that are here, of whole ranges.
std::vector<StrandRange> rangesHere(std::span<const StrandRange> ranges, const RestState& rest,
                                    const std::vector<bool>& isHere);

class DividedHair {
 public:
  /// What crosses of each particle: positions, velocities and v^0 at a step's start; or v^k.
  enum class Rows { step, solve };

  /// Errors: strands that are in no part or in two; a device that lacks memory. The link must live as long.
  static Result<DividedHair> create(gpu::Device& device, const RestState& rest, PartLink& link);

  /// The own rows to the host, after a barrier; and the others' rows to the device, before one.
  void recordOut(gpu::CommandList& list, const DeviceChunk& hair, Rows rows) const;
  void recordIn(gpu::CommandList& list, const DeviceChunk& hair, Rows rows) const;
  /// Between the two, on the host.
  Status exchange(Rows rows);
  /// Of all parts.
  Result<ContactStage::Sample> sum(const ContactStage::Sample& own);
  /// This part has failed.
  void fail(const Error& why) { link_->fail(why); }

  std::uint64_t bytes() const { return crossing_.bytes(); }

 private:
  struct Run {
    std::uint32_t firstParticle = 0, count = 0;
  };
  DividedHair(PartLink& link, gpu::Buffer crossing) : link_(&link), crossing_(std::move(crossing)) {}
  std::size_t beginOf(Rows rows) const;  // in crossing_ [bytes]
  template <class Copy>
  void eachRun(std::size_t part, const DeviceChunk& hair, Rows rows, const Copy& copy) const;

  PartLink* link_;
  std::vector<std::vector<Run>> runs_{};    // of each part's particles, device order
  std::vector<std::size_t> countBefore_{};  // particles of the parts before
  gpu::Buffer crossing_;                    // of either kind a section for each part: by field, its runs
};

}  // namespace ringlet
