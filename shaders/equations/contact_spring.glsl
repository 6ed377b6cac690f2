// The spring between two contact particles of different strands, and how it is faded in and out. The idea is
// that of Iben et al. 2012, section 4; the formulas are our own. Mirrored by
// reference/equations/contact_spring.h, which explains them with drawings.
//
//   d = |x_a - x_b|, n = (x_a - x_b) / d, u_n = n . (v_a - v_b)
//   touching: d < r0, or seen ahead: d + T u_n < r0
//   momentum on a: push n - Q (v_a - v_b),  push = T k kappa (r0 - d),  Q = (q_s + q_d) n nᵀ + q_t (1 - n nᵀ)
//
// Functions that depend on settings take all of them, so that only this file reads the settings.
#ifndef RINGLET_CONTACT_SPRING
#define RINGLET_CONTACT_SPRING

#include "layout/contacts.h"

/// r0: R, or slightly less than the distance at rest, so that rounding does not decide what touches at rest.
float contactRestLength(float R, float restDistance) { return max(0.0, min(R, restDistance - 1e-4 * R)); }

/// c = 2 zeta sqrt(k m_c) [N s/m], with m_c by k [N/m].
float contactDamping(float k, float R, ContactNumbers settings) {
  return 2.0 * settings.dampingRatio * k * sqrt(R / max(settings.stiffness, 1e-30));
}

/// (k [N/m], c [N s/m]) of two particles whose mean mass is m_c [kg].
vec2 contactConstants(float mass, float R, ContactNumbers settings) {
  float k = settings.stiffness * mass / R;
  return vec2(k, contactDamping(k, R, settings));
}

struct ContactMeeting {
  vec3 normal;       // n, from b to a
  float distance;    // d [m]
  float separation;  // u_n, positive if they part [m/s]
};

/// apart: x_a - x_b [m]; parting: v_a - v_b [m/s]. For two particles at one place the normal is +y for the
/// one with the lower index.
ContactMeeting contactMeeting(vec3 apart, vec3 parting, bool aIsLower) {
  ContactMeeting meeting;
  meeting.distance = length(apart);
  meeting.normal = meeting.distance < 1e-12 ? vec3(0, aIsLower ? 1.0 : -1.0, 0) : apart / meeting.distance;
  meeting.separation = dot(meeting.normal, parting);
  return meeting;
}

bool isTouching(ContactMeeting meeting, float restLength, ContactNumbers settings) {
  return meeting.distance < restLength || (meeting.distance < settings.seenAhead * restLength &&
                                           meeting.distance + settings.seconds * meeting.separation < restLength);
}

/// The distance taper: a contact without state. delta at distance d; r0 must be above 0.
float dampingAt(float d, float restLength, ContactNumbers settings) {
  float end = settings.breakFactor;
  return clamp((end * restLength - d) / ((end - 1.0) * restLength), 0.0, 1.0);
}

/// The time taper: converts a stored life (layout/contacts.h) to (kappa, delta) and back.
vec2 sharesOf(float life) { return life < 0.0 ? vec2(-life, 1.0) : vec2(0.0, life); }
float lifeOfShares(vec2 shares) { return shares.x > 0.0 ? -shares.x : shares.y; }

/// A share below 1e-5 becomes 0, so that rounding does not keep a contact alive.
float faded(float share) { return share < 1e-5 ? 0.0 : share; }

/// The shares (kappa, delta) one step later.
vec2 nextLife(vec2 shares, bool touching, float distance, float restLength, ContactNumbers settings) {
  if (touching) return vec2(min(1.0, shares.x + settings.ramp), 1.0);
  if (distance > settings.breakFactor * restLength) return vec2(0);
  if (shares.x > 0.0) return vec2(faded(shares.x - settings.stiffnessRelease), shares.y);
  return vec2(0.0, faded(shares.y - settings.dampingRelease));
}

struct ContactWeights {
  float spring, damping, tangential;  // q_s, q_d, q_t [kg]
};

ContactWeights contactWeights(float spring, float damping, ContactNumbers settings) {
  return ContactWeights(spring, damping, settings.friction * damping);
}

/// `lived`: the contact existed before this step, in which it had `shares`.
ContactWeights contactWeights(vec2 shares, bool lived, bool touching, float gap, float stiffness, float damping,
    ContactNumbers settings) {
  float T = settings.seconds;
  return contactWeights(touching ? T * T * stiffness * shares.x : 0.0,
      lived || gap > 0.0 ? T * damping * shares.y : 0.0, settings);
}

/// gap: r0 - d [m]. Returns the momentum along n [kg m/s].
float contactPush(float spring, float gap, float T) { return spring * gap / T; }

/// Whether the spring still pushes at the end of a step in which the particles part at `separation` [m/s].
bool isMet(float gap, float separation, float T) { return !(gap < T * separation); }

/// Q v.
vec3 contactMultiply(ContactWeights weights, vec3 normal, vec3 v) {
  float tangential = weights.tangential;
  return (weights.spring + weights.damping - tangential) * dot(normal, v) * normal + tangential * v;
}

#endif
