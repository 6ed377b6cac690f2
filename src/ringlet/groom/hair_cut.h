// HairCut: what makes a generated head look cut and combed. Directions are those of generate.h: Y up, +Z
// where the face looks, +X the head's own left.
#pragma once

#include <optional>
#include <string>

namespace ringlet {

inline constexpr const char* kHairlines = "cap, natural";
inline constexpr const char* kPartings = "none, left, middle, right";

/// The defaults leave a head as it is without any.
struct HairCut {
  std::string hairline = "cap";  // of kHairlines; natural: with bays at the temples and room for the ears
  std::string parting = "none";  // of kPartings; hair falls to either side of it
  double fringe = 0;             // length of the hair above the brow, combed over it [m], in [0, 10]; 0: none
  double top = 1;                // factor on the length of hair on top, in [0.05, 10]
  double sides = 1;              // at the sides
  double back = 1;               // behind
  double layers = 0;  // share by which hair from the crown is shorter than hair from below, in [0, 0.95]
  std::optional<double> level{};  // height below the head's middle at which ends are cut [m], in [-1, 10]
  double straightRoot = 0;        // share of the length before a curl begins, in [0, 0.95]
  double clump = 0;  // share by which strands of a lock come together towards their tips, in [0, 1]
  bool operator==(const HairCut&) const = default;
};

}  // namespace ringlet
