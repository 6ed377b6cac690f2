// The contacts of a step: every pair's life goes on by one step, from positions at its start and from v^0, and its weights
// are set for the solve's iterations; the first of them is prepared here. Both sides of a pair reckon alike, so momentum is
// kept. Mirrored by reference/kernels/contact_step.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_buffers.glsl"
#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"

void main() {
  if (control.isHalted != 0) return;
  uint c = gl_GlobalInvocationID.x;
  if (c >= parameters.contactCount) return;
  ContactRest rest = contactOf(c);
  vec3 x = positionOf(rest.particle);
  vec3 v = velocityOf(rest.particle);
  float T = parameters.seconds;
  vec3 changes = vec3(parameters.ramp, parameters.stiffnessRelease, parameters.dampingRelease);
  uint list = listOf(c, control.parity);
  uint count = lists[list];
  uint entry = 0;
  Symmetric D = symmetricDiagonal(0.0);
  vec3 push = vec3(0);
  vec3 momentum = vec3(0);
  for (uint j = 0; j < count; ++j) {
    entry = nextEntry(list, j, entry);
    uint ownLife = lifeOf(control.parity, entry);
    ContactPair pair = pairAt(entry);
    vec3 otherVelocity = velocityOf(pair.particle);
    ContactMeeting meeting =
        contactMeeting(x - positionOf(pair.particle), v - otherVelocity, rest.particle < pair.particle);
    bool touching = isTouching(meeting, pair.restLength, T, parameters.seenAhead);
    float old = lifeAt(ownLife).shares;
    if (!touching && old == 0.0) {  // most pairs are only near each other
      normals[entry] = vec4(0);
      continue;
    }
    vec2 shares =
        nextLife(sharesOf(old), touching, meeting.distance, pair.restLength, changes, parameters.breakFactor);
    ContactWeights weights = contactWeights(shares, touching, meeting.distance, pair.restLength, pair.stiffness,
                                            pair.damping, parameters.friction, T);
    vec4 Q = contactMatrix(weights, meeting.normal);
    lives[ownLife].shares = lifeOfShares(shares);
    normals[entry] = Q;
    D = addOuter(addDiagonal(D, tangentialOf(Q)), 1.0, Q.xyz);
    push += weights.push * meeting.normal;
    momentum += contactMultiply(Q, v + otherVelocity);
  }
  float unit = rest.inverseMassUnit;
  systems[rest.particle] = ContactSystem(vec4(unit * D.d, 0), vec4(unit * D.o, 0), vec4(unit * push, 0),
                                         vec4(unit * (push + momentum), 0));
}
