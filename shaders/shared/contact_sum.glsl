// What the contacts of a contact particle add to its velocity system in an iteration of the solve, with the distance
// taper: D, push and pair means. Both sides of a contact reckon alike, so momentum is kept.
#ifndef RINGLET_CONTACT_SUM
#define RINGLET_CONTACT_SUM

#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"
#include "shared/contact_buffers.glsl"

struct ContactSum {
  Symmetric D;
  vec3 push;
  vec3 momentum;
};
const ContactSum kNoContacts = ContactSum(Symmetric(vec3(0), vec3(0)), vec3(0), vec3(0));

/// v: the sum of both velocities in the last iterate; pushes: the spring acts, and not the damper alone.
void addContact(inout ContactSum sum, ContactPair pair, ContactMeeting meeting, bool pushes, vec3 v) {
  float T = parameters.seconds;
  float delta = dampingAt(meeting.distance, pair.restLength, parameters.breakFactor);
  ContactWeights weights = ContactWeights(pushes ? T * T * pair.stiffness : 0.0, T * pair.damping * delta);
  float tangential = parameters.friction * weights.damping;
  sum.D = addOuter(addDiagonal(sum.D, tangential), weights.spring + weights.damping - tangential, meeting.normal);
  sum.push += contactPush(weights.spring, pair.restLength - meeting.distance, T) * meeting.normal;
  sum.momentum += contactMultiply(weights, parameters.friction, meeting.normal, v);
}

void setSystem(ContactRest rest, ContactSum sum) {
  float unit = rest.inverseMassUnit;
  systems[rest.particle].diagonal = vec4(unit * sum.D.d, unit * sum.push.x);
  systems[rest.particle].offDiagonal = vec4(unit * sum.D.o, unit * sum.push.y);
  systems[rest.particle].momentum = vec4(unit * (sum.push + sum.momentum), unit * sum.push.z);
}

#endif
