// The buffers and parameters of the strand_step kernels (layout/strands.h), and the taps, which only kernels
// compiled with RINGLET_TAPS write. Kernels compiled with RINGLET_CONTACTS have contacts, those with
// RINGLET_SURROUNDINGS also bodies, air, goals and fields. These are macros, since a buffer that a false
// specialization constant disables stays bound, and small devices have few bindings. In kernels compiled with
// RINGLET_HEADS the buffers of poses and of everything that moves hold many heads, one after another, and a
// dispatch steps some of them; they have no root poses and no external forces.
#ifndef RINGLET_STRAND_BUFFERS
#define RINGLET_STRAND_BUFFERS

#ifdef RINGLET_SURROUNDINGS
#define RINGLET_CONTACTS
#endif
#include "maths/quaternion.glsl"
#include "maths/symmetric.glsl"
#include "layout/contacts.h"
#include "layout/strands.h"
#include "shared/texels.glsl"
#include "shared/workgroup.glsl"

layout(constant_id = kSpecIntegrator) const uint kIntegrator = kIntegratorJacobi;
layout(constant_id = kSpecOneSmoothing) const bool kOneSmoothing = false;  // alpha_b = alpha_c: one smoothing
                                                                           // is enough
layout(constant_id = kSpecResidual) const bool kMeasureResidual = false;
layout(constant_id = kSpecProfiles) const bool kProfiles = false;  // edges have factors (EdgeFactors)
layout(constant_id = kSpecBendVaries) const bool kBendVaries = false;  // or bendFactors differ from 1
#ifdef RINGLET_CONTACTS
layout(constant_id = kSpecContacts) const bool kContacts = false;    // the solve is iterated, with contacts
layout(constant_id = kSpecPairs) const bool kPairs = true;       // there are contacts of pairs
layout(constant_id = kSpecVolume) const bool kVolume = false;     // some hair is a volume
#else
const bool kContacts = false;
const bool kPairs = false;
const bool kVolume = false;
#endif
#ifdef RINGLET_SURROUNDINGS
layout(constant_id = kSpecBodies) const bool kBodies = false;      // there are bodies
layout(constant_id = kSpecAir) const bool kAir = false;         // drag of the air acts
layout(constant_id = kSpecTurbulent) const bool kTurbulent = false;  // the air is turbulent
layout(constant_id = kSpecGoals) const bool kGoals = false;       // particles are pulled to places
layout(constant_id = kSpecFields) const bool kFields = false;     // force fields act on particles
layout(constant_id = kSpecGoalShape) const bool kGoalShape = false;  // goals pull edges and not particles
#else
const bool kBodies = false;
const bool kAir = false;
const bool kGoals = false;
const bool kFields = false;
const bool kGoalShape = false;
#endif
const bool kPulls = kGoals || kFields;
#ifdef RINGLET_HEADS
const bool kMovingRoots = false;
const bool kForces = false;
#else
layout(constant_id = kSpecMovingRoots) const bool kMovingRoots = false;  // strands have root poses
layout(constant_id = kSpecForces) const bool kForces = false;            // external forces act on particles
#endif
layout(constant_id = kSpecFalls) const bool kFalls = false;  // the strands are fallen hair, which no root
                                                             // carries

layout(set = 0, binding = kBindPositions) buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindVelocities) buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = kBindParticles) readonly buffer Particles { ParticleRest particles[]; };
layout(set = 0, binding = kBindStrands) readonly buffer Strands { StrandRest strands[]; };
layout(set = 0, binding = kBindReports) buffer Reports { StrandReport reports[]; };
layout(set = 0, binding = kBindTaps) buffer Taps { vec4 taps[]; };
layout(set = 0, binding = kBindOutsideForces) readonly buffer Forces { vec4 forces[]; };
layout(set = 0, binding = kBindPositionTexels) uniform usamplerBuffer positionTexels;
layout(set = 0, binding = kBindVelocityTexels) uniform usamplerBuffer velocityTexels;
layout(set = 0, binding = kBindParticleTexels) uniform usamplerBuffer particleTexels;
layout(set = 0, binding = kBindStrandTexels) uniform usamplerBuffer strandTexels;
layout(set = 0, binding = kBindOutsideForceTexels) uniform usamplerBuffer forceTexels;
layout(push_constant) uniform Parameters { StepParameters parameters; };
layout(set = 0, binding = kBindNumbers) uniform Numbers { HairNumbers numbersOfFrame; };
HairNumbers numbers;  // main reads them once, since CPU drivers check the bounds of every read

// The first particle of fallen hair is not carried by the head.
vec3 gravity() { return kFalls ? numbers.fallGravity : numbers.gravity; }
float inertiaFactor() { return kFalls ? 1.0 : numbers.inertiaFactor; }
uint rootCount() { return kFalls ? 1u : numbers.rootCount; }

#ifdef RINGLET_HEADS
layout(set = 0, binding = kBindHeadPoseTexels) uniform usamplerBuffer headPoseTexels;
uint head = 0;  // index of this invocation's head
// The head of the n-th strand of the dispatch is stored in `head`; returns the strand's index among those of
// one head. Indices beyond the last head's strands stay beyond the end.
uint placeInHead(uint n) {
  uint strands = parameters.strandEnd - parameters.strandBegin;
  head = min(n / strands, parameters.headCount - 1);
  return n - head * strands;
}
// Index of particle i of this head in buffers of everything that moves, and of the report of its strand s.
uint stateAt(uint i) { return head * parameters.headParticles + i; }
uint reportAt(uint s) { return head * parameters.headStrands + s; }
uint poseAt(uint pose) { return head * parameters.headPoses + pose; }
// Texels are used on every device: SwiftShader's compiler examines every path through a loop, and a branch in
// each read of a pose would make it take practically forever.
vec4 posePart(uint pose, uint part) { return vectorAt(headPoseTexels, 3 * poseAt(pose) + part); }
StepPose stepPose(uint pose) {
  vec4 last = posePart(pose, 2);
  return StepPose(posePart(pose, 0), posePart(pose, 1), last.xyz, last.w);
}
#else
layout(set = 0, binding = kBindPoses) uniform Poses { StepPose poses[kMaxStepPoses]; };
uint placeInHead(uint n) { return n; }
uint stateAt(uint i) { return i; }
uint reportAt(uint s) { return s; }
StepPose stepPose(uint pose) { return poses[pose]; }
#endif

// Position and velocity when the dispatch began.
vec3 positionAtStart(uint i) { return (kTexels ? vectorAt(positionTexels, stateAt(i)) : positions[stateAt(i)]).xyz; }
vec3 velocityAtStart(uint i) { return (kTexels ? vectorAt(velocityTexels, stateAt(i)) : velocities[stateAt(i)]).xyz; }
ParticleRest particleRest(uint i) {
  if (!kTexels) return particles[i];
  vec4 spring = vectorAt(particleTexels, 2 * i);
  vec4 rest = vectorAt(particleTexels, 2 * i + 1);
  return ParticleRest(spring.xyz, spring.w, rest.x, rest.y, rest.z, rest.w);
}
// The factors by which profiles multiply the constants of an edge (rest/edge_factors.h).
struct EdgeFactors {
  vec3 stiffness;  // of stretch, bending and core
  vec3 damping;
};
// The factors of particle i's edge, if there are profiles.
EdgeFactors edgeFactors(uint i) {
  ParticleRest record = particleRest(parameters.particleCount + i);
  return EdgeFactors(record.target, vec3(record.stretchRestLength, record.mass, record.edgeLength));
}
// Acceleration of particle i [m/s^2]: gravity and external forces.
vec3 pullOn(uint i) {
  if (!kForces) return gravity();
  return gravity() + (kTexels ? vectorAt(forceTexels, i) : forces[i]).xyz;
}
StrandRest strandRest(uint s) {
  if (!kTexels) return strands[s];
  uvec4 a = recordAt(strandTexels, 7 * s);
  vec4 b = vectorAt(strandTexels, 7 * s + 1);
  vec4 c = vectorAt(strandTexels, 7 * s + 2);
  vec4 d = vectorAt(strandTexels, 7 * s + 3);
  RootRest roots[kMaxRootCount];
  [[unroll]] for (uint k = 0; k < kMaxRootCount; ++k) {
    vec4 root = vectorAt(strandTexels, 7 * s + 4 + k);
    roots[k] = RootRest(root.xyz, root.w);
  }
  return StrandRest(a.x, a.y, uintBitsToFloat(a.z), uintBitsToFloat(a.w), b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w,
                    d.xyz, d.w, roots);
}

#ifdef RINGLET_CONTACTS
layout(set = 0, binding = kBindSolved) buffer Solved { vec4 solved[]; };
layout(set = 0, binding = kBindContactSystems) readonly buffer ContactSystems { ContactSystem contactSystems[]; };
layout(set = 0, binding = kBindContactControl) readonly buffer Control { ContactControl control; };
layout(set = 0, binding = kBindContactSystemTexels) uniform usamplerBuffer contactSystemTexels;
layout(set = 0, binding = kBindAddedByVolume) readonly buffer AddedByVolume { vec4 addedByVolume[]; };
layout(set = 0, binding = kBindAddedByVolumeTexels) uniform usamplerBuffer addedByVolumeTexels;
vec4 contactSystemPart(uint i, uint part) { return vectorAt(contactSystemTexels, 3 * i + part); }
vec4 volumeAddedTo(uint i) { return kTexels ? vectorAt(addedByVolumeTexels, i) : addedByVolume[i]; }
/// The terms that contacts add to particle i's block of the matrix, and to its right-hand side.
Symmetric contactMass(uint i) {
  Symmetric mass = symmetricDiagonal(kVolume ? volumeAddedTo(i).w : 0.0);
  if (kPairs) {
    mass.d += 2.0 * (kTexels ? contactSystemPart(i, 0) : contactSystems[i].diagonal).xyz;
    mass.o += 2.0 * (kTexels ? contactSystemPart(i, 1) : contactSystems[i].offDiagonal).xyz;
  }
  return mass;
}
vec3 contactMomentum(uint i) {
  vec3 momentum = kVolume ? volumeAddedTo(i).xyz : vec3(0);
  if (kPairs) momentum += (kTexels ? contactSystemPart(i, 2) : contactSystems[i].momentum).xyz;
  return momentum;
}
#endif
#ifdef RINGLET_SURROUNDINGS
layout(set = 0, binding = kBindGoalsBefore) readonly buffer GoalsBefore { vec4 goalsBefore[]; };
layout(set = 0, binding = kBindGoals) readonly buffer Goals { vec4 goals[]; };
layout(set = 0, binding = kBindGoalBeforeTexels) uniform usamplerBuffer goalBeforeTexels;
layout(set = 0, binding = kBindGoalTexels) uniform usamplerBuffer goalTexels;
vec4 goalAtFrameStart(uint i) { return kTexels ? vectorAt(goalBeforeTexels, i) : goalsBefore[i]; }
vec4 goalAtFrameEnd(uint i) { return kTexels ? vectorAt(goalTexels, i) : goals[i]; }
#include "shared/air_buffers.glsl"
#include "shared/body_buffers.glsl"
#include "shared/field_buffers.glsl"
#endif

StrandRest strand;  // the strand of this invocation
uint strandAt;      // its index, device order

float stepSeconds() { return numbers.seconds; }

// Factor by which a strand's constants become those of an edge.
float edgeScaleOf(float edgeLength) { return kIntegrator == kIntegratorPaper ? 1.0 : 1.0 / edgeLength; }

bool isFiniteVec3(vec3 x) { return !(any(isnan(x)) || any(isinf(x))); }

#ifdef RINGLET_TAPS
#define RINGLET_TAP(field, particle, value) \
  taps[(field) * parameters.particleCount + strand.firstParticle + (particle)] = (value)
#else
#define RINGLET_TAP(field, particle, value)
#endif

#endif
