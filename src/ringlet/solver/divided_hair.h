// DividedHair: hair in contact whose strands several devices step. Every part holds all strands and steps its
// own; lists and contacts it has of its own strands only, with any strand, and of the volume what its own
// particles bring and take. The grids in which strands find each other all parts make alike. What a part's
// strands do goes to the others over a PartLink, twice a step:
//
//   v^0 -> rows of the step -> lists, contacts, volume -> solve -> v^1 -> rows of the solve -> ... -> move
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/command_list.h"
#include "ringlet/gpu/device.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/rest/rest_volume.h"
#include "ringlet/solver/contact_stage.h"
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
  /// What crosses: at a step's start, or after one of its solves.
  enum class Rows { step, solve };

  /// Rows of a buffer, a vec4 for each particle, from a row on.
  struct Field {
    const gpu::Buffer* buffer = nullptr;
    std::size_t firstRow = 0;
  };
  struct Fields {
    std::vector<Field> step, solve;  // by Rows
  };

  /// ofHair: a row for each particle; ofVolume: for each of `volume`. Errors: strands that are in no part or
  /// in two; a device that lacks memory. The link and the buffers must live as long.
  static Result<DividedHair> create(gpu::Device& device, const RestState& rest, PartLink& link,
                                    const Fields& ofHair, const std::optional<RestVolume>& volume,
                                    const Fields& ofVolume);

  /// The own rows to the host, after a barrier; and the others' rows to the device, before one.
  void recordOut(gpu::CommandList& list, Rows rows) const;
  void recordIn(gpu::CommandList& list, Rows rows) const;
  /// Between the two, on the host.
  Status exchange(Rows rows);
  /// Of all parts.
  Result<ContactStage::Sample> sum(const ContactStage::Sample& own);
  /// This part has failed.
  void fail(const Error& why) { link_->fail(why); }

  std::uint64_t bytes() const { return crossing_->bytes(); }

 private:
  struct Run {
    std::size_t first = 0, end = 0;  // rows
  };
  // Some rows of a buffer, and where they are in crossing_ [bytes].
  struct Piece {
    const gpu::Buffer* buffer = nullptr;
    std::size_t inBuffer = 0, inCrossing = 0, bytes = 0;
  };
  // Of either kind of rows: its place in crossing_ [bytes], and a section for each part.
  struct Crossing {
    std::size_t begin = 0;
    std::vector<std::size_t> ends;  // from begin on
    std::vector<std::vector<Piece>> pieces;

    void addPart(std::span<const Run> hair, std::span<const Field> ofHair, std::span<const Run> volume,
                 std::span<const Field> ofVolume);
    std::size_t bytes() const { return ends.back(); }
  };
  explicit DividedHair(PartLink& link) : link_(&link) {}
  const Crossing& of(Rows rows) const { return rows == Rows::step ? step_ : solve_; }

  PartLink* link_;
  // Rows of the step stay as they came until its lists have room.
  Crossing step_, solve_;
  std::optional<gpu::Buffer> crossing_;
};

}  // namespace ringlet
