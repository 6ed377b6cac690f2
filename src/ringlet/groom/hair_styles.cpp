// Implements groom/hair_styles.h. All numbers are by eye.
#include "ringlet/groom/hair_styles.h"

namespace ringlet {
namespace {

struct Style {
  const char* name;
  double length, radius, turns;
  int locks;
  double bendLength;
  HairCut cut;
};

constexpr double kBend = 0.02;

const Style kStyles[] = {
    {"ringlets",
     0.28,
     0.008,
     8,
     150,
     kBend,
     {.hairline = "natural", .parting = "middle", .layers = 0.25, .straightRoot = 0.2, .clump = 0.5}},
    {"long",
     0.46,
     0.012,
     4,
     160,
     kBend,
     {.hairline = "natural", .parting = "middle", .layers = 0.1, .straightRoot = 0.4, .clump = 0.5}},
    {"bob",
     0.36,
     0.003,
     1.5,
     220,
     kBend,
     {.hairline = "natural", .parting = "left", .level = 0.1, .straightRoot = 0.3, .clump = 0.4}},
    {"fringe",
     0.36,
     0.003,
     1.5,
     220,
     kBend,
     {.hairline = "natural", .fringe = 0.085, .level = 0.1, .straightRoot = 0.3, .clump = 0.4}},
    {"layered",
     0.34,
     0.010,
     4,
     180,
     kBend,
     {.hairline = "natural", .parting = "left", .layers = 0.5, .straightRoot = 0.3, .clump = 0.5}},
    {"short",
     0.07,
     0.004,
     1.5,
     400,
     0.03,
     {.hairline = "natural", .top = 1.3, .sides = 0.5, .back = 0.6, .clump = 0.5}},
    {"coils", 0.1, 0.005, 12, 0, 0.4, {.hairline = "natural", .back = 0.8, .straightRoot = 0.05}},
};

}  // namespace

std::optional<HeadParameters> headOfStyle(std::string_view name) {
  for (const Style& style : kStyles) {
    if (style.name != name) continue;
    HeadParameters head;
    head.curl.length = style.length;
    head.curl.radius = style.radius;
    head.curl.turns = style.turns;
    head.lockCount = style.locks;
    head.bendLength = style.bendLength;
    head.cut = style.cut;
    return head;
  }
  return std::nullopt;
}

}  // namespace ringlet
