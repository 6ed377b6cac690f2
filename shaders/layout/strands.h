// The strand kernels: structs, binding numbers, push constants, limits. "Device order" is the order strands and
// particles have in the buffers; RestState decides it once.
#ifndef RINGLET_LAYOUT_STRANDS
#define RINGLET_LAYOUT_STRANDS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Specialization constants of the strand kernels, whose shaders say what each means.
RINGLET_CONSTANT uint kSpecLanes = 2;
RINGLET_CONSTANT uint kSpecRun = 3;
RINGLET_CONSTANT uint kSpecIntegrator = 4;
RINGLET_CONSTANT uint kSpecOneSmoothing = 5;
RINGLET_CONSTANT uint kSpecResidual = 6;
RINGLET_CONSTANT uint kSpecBendVaries = 7;
RINGLET_CONSTANT uint kSpecForces = 8;
RINGLET_CONSTANT uint kSpecMovingRoots = 9;
RINGLET_CONSTANT uint kSpecContacts = 10;
RINGLET_CONSTANT uint kSpecPairs = 11;
RINGLET_CONSTANT uint kSpecVolume = 12;
RINGLET_CONSTANT uint kSpecBodies = 13;
RINGLET_CONSTANT uint kSpecAir = 14;
RINGLET_CONSTANT uint kSpecTurbulent = 15;
RINGLET_CONSTANT uint kSpecGoals = 16;
RINGLET_CONSTANT uint kSpecFields = 17;
RINGLET_CONSTANT uint kSpecGoalShape = 18;
RINGLET_CONSTANT uint kSpecFalls = 19;
RINGLET_CONSTANT uint kSpecProfiles = 20;

// Bindings of the strand_step kernels, all in set 0.
RINGLET_CONSTANT uint kBindPositions = 0;   // vec4[particles]: position relative to the head [m], 0
RINGLET_CONSTANT uint kBindVelocities = 1;  // vec4[particles]: velocity relative to the head's translation [m/s], 0
RINGLET_CONSTANT uint kBindParticles = 2;   // ParticleRest[particles]; of a material with profiles, then as many again,
                                            // which hold EdgeFactors (rest/edge_factors.h)
RINGLET_CONSTANT uint kBindStrands = 3;     // StrandRest[strands]
RINGLET_CONSTANT uint kBindReports = 4;     // StrandReport[strands]
RINGLET_CONSTANT uint kBindTaps = 5;        // vec4[field][particles]
RINGLET_CONSTANT uint kBindPoses = 6;       // uniform: StepPose[kMaxStepPoses]
// And of those that solve with contacts:
RINGLET_CONSTANT uint kBindSolved = 7;          // vec4[particles]: the solve's last iterate v^k [m/s], 0
RINGLET_CONSTANT uint kBindContactSystems = 8;  // ContactSystem[particles]
RINGLET_CONSTANT uint kBindContactControl = 9;  // ContactControl
// The same buffers as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindPositionTexels = 10;
RINGLET_CONSTANT uint kBindVelocityTexels = 11;
RINGLET_CONSTANT uint kBindParticleTexels = 12;  // 2 a particle
RINGLET_CONSTANT uint kBindStrandTexels = 13;    // 7 a strand
RINGLET_CONSTANT uint kBindContactSystemTexels = 14;  // 3 a particle
// Where roots are that move beside the head, each strand's its own way:
RINGLET_CONSTANT uint kBindRootPoses = 25;       // RootPose[steps + 1][strands]
RINGLET_CONSTANT uint kBindRootPoseTexels = 26;  // 4 a pose
// And what hair as a volume adds to a particle's velocity system, in the strand's mass units:
RINGLET_CONSTANT uint kBindAddedByVolume = 27;   // vec4[particles]: xyz: to the right-hand side [mass unit m/s]; w: to
                                                 // the mass, g [mass unit]
RINGLET_CONSTANT uint kBindAddedByVolumeTexels = 28;
// And forces from outside:
RINGLET_CONSTANT uint kBindOutsideForces = 29;   // vec4[particles]: xyz: on each kilogram of the particle [m/s^2], 0
RINGLET_CONSTANT uint kBindOutsideForceTexels = 30;
// And places that particles are pulled to, in the groom's axes, carried as roots are:
RINGLET_CONSTANT uint kBindGoalsBefore = 31;     // vec4[particles]: xyz: at the frame's start [m]; w: damping c [1/s]
RINGLET_CONSTANT uint kBindGoals = 32;           // vec4[particles]: xyz: at its end [m]; w: stiffness k [1/s^2]
RINGLET_CONSTANT uint kBindGoalBeforeTexels = 33;
RINGLET_CONSTANT uint kBindGoalTexels = 34;
// And the poses of many heads, in place of one's:
RINGLET_CONSTANT uint kBindHeadPoseTexels = 40;  // StepPose[heads][headPoses]: 3 a pose

// And what does not change within a frame:
RINGLET_CONSTANT uint kBindNumbers = 41;  // uniform: HairNumbers

// Integrators (kSpecIntegrator).
RINGLET_CONSTANT uint kIntegratorJacobi = 0;
RINGLET_CONSTANT uint kIntegratorPointJacobi = 1;
RINGLET_CONSTANT uint kIntegratorPaper = 2;

// Within 16 KiB, the smallest uniform buffer Vulkan guarantees: 340 outer steps in a frame and the pose it starts from.
RINGLET_CONSTANT uint kMaxStepPoses = 341;
RINGLET_CONSTANT uint kMaxRootCount = 3;

// With contacts a step is several dispatches: the solve without contacts, then iterations with them, the last of which
// moves. What the dispatch's solve of step stepBegin is:
RINGLET_CONSTANT uint kPhaseMove = 1;      // the last: the strand moves, and goes on to the next step's first
RINGLET_CONSTANT uint kPhaseContacts = 2;  // an iteration with the contacts' systems

// Fields the kernels write when compiled with RINGLET_TAPS, each vec4[particles]; an edge's fields stand at its
// particle i.
RINGLET_CONSTANT uint kTapSmoothedEdge = 0;  // d_i, smoothed with alpha_b [m]
RINGLET_CONSTANT uint kTapCoreEdge = 1;      // b_i, smoothed with alpha_c [m]
RINGLET_CONSTANT uint kTapFrame = 2;         // F_i, quaternion (x, y, z, w)
RINGLET_CONSTANT uint kTapTarget = 3;        // t_i [m]
RINGLET_CONSTANT uint kTapStretchForce = 4;  // f_s,i, elastic part [mass unit m/s^2]
RINGLET_CONSTANT uint kTapBendForce = 5;     // f_b,i, elastic part [mass unit m/s^2]
RINGLET_CONSTANT uint kTapCoreForce = 6;     // g_i [mass unit m/s^2]
RINGLET_CONSTANT uint kTapVelocity = 7;      // v_i after the solve, before the stretch limit [m/s]
RINGLET_CONSTANT uint kTapCount = 8;

// Constant per particle i and its edge i (to i + 1). Forces are per mass unit: the strand's line density times its mean
// edge length, so that masses are about 1 and float32 keeps its digits.
struct ParticleRest {
  vec3 target;              // rest vector of the edge in frame F_{i-1} [m]
  float stretchRestLength;  // [m]
  float mass;      // [mass unit]
  float edgeLength;      // the groom's edge [m]: the stretch limit refers to it
  float coreEdgeLength;  // |b_i| at rest [m]
  float bendFactor;      // of the bend stiffness profile, root to tip; 1 where there is none
};

// A root: a particle that the head carries.
struct RootRest {
  vec3 pin;     // its rest position [m]
  float shift;  // of the strand beside the head, along axis k of its root k [m]
};

// Constant per strand. Stiffnesses K and dampings C [N and N s per mass unit]: divided by the edge's length they are
// the edge's own. For `paper`, k and c of every edge, as they are.
struct StrandRest {
  uint firstParticle;
  uint particleCount;
  float bendBeta;  // smoothing weight 1 - exp(-l / alpha_b)
  float coreBeta;  // and with alpha_c
  float stretchStiffness;
  float stretchDamping;
  float bendStiffness;
  float bendDamping;
  float coreStiffness;
  float coreDamping;
  float restCoreLength;  // sum of |b_i| at rest [m]
  float jacobiGap;       // 1 - mu^2, mu a bound on the spectral radius of the point Jacobi iteration: the gap keeps its
                         // digits
  vec3 firstEdge;        // e_0 at rest [m]
  float massUnit;        // [kg]
  RootRest roots[kMaxRootCount];  // its first particles
};

// What the numbers did, per strand; the first three and the last since the simulation began.
struct StrandReport {
  float maxStretch;         // longest edge over the groom's edge
  uint limitedEdges;        // edges x steps the stretch limit touched
  uint degenerateEdges;     // edges x steps that had no direction
  uint nonfiniteParticles;  // now
  uint firstNonfinite;      // the first of them, counted along the strand
  float velocityResidual;   // since the simulation began, where measured, of the solve L v = r: see
                            // velocityResidualShare
};

// The head, per outer step. poses[0] is the frame's start, poses[1 + k] the end of step k.
struct StepPose {
  vec4 rotation;        // quaternion (x, y, z, w)
  vec4 turn;            // quaternion that takes the pose one step before to this; as the difference of two rotations it
                        // would have lost its digits
  vec3 velocityChange;  // how much faster the head travels in this step than in the one before [m/s]
  float shiftedShare;   // of their shift that shifted roots have gone
};

// What carries a strand's roots, the head and the strand's own pose in the head's frame together: where it brings the
// groom's origin, relative to the head's origin, along world axes. Pose 0 is the frame's start, 1 + k the end of step
// k.
struct RootPose {
  vec4 position;  // xyz [m]
  vec4 rotation;  // quaternion (x, y, z, w)
  vec4 turn;      // from the pose before to this
  vec4 velocity;  // xyz: of the groom's origin in the step that ends here, relative to the head's translation [m/s]
};

// Push constants: what a dispatch is of.
struct StepParameters {
  uint strandBegin;  // this dispatch's strands, device order
  uint strandEnd;
  uint stepBegin;  // this dispatch's steps within the frame
  uint stepEnd;
  uint phases;         // with contacts: kPhaseMove, kPhaseContacts
  uint particleCount;  // of the chunk: stride of the taps
  uint strandCount;    // of the chunk: stride of the root poses
  uint headCount;      // of this dispatch, where buffers hold many
  uint headParticles;  // from one head to the next: particles, strands, poses
  uint headStrands;
  uint headPoses;
};

// Settings, material and counts of a frame.
struct HairNumbers {
  vec3 gravity;         // [m/s^2], times the material's factor
  float inertiaFactor;  // of Material
  vec3 fallGravity;     // of what was cut off [m/s^2]
  float seconds;        // the outer step T
  float maxStretch;
  float coreRelaxedShare;
  float coreElongationLow;
  float coreElongationHigh;
  float dragStrength;  // g / U^2, U the fall speed [1/m]
  float dragAlong;     // share of drag that what passes along a strand has
  uint rootCount;
  uint stepCount;
  uint bodyCount;
  uint fieldCount;
  uint pointIterations;
  uint chebyshev;
  uint forceLoops;
  uint dampingLoops;
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
