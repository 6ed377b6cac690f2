// What the contacts of a contact particle add to its velocity system in an iteration of the solve, with the distance
// taper: D, push and pair means. Both sides of a contact reckon alike, so momentum is kept. Mirrored by
// reference/kernels/contact_step.h.
#ifndef RINGLET_CONTACT_TERMS
#define RINGLET_CONTACT_TERMS

#include "equations/contact_spring.glsl"
#include "maths/symmetric.glsl"
#include "shared/contact_buffers.glsl"

struct ContactTerms {
  Symmetric D;
  vec3 push;
  vec3 momentum;
};
const ContactTerms kNoTerms = ContactTerms(Symmetric(vec3(0), vec3(0)), vec3(0), vec3(0));

/// v: the sum of both velocities in the last iterate; pushes: the spring acts, and not the damper alone.
void addContact(inout ContactTerms terms, ContactPair pair, ContactMeeting meeting, bool pushes, vec3 v) {
  float T = parameters.seconds;
  float delta = dampingAt(meeting.distance, pair.restLength, parameters.breakFactor);
  ContactWeights weights = ContactWeights(pushes ? T * T * pair.stiffness : 0.0, T * pair.damping * delta);
  float tangential = parameters.friction * weights.damping;
  terms.D = addOuter(addDiagonal(terms.D, tangential), weights.spring + weights.damping - tangential, meeting.normal);
  terms.push += contactPush(weights.spring, pair.restLength - meeting.distance, T) * meeting.normal;
  terms.momentum += contactMultiply(weights, parameters.friction, meeting.normal, v);
}

void setSystem(ContactRest rest, ContactTerms terms) {
  float unit = rest.inverseMassUnit;
  systems[rest.particle].diagonal = vec4(unit * terms.D.d, unit * terms.push.x);
  systems[rest.particle].offDiagonal = vec4(unit * terms.D.o, unit * terms.push.y);
  systems[rest.particle].momentum = vec4(unit * (terms.push + terms.momentum), unit * terms.push.z);
}

#endif
