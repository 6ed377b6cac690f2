// Implements run/body_outcome.h.
#include "ringlet/run/body_outcome.h"

#include <fmt/format.h>

#include "ringlet/base/quoted.h"
#include "ringlet/scene/body_forms.h"

namespace ringlet {

BodyOutcome bodyOutcome(const Body& body, const BodyNumbers& numbers) {
  return {.name = body.name,
          .shape = std::string(nameOf(body.shape)),
          .bends = body.bends(),
          .isCloth = body.isCloth(),
          .cell = gridCellOf(body),
          .within = keepsOutWithin(body),
          .numbers = numbers};
}

std::optional<std::string> caughtWarning(const BodyOutcome& body) {
  if (body.numbers.caught == 0) return std::nullopt;
  return fmt::format(
      "{} particle{} went deeper into the body {} than the {:.3g} mm within which it keeps hair out: up to {:.3g} "
      "mm, strand {} particle {} in frame {}. Surfaces that close on each other leave hair no place, nor "
      "does a body that comes over its roots; a larger thickness keeps surfaces apart, and more steps a frame "
      "follow a faster body",
      body.numbers.caught, body.numbers.caught == 1 ? "" : "s", quoted(std::string_view(body.name)),
      1000 * body.within, 1000 * body.numbers.deepest, body.numbers.strand, body.numbers.particle,
      body.numbers.frame + 1);
}

}  // namespace ringlet
