// Which strands of a groom are simulated, so that the others can follow them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/follow/rest_shape.h"

namespace ringlet {

/// What makes two strands alike, for whoever follows whom: nine places along the core and the size of the
/// curl.
class StrandTraits {
 public:
  explicit StrandTraits(std::span<const RestShape> strands);

  std::size_t count() const { return all_.size() / kSize; }
  /// Mean square distance of two strands' cores, each at the same share of its way [m^2].
  double apart(std::size_t a, std::size_t b) const { return apart(of(a), of(b)); }
  /// The `most` of these strands, or all, that are most like one; of equals the first.
  std::vector<std::uint32_t> nearest(std::size_t strand, std::span<const std::uint32_t> among,
                                     std::size_t most) const;
  /// Of `members` the one that is most like their mean; of equals the first.
  std::uint32_t middleOf(std::span<const std::uint32_t> members) const;

 private:
  static constexpr std::size_t kPlaces = 9, kSize = 3 * kPlaces + 1;
  std::span<const float> of(std::size_t strand) const {
    return std::span(all_).subspan(strand * kSize, kSize);
  }
  static double apart(std::span<const float> a, std::span<const float> b);

  std::vector<float> all_;  // [m]
};

/// `count` of the strands, rising, or all: first the one that is most like none picked before, so that strays
/// lead themselves; then each becomes the middle of the strands that are more like it than like any other, as
/// long as that brings them nearer (k-medoids by Lloyd's rounds, begun as Gonzalez 1985). The same strands
/// give the same choice. Cost: strands times `count`, some ten times.
std::vector<std::uint32_t> pickGuides(const StrandTraits& strands, std::size_t count);

}  // namespace ringlet
