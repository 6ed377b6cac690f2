// BodyOutcome: what became of hair at a body in a run.
#pragma once

#include <optional>
#include <string>

#include "ringlet/measure/body_watch.h"
#include "ringlet/scene/body.h"

namespace ringlet {

struct BodyOutcome {
  std::string name, shape;
  bool bends = false, isCloth = false;
  std::optional<double> cell{};  // edge of a cell of its grid [m]; none of an exact form and of cloth
  double within = 0;             // keepsOutWithin [m]
  BodyNumbers numbers;
};

BodyOutcome bodyOutcome(const Body& body, const BodyNumbers& numbers);

/// In words, if hair was caught in it: where it was deepest, and what may help.
std::optional<std::string> caughtWarning(const BodyOutcome& body);

}  // namespace ringlet
