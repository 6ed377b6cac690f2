// The spring between two contact particles of different strands, and its life. Mirrors
// shaders/equations/contact_spring.glsl. Iben et al. 2012, section 4, describe it; the formulas are ours.
//
//     d = |x_a - x_b|,   n = (x_a - x_b) / d,   u_n = n . (v_a - v_b)        v: of the step without contacts
//     touching:  d < r0, or seen ahead: d < 2 r0 and d + T u_n < r0       before the end of the step
//
// With the distance taper kappa is 1 while touching, and delta is 1 at d <= r0 and falls to 0 at 1.05 r0: no
// memory. With the time taper:
//
//     kappa (stiffness)   0 __/--------\____ 0          engaging: kappa grows, delta is 1 at once
//     delta (damping)     0 |------------\__ 0          breaking: kappa falls to 0, then delta
//                           touching | breaking         gone: beyond the break distance, or delta is 0
//
// The step's impulse on a is push n - Q (v_a - v_b), on b its negative, with
//
//     push = T k kappa (r0 - d)            Q = (q_s + q_d) n n^T + q_t (I - n n^T)
//     q_s = T^2 k kappa,   q_d = T c delta,   q_t = friction q_d
//
// The spring (k) acts only while touching. Seen ahead, d > r0 and push is negative, which lets the pair come
// to r0 unhindered; where the pair then does not come nearer than r0 by the end of the step, the spring would
// hold it, and is taken back (isMet). The damper (c) acts from the first step with d < r0 to the last of the
// life: no damping before there is a contact, and none that depends on which side of r0 rounding puts a pair
// that rests.
#pragma once

#include <algorithm>

#include "reference/fields.h"
#include "ringlet/rest/material.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet::reference {

/// What stays of a pair.
template <class Real>
struct ContactConstants {
  Real restLength = 0;  // r0 [m]
  Real stiffness = 0;   // k [N/m]
  Real damping = 0;     // c [N s/m]
};

// Spheres that overlap at rest touch when they are nearer than that by this share of R, some ten times what a
// float position is rounded by. At exactly the rest distance rounding would decide which of them touch, and
// their damping would carry that into the motion.
inline constexpr double kContactSlack = 1e-4;

/// For two strands' mean contact particle of `mass` m_c [kg], `radiusSum` R [m], and the particles'
/// `restDistance` [m]:
///     r0 = min(R, rest distance - slack), not below 0, so that there is no contact at rest
///     k = stiffness m_c g / R,   c = 2 dampingRatio sqrt(k m_c)
template <class Real>
ContactConstants<Real> contactConstants(const ContactSettings& settings, double mass, double radiusSum,
                                        double restDistance) {
  const double stiffness = settings.stiffness * mass * kStandardGravity / radiusSum;
  const double restLength = std::min(radiusSum, restDistance - kContactSlack * radiusSum);
  return {.restLength = static_cast<Real>(std::max(0.0, restLength)),
          .stiffness = static_cast<Real>(stiffness),
          .damping = static_cast<Real>(2 * settings.dampingRatio * std::sqrt(stiffness * mass))};
}

/// Where two particles are to each other, seen from a.
template <class Real>
struct ContactPlace {
  Vector3<Real> normal;  // n, from b to a [1]
  Real distance = 0;     // d [m]
  Real separation = 0;   // u_n: how fast they part [m/s]
};

/// `apart` = x_a - x_b [m], `parting` = v_a - v_b [m/s]. Particles in one place part along +y for the one of
/// the lower index in the groom, which is a if `aIsLower`.
template <class Real>
ContactPlace<Real> contactPlace(const Vector3<Real>& apart, const Vector3<Real>& parting, bool aIsLower) {
  const Real shortest = Real(1e-12);  // [m]
  ContactPlace<Real> place;
  place.distance = apart.norm();
  place.normal = place.distance < shortest ? Vector3<Real>(0, aIsLower ? 1 : -1, 0)
                                           : Vector3<Real>(apart / place.distance);
  place.separation = place.normal.dot(parting);
  return place;
}

template <class Real>
bool isTouching(const ContactPlace<Real>& place, Real restLength, Real stepSeconds) {
  if (place.distance < restLength) return true;
  return place.distance < static_cast<Real>(kContactSeenAhead) * restLength &&
         place.distance + stepSeconds * place.separation < restLength;
}

/// Shares of spring and damper that act; with the time taper, what a pair remembers from step to step.
template <class Real>
struct ContactLife {
  Real stiffnessShare = 0;  // kappa [1]
  Real dampingShare = 0;    // delta [1]

  bool isOver() const { return !(stiffnessShare > 0 || dampingShare > 0); }
};

/// The distance taper.
template <class Real>
ContactLife<Real> lifeAt(bool touching, Real distance, Real restLength) {
  const Real end = static_cast<Real>(kContactTaperEnd);
  if (!(touching || distance < end * restLength)) return {};
  const Real fading = (end * restLength - distance) / ((end - 1) * restLength);
  return {touching ? Real(1) : Real(0), std::clamp(fading, Real(0), Real(1))};
}

/// The time taper: the life after a step of T [s] that begins at `place`.
template <class Real>
ContactLife<Real> nextLife(const ContactSettings& settings, ContactLife<Real> life, bool touching,
                           Real distance, Real restLength, Real stepSeconds) {
  // Falls to nothing, so that rounding does not keep a contact for a step.
  const auto faded = [](Real share) { return share < Real(1e-5) ? Real(0) : share; };
  const auto changeIn = [&](double seconds) {  // a share's change within the step
    return seconds > 0 ? stepSeconds / static_cast<Real>(seconds) : Real(1);
  };
  if (touching) {
    return {std::min(Real(1), life.stiffnessShare + changeIn(settings.rampSeconds)), Real(1)};
  }
  if (distance > static_cast<Real>(settings.breakFactor) * restLength) return {};
  if (life.stiffnessShare > 0) {
    life.stiffnessShare = faded(life.stiffnessShare - changeIn(settings.stiffnessReleaseSeconds));
  } else {
    life.dampingShare = faded(life.dampingShare - changeIn(settings.dampingReleaseSeconds));
  }
  return life;
}

/// A step's weights [kg] and momentum [kg m/s].
template <class Real>
struct ContactWeights {
  Real spring = 0, damping = 0, tangential = 0;  // q_s, q_d, q_t
  Real push = 0;                                 // along n

  Real normal() const { return spring + damping; }
  /// Whether the spring still pushes at the end of a step in which the two part at `separation` [m/s].
  bool isMet(Real separation) const { return !(push < spring * separation); }
};

/// `lived`: the contact was there before this step, which left it `life`; always true with the distance
/// taper.
template <class Real>
ContactWeights<Real> contactWeights(const ContactSettings& settings, const ContactConstants<Real>& constants,
                                    const ContactLife<Real>& life, bool lived, bool touching, Real distance,
                                    Real stepSeconds) {
  ContactWeights<Real> weights;
  if (lived || distance < constants.restLength) {
    weights.damping = stepSeconds * constants.damping * life.dampingShare;
    weights.tangential = static_cast<Real>(settings.friction) * weights.damping;
  }
  if (touching) {
    const Real spring = stepSeconds * constants.stiffness * life.stiffnessShare;
    weights.spring = stepSeconds * spring;
    weights.push = spring * (constants.restLength - distance);
  }
  return weights;
}

/// Q [kg].
template <class Real>
Matrix3<Real> contactMatrix(const ContactWeights<Real>& weights, const Vector3<Real>& normal) {
  return (weights.normal() - weights.tangential) * normal * normal.transpose() +
         weights.tangential * Matrix3<Real>::Identity();
}

}  // namespace ringlet::reference
