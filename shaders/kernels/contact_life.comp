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
  ContactRest rest = contacts[c];
  vec3 x = positions[rest.particle].xyz;
  vec3 v = solved[rest.particle].xyz;
  float T = parameters.seconds;
  vec3 changes = vec3(parameters.ramp, parameters.stiffnessRelease, parameters.dampingRelease);
  uint row = rowOf(c);
  uint count = listCounts[row];
  Symmetric D = symmetricDiagonal(0.0);
  vec3 push = vec3(0);
  vec3 momentum = vec3(0);
  for (uint j = 0; j < count; ++j) {
    ContactPair pair = pairs[pairOf(row, j)];
    vec3 otherVelocity = solved[pair.particle].xyz;
    ContactMeeting meeting =
        contactMeeting(x - positions[pair.particle].xyz, v - otherVelocity, rest.particle < pair.particle);
    bool touching = isTouching(meeting, pair.restLength, T, parameters.seenAhead);
    ContactLife old = lives[pairOf(row, j)];
    vec2 life = nextLife(vec2(old.stiffnessShare, old.dampingShare), touching, meeting.distance, pair.restLength, changes,
                         parameters.breakFactor);
    ContactWeights weights = contactWeights(life, touching, meeting.distance, pair.restLength, pair.stiffness,
                                            pair.damping, parameters.friction, T);
    lives[pairOf(row, j)] = ContactLife(life.x, life.y, weights.tangential, 0.0);
    normals[c * parameters.stride + j] = vec4(meeting.normal, weights.normal);
    D = addOuter(addDiagonal(D, weights.tangential), weights.normal - weights.tangential, meeting.normal);
    push += weights.push * meeting.normal;
    momentum += contactMultiply(weights.normal, weights.tangential, meeting.normal, v + otherVelocity);
  }
  float unit = rest.inverseMassUnit;
  systems[rest.particle] = ContactSystem(vec4(unit * D.d, 0), vec4(unit * D.o, 0), vec4(unit * push, 0),
                                         vec4(unit * (push + momentum), 0));
}
