// DividedHair: hair with contacts whose strands are divided among several devices. Each part holds all
// strands and steps its own. It has lists and contacts of its own strands only, with strands of any part, and
// computes the volume's terms for its own particles. All parts build the same search grids. Parts exchange
// the rows of their strands over a PartLink, twice a step:
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

/// For each strand, device order: whether it is in `part`, groom order. Errors: as restrictTo.
Result<std::vector<bool>> strandsHere(const RestState& rest, std::span<const std::uint32_t> part);

/// The ranges, cut to the consecutive strands that are stepped here.
std::vector<StrandRange> rangesHere(std::span<const StrandRange> ranges, const RestState& rest,
                                    const std::vector<bool>& isHere);

class DividedHair {
 public:
  /// The rows that are exchanged: at a step's start, or after one of its solves.
  enum class Rows { step, solve };

  /// Rows of a buffer, one vec4 per particle, from a first row on.
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

  /// Records the download of the own rows, after a barrier, and the upload of the others', before one.
  void recordOut(gpu::CommandList& list, Rows rows) const;
  void recordIn(gpu::CommandList& list, Rows rows) const;
  /// Exchanges rows on the host, between the two.
  Status exchange(Rows rows);
  /// The sum over all parts.
  Result<ContactStage::Sample> sum(const ContactStage::Sample& own);
  /// Tells the other parts that this one has failed.
  void fail(const Error& why) { link_->fail(why); }

  std::uint64_t bytes() const { return crossing_->bytes(); }

 private:
  struct Run {
    std::size_t first = 0, end = 0;  // rows
  };
  // Rows of a buffer, and their place in crossing_ [bytes].
  struct Piece {
    const gpu::Buffer* buffer = nullptr;
    std::size_t inBuffer = 0, inCrossing = 0, bytes = 0;
  };
  // For each kind of rows: its place in crossing_ [bytes], and a section per part.
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
  // Rows of the step are kept as they came until its lists have room.
  Crossing step_, solve_;
  std::optional<gpu::Buffer> crossing_;
};

}  // namespace ringlet
