// The gravity by which a strand's weight is reckoned, whatever the gravity of the scene.
#pragma once

namespace ringlet {

inline constexpr double kStandardGravity = 9.81;  // [m/s^2]

}  // namespace ringlet
