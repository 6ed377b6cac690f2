// Features: what acts on hair from outside, besides its head and the air.
#pragma once

#include <array>
#include <compare>

namespace ringlet {

/// Kernels know the features that a simulation uses: each makes them slower and longer to compile. A feature
/// is added when it is first used, or before by Simulation::prepare or KernelChoice::features.
struct Features {
  bool bodies = false;  // solids (Simulation::setBodies)
  bool roots = false;   // poses of strands' roots (Simulation::stepFrame)
  bool forces = false;  // external forces on particles (Simulation::setForces)
  bool goals = false;   // places that particles are pulled to (Simulation::setGoals)
  bool fields = false;  // fields of force and moving air (Simulation::setFields)

  auto operator<=>(const Features&) const = default;
  bool any() const { return *this != Features{}; }
  /// The features of both.
  friend Features operator|(Features a, const Features& b);
};

/// A feature as users name it.
struct FeatureName {
  const char* name;
  bool Features::*member;
};
inline constexpr std::array kFeatureNames{
    FeatureName{"bodies", &Features::bodies}, FeatureName{"roots", &Features::roots},
    FeatureName{"forces", &Features::forces}, FeatureName{"goals", &Features::goals},
    FeatureName{"fields", &Features::fields}};

inline Features operator|(Features a, const Features& b) {
  for (const FeatureName& feature : kFeatureNames) a.*feature.member = a.*feature.member || b.*feature.member;
  return a;
}

}  // namespace ringlet
