// measure/material_suggestion.h: which preset a groom looks like, and where that is clear: on either side of
// every bound, and near it.
#include "ringlet/measure/material_suggestion.h"

#include <gtest/gtest.h>

#include <string>

namespace ringlet::material_suggestion_test {
namespace {

struct Case {
  std::size_t curled;  // of ten strands
  double width;        // of curls [m]
  double arc;          // over the chord
  const char* preset;
  bool isClear;
};

constexpr double kUnit = 0.01;

MaterialSuggestion suggestionFor(const Case& c) {
  GroomInspection groom;
  groom.strandCount = 10;
  groom.curledCount = c.curled;
  groom.radius.median = c.width / 2 / kUnit;
  groom.arcOverChord.median = c.arc;
  return suggestMaterial(groom, kUnit);
}

// Widths of 12 and 25 mm and arcs of 4 and 1.1 chords tell presets apart; a fifth from each is clear.
TEST(MaterialSuggestion, IsClearAwayFromEveryBoundOnly) {
  for (const Case& c : {Case{10, 0.005, 2, "coil", true},        Case{10, 0.011, 2, "coil", false},
                        Case{10, 0.013, 2, "ringlet", false},    Case{10, 0.017, 2, "ringlet", true},
                        Case{10, 0.022, 2, "ringlet", false},    Case{10, 0.027, 2, "loose_curl", false},
                        Case{10, 0.04, 2, "loose_curl", true},   Case{10, 0.017, 3.5, "ringlet", false},
                        Case{10, 0.017, 4.5, "coil", false},     Case{10, 0.04, 6, "coil", true},
                        Case{8, 0.017, 2, "ringlet", true},      Case{7, 0.017, 2, "ringlet", false},
                        Case{5, 0.017, 2, "ringlet", false},     Case{4, 0.017, 1.02, "straight", false},
                        Case{3, 0.017, 1.02, "straight", false}, Case{2, 0.017, 1.02, "straight", true},
                        Case{0, 0, 1, "straight", true},         Case{0, 0, 1.09, "straight", false},
                        Case{0, 0, 1.11, "wavy", false},         Case{0, 0, 1.3, "wavy", true}}) {
    const MaterialSuggestion found = suggestionFor(c);
    EXPECT_EQ(found.preset, c.preset) << c.curled << " curled, " << c.width << " m wide, arc " << c.arc;
    EXPECT_EQ(found.isClear, c.isClear) << c.curled << " curled, " << c.width << " m wide, arc " << c.arc;
  }
}

}  // namespace
}  // namespace ringlet::material_suggestion_test
