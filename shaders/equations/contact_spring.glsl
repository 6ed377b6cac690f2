// The spring between two contact particles of different strands, and how it comes and goes. Iben et al. 2012, section
// 4, describe it; the formulas are ours. Mirrored by reference/equations/contact_spring.h, where they are drawn and
// explained.
//
//   d = |x_a - x_b|, n = (x_a - x_b) / d, u_n = n . (v_a - v_b)
//   touching: d < r0, or seen ahead: d + T u_n < r0
//   momentum on a: push n - Q (v_a - v_b),  push = T k kappa (r0 - d),  Q = (q_s + q_d) n nᵀ + q_t (1 - n nᵀ)
#ifndef RINGLET_CONTACT_SPRING
#define RINGLET_CONTACT_SPRING

/// r0: R, or a little less than the distance at rest, so that rounding does not decide what touches there.
float contactRestLength(float R, float restDistance) { return max(0.0, min(R, restDistance - 1e-4 * R)); }

/// (k [N/m], c [N s/m]) of two whose mean mass is m_c [kg]; stiffness: k R / m_c [m/s^2].
vec2 contactConstants(float mass, float R, float stiffness, float dampingRatio) {
  float k = stiffness * mass / R;
  return vec2(k, 2.0 * dampingRatio * k * sqrt(R / max(stiffness, 1e-30)));
}

struct ContactMeeting {
  vec3 normal;       // n, from b to a
  float distance;    // d [m]
  float separation;  // u_n: how fast they part [m/s]
};

/// apart: x_a - x_b [m]; parting: v_a - v_b [m/s]. Particles in one place part along +y for the one of the lower index.
ContactMeeting contactMeeting(vec3 apart, vec3 parting, bool aIsLower) {
  ContactMeeting meeting;
  meeting.distance = length(apart);
  meeting.normal = meeting.distance < 1e-12 ? vec3(0, aIsLower ? 1.0 : -1.0, 0) : apart / meeting.distance;
  meeting.separation = dot(meeting.normal, parting);
  return meeting;
}

bool isTouching(ContactMeeting meeting, float restLength, float T, float seenAhead) {
  return meeting.distance < restLength || (meeting.distance < seenAhead * restLength &&
                                           meeting.distance + T * meeting.separation < restLength);
}

/// The distance taper: a contact without memory. delta at distance d; r0 is above 0.
float dampingAt(float d, float restLength, float end) {
  return clamp((end * restLength - d) / ((end - 1.0) * restLength), 0.0, 1.0);
}

/// The time taper: (kappa, delta) of a life and back (layout/contacts.h).
vec2 sharesOf(float life) { return life < 0.0 ? vec2(-life, 1.0) : vec2(0.0, life); }
float lifeOfShares(vec2 shares) { return shares.x > 0.0 ? -shares.x : shares.y; }

/// A share that falls to nothing, so that rounding does not keep a contact for a step.
float faded(float share) { return share < 1e-5 ? 0.0 : share; }

/// shares: (kappa, delta); changes: what they may change by in a step, (ramp, release of stiffness, release of
/// damping).
vec2 nextLife(vec2 shares, bool touching, float distance, float restLength, vec3 changes, float breakFactor) {
  if (touching) return vec2(min(1.0, shares.x + changes.x), 1.0);
  if (distance > breakFactor * restLength) return vec2(0);
  if (shares.x > 0.0) return vec2(faded(shares.x - changes.y), shares.y);
  return vec2(0.0, faded(shares.y - changes.z));
}

struct ContactWeights {
  float spring, damping;  // q_s, q_d [kg]; q_t is friction q_d
};

/// lived: the contact was there before this step, which left it `shares`.
ContactWeights contactWeights(vec2 shares, bool lived, bool touching, float gap, float stiffness, float damping,
    float T) {
  return ContactWeights(touching ? T * T * stiffness * shares.x : 0.0,
      lived || gap > 0.0 ? T * damping * shares.y : 0.0);
}

/// gap: r0 - d [m]. push, along n [kg m/s].
float contactPush(float spring, float gap, float T) { return spring * gap / T; }

/// Whether the spring still pushes at the end of a step in which the two part at `separation` [m/s].
bool isMet(float gap, float separation, float T) { return !(gap < T * separation); }

/// Q v.
vec3 contactMultiply(ContactWeights weights, float friction, vec3 normal, vec3 v) {
  float tangential = friction * weights.damping;
  return (weights.spring + weights.damping - tangential) * dot(normal, v) * normal + tangential * v;
}

#endif
