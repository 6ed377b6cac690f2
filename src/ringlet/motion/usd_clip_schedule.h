// UsdClipSchedule: a clip set of a USD prim, checked: which clip holds at which time of the stage, and which
// of its own times that is.
//
//   clip time |    / knot     / knot
//             |   /          /          between two knots straight; two of one stage time are a jump;
//             |  /    knot  /           before the first and after the last it stays
//             | /          /
//             +------------+----------- stage time
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"

namespace ringlet {

/// Times are time codes, of the stage or of clips.
struct UsdClipKey {
  double stage = 0, clip = 0;
};

struct UsdClipSchedule {
  struct Range {
    double from = 0;       // and up to the next; the first holds before it, too
    std::size_t file = 0;  // into `files`
  };

  std::uint32_t prim = kNoUsdPrim;  // that has the set, and for it and those below it clips hold
  std::string name{};
  std::string primPath{};            // what is called so in clips: "/Model"
  std::vector<std::string> files{};  // as the layer names them
  std::vector<Range> ranges{};       // one or more, rising
  std::vector<UsdClipKey>
      knots{};             // rising, twice the same stage time at most; none: clips have the stage's times
  bool fillsGaps = false;  // where a clip says nothing its neighbours count

  double clipTimeAt(double stage) const;
  /// Where an attribute has a value in a range, by rising stage time, of which one or more: at its begin, at
  /// knots, and where the clip's samples fall, which have these times. A jump counts from just before its
  /// time. `most` bounds how many; an Error where there are more.
  Result<std::vector<UsdClipKey>> keysOf(std::size_t range, const std::vector<double>& sampleTimes,
                                         std::size_t most) const;
};

}  // namespace ringlet
