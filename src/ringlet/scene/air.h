// AirSettings: the air hair moves in. It is still, or wind: an even one, gusts on top, and turbulence, a
// field without divergence that is the same for everybody who uses the same seed. Part of scene/settings.h.
#pragma once

#include <cstdint>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Ranges are checked by checkSettings (rest/rest_state.h).
struct AirSettings {
  bool on = false;  // false: hair moves in a vacuum

  // How hair feels air that moves past it at u, across the strand and along it: an acceleration of
  // g |u_across| u_across / fallSpeed^2, and alongShare times the like along it.
  double fallSpeed = 4;  // at which air carries hair's weight [m/s], 0.01 to 1000: less, and wind takes more
  double alongShare = 0.1;  // 0 to 1

  Vec3d wind{};            // even wind, each component from -1000 to 1000 [m/s]
  double gust = 0;         // the wind swells by up to this share of itself, half of it on average; 0 to 10
  double gustSeconds = 2;  // from gust to gust, on average [s], 0.01 to 1000
  double turbulence = 0;   // root mean square of each component of the turbulent wind [m/s], 0 to 1000
  double eddySize = 0.2;   // of its largest eddies [m], 0.001 to 1000
  std::uint32_t seed = 1;  // of gusts and turbulence
};

}  // namespace ringlet
