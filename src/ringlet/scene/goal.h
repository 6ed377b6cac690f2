// GoalSettings: the groom itself as a goal, carried by the head. Part of scene/settings.h.
#pragma once

namespace ringlet {

/// Ranges are checked by checkSettings (rest/rest_state.h).
struct GoalSettings {
  bool on = false;      // hair is pulled to the groom
  double strength = 1;  // at the root, weights of the hair a centimetre from its place; 0 to 1e7
  double tipShare = 1;  // at the tip, as a share of that, evenly between; 0 to 100
  double damping = 1;   // ratio about its place; 1 is critical; 0 to 100
  bool shape = false;   // goals are of edges, so that hair keeps how it lies, not where; then strength is in
                        // the strand's weight, as bend stiffness is
  bool operator==(const GoalSettings&) const = default;
};

}  // namespace ringlet
