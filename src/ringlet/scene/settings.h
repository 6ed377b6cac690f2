// Settings: how a scene is stepped. Everything here holds for a whole run; the properties of hair are in
// rest/material.h.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

#include "ringlet/base/vec3.h"
#include "ringlet/scene/air.h"
#include "ringlet/scene/contact_settings.h"
#include "ringlet/scene/goal.h"

namespace ringlet {

/// How an outer step finds the new velocities; see docs/method.md.
enum class Integrator {
  jacobi,       // implicit; the block is a strand, solved exactly (default)
  pointJacobi,  // implicit; the block is a particle, a fixed number of iterations
  paper,        // Iben et al. 2012, section 5: explicit force and damping loops, springs as printed
};

/// The kernels' limits.
inline constexpr const char* kIntegratorNames[] = {"jacobi", "point_jacobi", "paper"};
constexpr const char* nameOf(Integrator integrator) { return kIntegratorNames[static_cast<int>(integrator)]; }
/// Of one of these names; of another jacobi.
inline Integrator integratorNamed(std::string_view name) {
  const auto* at = std::ranges::find(kIntegratorNames, name);
  return at == std::end(kIntegratorNames) ? Integrator::jacobi
                                          : static_cast<Integrator>(at - std::begin(kIntegratorNames));
}

inline constexpr int kMostStepsPerFrame = 340, kMostRoots = 3;

struct Settings {
  double framesPerSecond = 24;  // [1/s]
  int stepsPerFrame = 8;        // outer steps per frame; the step T is 1 / (framesPerSecond stepsPerFrame)
  Integrator integrator = Integrator::jacobi;
  Vec3d gravity{0, -9.81, 0};  // [m/s^2]
  double gravityPreload = 1;   // share of gravity balanced in the rest pose, 0..1
  double maxStretch =
      1.1;  // stretch limit: an edge's largest length as a multiple of the groom's; 1 is inextensible
  int rootCount = 1;            // particles at the root that follow the head, 1..3
  double teleportDistance = 1;  // [m a frame], 0: never; a head that moves farther in one frame carries the
                                // hair along rigidly
  double sleepSpeed = 0;        // [m/s], 0: never; slower hair sleeps until its head, roots, bodies, air,
                                // forces or settings change
  int pointIterations = 100;    // pointJacobi: iterations per outer step
  bool chebyshev = true;        // pointJacobi: Chebyshev-accelerated rather than plain
  int forceLoops = 15;          // paper: force loops per outer step
  int dampingLoops = 10;        // paper: damping loops per force loop
  ContactSettings contacts;     // between strands; jacobi only
  AirSettings air;              // jacobi only
  GoalSettings goal;            // jacobi only

  bool operator==(const Settings&) const = default;
  /// Whether a head that moves by this distance [m] in one frame jumps.
  bool jumps(double distance) const { return teleportDistance > 0 && distance > teleportDistance; }
  double stepSeconds() const { return 1 / (framesPerSecond * stepsPerFrame); }
};

}  // namespace ringlet
