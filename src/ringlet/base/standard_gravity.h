// The gravity that a strand's weight is computed with, whatever the gravity of the scene.
#pragma once

namespace ringlet {

inline constexpr double kStandardGravity = 9.81;  // [m/s^2]

}  // namespace ringlet
