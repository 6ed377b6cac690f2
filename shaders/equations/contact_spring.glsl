// The spring between two contact particles of different strands, and its life. Iben et al. 2012, section 4, describe it; the
// formulas are ours. Mirrored by reference/equations/contact_spring.h, where they are drawn and explained.
//
//   d = |x_a - x_b|, n = (x_a - x_b) / d, u_n = n . (v_a - v_b)
//   touching: d < r0, or seen ahead: d + T u_n < r0
//   momentum on a: push n - Q (v_a - v_b),  push = T k kappa (r0 - d),  Q = q_n n nᵀ + q_t (1 - n nᵀ)
#ifndef RINGLET_CONTACT_SPRING
#define RINGLET_CONTACT_SPRING

/// r0: R, or a little less than the distance at rest, so that rounding does not decide what touches there.
float contactRestLength(float R, float restDistance) { return max(0.0, min(R, restDistance - 1e-4 * R)); }

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

/// (kappa, delta) of a life and back (layout.h).
vec2 sharesOf(float life) { return life < 0.0 ? vec2(-life, 1.0) : vec2(0.0, life); }
float lifeOfShares(vec2 shares) { return shares.x > 0.0 ? -shares.x : shares.y; }

/// A share that falls to nothing, so that rounding does not keep a contact for a step.
float faded(float share) { return share < 1e-5 ? 0.0 : share; }

/// shares: (kappa, delta); changes: what they may change by in a step, (ramp, release of stiffness, release of damping).
vec2 nextLife(vec2 shares, bool touching, float distance, float restLength, vec3 changes, float breakFactor) {
  if (touching) return vec2(min(1.0, shares.x + changes.x), 1.0);
  if (distance > breakFactor * restLength) return vec2(0);
  if (shares.x > 0.0) return vec2(faded(shares.x - changes.y), shares.y);
  return vec2(0.0, faded(shares.y - changes.z));
}

struct ContactWeights {
  float normal, tangential;  // q_n, q_t [kg]
  float push;                // along n [kg m/s]
};

ContactWeights contactWeights(vec2 shares, bool touching, float distance, float restLength, float stiffness, float damping,
                              float friction, float T) {
  ContactWeights weights = ContactWeights(0.0, 0.0, 0.0);
  if (distance < restLength || !touching) {  // no damping before there is a contact
    weights.normal = T * damping * shares.y;
    weights.tangential = friction * weights.normal;
  }
  if (touching) {
    float spring = T * stiffness * shares.x;
    weights.normal += T * spring;
    weights.push = spring * (restLength - distance);
  }
  return weights;
}

/// Q as (n sqrt(q_n - q_t), q_t); friction is at most 1, so q_t is never larger. A contact seen ahead has no damping, so no
/// q_t, and a push below 0, which stands there.
vec4 contactMatrix(ContactWeights weights, vec3 normal) {
  return vec4(sqrt(max(0.0, weights.normal - weights.tangential)) * normal, weights.push < 0.0 ? weights.push : weights.tangential);
}
float tangentialOf(vec4 Q) { return max(0.0, Q.w); }
vec3 contactMultiply(vec4 Q, vec3 v) { return dot(Q.xyz, v) * Q.xyz + tangentialOf(Q) * v; }

/// Whether a contact seen ahead has not come about: parting as the two now are, it would hold them together.
bool isUnmet(vec4 Q, vec3 parting) { return Q.w < 0.0 && Q.w < length(Q.xyz) * dot(Q.xyz, parting); }

#endif
