// Roots that are off the scalp: above it, so that hair floats, or below, so that hair starts inside the head.
// The scalp is a surface that is given, or what the other roots lie on: a ball or a plane through most of
// them, and on it the median height of the roots around each.
#pragma once

#include <cstddef>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/scalp_surface.h"

namespace ringlet {

/// So many roots around each say where the scalp is there; half of them may be off it.
inline constexpr std::size_t kRootsAround = 16;
/// A root is off where it is so many times as far from the scalp as the spread of all roots' heights (as a
/// standard deviation, from the median distance): roots of scans scatter. Not from a scalp that is given.
inline constexpr double kHeightSpreads = 8;
/// And farther than this share of the spacing of roots, below which the scalp's form is not known, and of
/// strands' median length, below which nobody sees it.
inline constexpr double kHeightOfSpacing = 0.5, kHeightOfLength = 0.02;

struct RootHeights {
  std::vector<double> above{};   // of each strand's root over the scalp [unit], negative below
  std::vector<Vec3d> outward{};  // there, of length 1
  double limit = 0;              // a root is off where it is farther from the scalp than this [unit]
  std::vector<bool> isFloating{}, isSunk{};
};

/// Of a groom whose first particles are roots. `isLeftOut` are strands that neither are off nor tell. Without
/// `scalp` [m] none is off where fewer than 20 strands are left, or roots are in a row. Cost: n log n in the
/// strands; with a scalp a height of each.
RootHeights rootHeights(const Groom& groom, const std::vector<bool>& isLeftOut,
                        const ScalpSurface* scalp = nullptr);

}  // namespace ringlet
