// AirSettings: drag and wind. Wind is uniform, with optional gusts and turbulence: a field without divergence
// that depends on the seed only. Part of scene/settings.h.
#pragma once

#include <cstdint>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Ranges are checked by checkSettings (rest/rest_state.h).
struct AirSettings {
  bool on = false;  // false: hair moves in a vacuum

  // Acceleration by air that moves relative to the strand at u: g |u_across| u_across / fallSpeed^2, and
  // alongShare times the same expression along the strand.
  double fallSpeed = 4;     // terminal speed of a falling horizontal strand [m/s], 0.01 to 1000
  double alongShare = 0.1;  // 0 to 1

  Vec3d wind{};            // uniform wind, each component from -1000 to 1000 [m/s]
  double gust = 0;         // largest increase of the wind as a share of it; half of it on average; 0 to 10
  double gustSeconds = 2;  // mean time between gusts [s], 0.01 to 1000
  double turbulence = 0;   // root mean square of each component of the turbulent wind [m/s], 0 to 1000
  double eddySize = 0.2;   // size of the largest eddies [m], 0.001 to 1000
  std::uint32_t seed = 1;  // of gusts and turbulence
  bool operator==(const AirSettings&) const = default;
};

}  // namespace ringlet
