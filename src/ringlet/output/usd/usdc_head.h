// UsdcHead: a crate (.usdc) but for the frames, which stand behind it. All that a reader needs to find is in
// front, so that a file of any number of frames is whole from the beginning:
//
//   bootstrap | kUsdcMark | values | times, samples | sections | table of contents | frame 1 | frame 2 | ...
//
// Every attribute that moves has a sample for each frame that may come. Until a frame is there, its sample is
// "None": a writer adds the frame's bytes behind the last, and then makes eight bytes of the head lead to
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/output/usd/usd_stage.h"

namespace ringlet {

/// What stands behind the bootstrap of an animation of ours, where no value leads.
inline constexpr std::string_view kUsdcMark = "Ringlet frames 1";

/// An attribute that moves: where its samples are.
struct UsdcSamples {
  std::string path;  // "/Hair.points"
  UsdStageType type;
  std::size_t elements = 0;   // of each sample
  std::uint64_t countAt = 0;  // where their count is [byte]
  std::uint64_t repsAt = 0;   // and the 64 bits of each, at multiples of 8 [byte]
  std::uint64_t slot = 0;     // of its bytes, from where those of a frame begin [byte]
  bool comesLater = false;    // as in UsdStageAttribute: behind all others of its frame

  /// Of a sample: u64 count and elements of an array, else the element, filled up to eight.
  std::uint64_t byteCount() const {
    return (elements * type.elementBytes() + (type.isArray ? 8 : 0) + 7) / 8 * 8;
  }
};

struct UsdcHead {
  std::vector<std::byte> bytes;
  std::uint64_t endTimeCodeAt = 0, timeCountAt = 0;  // f64 and u64, at multiples of 8 [byte]
  std::uint64_t frameBytes = 0;                      // from a frame to the next
  std::uint64_t earlyBytes = 0;                      // of these, those of what does not come later
  std::vector<UsdcSamples> samples;                  // in the stage's order

  std::uint64_t placeOf(int frame, const UsdcSamples& of) const {
    return bytes.size() + static_cast<std::uint64_t>(frame - 1) * frameBytes + of.slot;
  }
  usdc::Rep repOf(int frame, const UsdcSamples& of) const {
    const std::uint64_t place = placeOf(frame, of);
    return of.type.isArray ? usdc::Rep::arrayAt(of.type.number, place) : usdc::Rep::at(of.type.number, place);
  }
};

/// The head of such a stage, with room for its frames, of which there is none yet. Without frames it is a
/// whole crate of what rests, and has no mark. Attributes have types that usdTypeOf knows.
UsdcHead usdcHeadOf(const UsdStage& stage);

}  // namespace ringlet
