// The terms that the contacts of a contact particle add to its velocity system in an iteration of the solve: D, push
// and pair means. Both particles of a contact compute the same numbers, so momentum is conserved. Mirrored by
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

/// Adds a contact of these weights. gap: r0 - d [m]; v: the sum of both velocities in the last iterate.
void addWeights(inout ContactTerms terms, ContactWeights weights, vec3 normal, float gap, vec3 v) {
  float tangential = weights.tangential;
  terms.D = addOuter(addDiagonal(terms.D, tangential), weights.spring + weights.damping - tangential, normal);
  terms.push += contactPush(weights.spring, gap, numbers.seconds) * normal;
  terms.momentum += contactMultiply(weights, normal, v);
}

/// Adds a contact with the distance taper. pushes: the spring acts as well as the damper.
void addContact(inout ContactTerms terms, ContactPair pair, ContactMeeting meeting, bool pushes, vec3 v) {
  float T = numbers.seconds;
  float delta = dampingAt(meeting.distance, pair.restLength, numbers);
  ContactWeights weights =
      contactWeights(pushes ? T * T * pair.stiffness : 0.0, T * pair.damping * delta, numbers);
  addWeights(terms, weights, meeting.normal, pair.restLength - meeting.distance, v);
}

void setSystem(ContactRest rest, ContactTerms terms) {
  float unit = rest.inverseMassUnit;
  systems[rest.particle].diagonal = vec4(unit * terms.D.d, unit * terms.push.x);
  systems[rest.particle].offDiagonal = vec4(unit * terms.D.o, unit * terms.push.y);
  systems[rest.particle].momentum = vec4(unit * (terms.push + terms.momentum), unit * terms.push.z);
}

#endif
