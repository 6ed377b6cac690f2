// The strand kernels: structs, binding numbers, push constants, limits. "Device order" is the order strands and
// particles have in the buffers; RestState decides it once.
#ifndef RINGLET_LAYOUT_STRANDS
#define RINGLET_LAYOUT_STRANDS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Specialization constants of the strand kernels; shared/strand_buffers.glsl says what each means.
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
RINGLET_CONSTANT uint kSpecCloth = 21;

// Bindings of the strand_step kernels, all in set 0.
RINGLET_CONSTANT uint kBindPositions = 0;   // vec4[particles]: position relative to the head [m], 0
RINGLET_CONSTANT uint kBindVelocities = 1;  // vec4[particles]: velocity relative to the head's translation [m/s], 0
RINGLET_CONSTANT uint kBindParticles = 2;   // ParticleRest[particles]; of a material with profiles followed
                                            // by as many EdgeFactors (rest/edge_factors.h)
RINGLET_CONSTANT uint kBindStrands = 3;     // StrandRest[strands]
RINGLET_CONSTANT uint kBindReports = 4;     // StrandReport[strands]
RINGLET_CONSTANT uint kBindTaps = 5;        // vec4[field][particles]
RINGLET_CONSTANT uint kBindPoses = 6;       // uniform: StepPose[kMaxStepPoses]
// Bindings of kernels that solve with contacts:
RINGLET_CONSTANT uint kBindSolved = 7;          // vec4[particles]: the solve's last iterate v^k [m/s], 0
RINGLET_CONSTANT uint kBindContactSystems = 8;  // ContactSystem[particles]
RINGLET_CONSTANT uint kBindContactControl = 9;  // ContactControl
// The same buffers as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindPositionTexels = 10;
RINGLET_CONSTANT uint kBindVelocityTexels = 11;
RINGLET_CONSTANT uint kBindParticleTexels = 12;  // 2 a particle
RINGLET_CONSTANT uint kBindStrandTexels = 13;    // 7 a strand
RINGLET_CONSTANT uint kBindContactSystemTexels = 14;  // 3 a particle
// Root poses, if strands have some:
RINGLET_CONSTANT uint kBindRootPoses = 25;       // RootPose[steps + 1][strands]
RINGLET_CONSTANT uint kBindRootPoseTexels = 26;  // 4 a pose
// The terms that a volume adds to a particle's velocity system, in the strand's mass units:
RINGLET_CONSTANT uint kBindAddedByVolume = 27;   // vec4[particles]: xyz: to the right-hand side [mass unit m/s]; w: to
                                                 // the mass, g [mass unit]
RINGLET_CONSTANT uint kBindAddedByVolumeTexels = 28;
// External forces:
RINGLET_CONSTANT uint kBindOutsideForces = 29;   // vec4[particles]: xyz: acceleration of the particle
                                                 // [m/s^2], 0
RINGLET_CONSTANT uint kBindOutsideForceTexels = 30;
// Goals, in the groom's axes, carried as roots are:
RINGLET_CONSTANT uint kBindGoalsBefore = 31;     // vec4[particles]: xyz: place at the frame's start [m]; w:
                                                 // damping c [1/s]
RINGLET_CONSTANT uint kBindGoals = 32;           // vec4[particles]: xyz: place at the frame's end [m]; w:
                                                 // stiffness k [1/s^2]
RINGLET_CONSTANT uint kBindGoalBeforeTexels = 33;
RINGLET_CONSTANT uint kBindGoalTexels = 34;
// The poses of many heads, in place of those of one:
RINGLET_CONSTANT uint kBindHeadPoseTexels = 40;  // StepPose[heads][headPoses]: 3 a pose

// Numbers that do not change within a frame:
RINGLET_CONSTANT uint kBindNumbers = 41;  // uniform: HairNumbers

// Integrators (kSpecIntegrator).
RINGLET_CONSTANT uint kIntegratorJacobi = 0;
RINGLET_CONSTANT uint kIntegratorPointJacobi = 1;
RINGLET_CONSTANT uint kIntegratorPaper = 2;

// Within 16 KiB, the smallest uniform buffer Vulkan guarantees: 340 outer steps in a frame and the pose it starts from.
RINGLET_CONSTANT uint kMaxStepPoses = 341;
RINGLET_CONSTANT uint kMaxRootCount = 3;

// With contacts a step is several dispatches: the solve without contacts, then iterations with contacts; the
// last one moves the strand. The phases of a dispatch describe its solve of step stepBegin:
RINGLET_CONSTANT uint kPhaseMove = 1;      // the last one: the strand moves, and the next step's first solve
                                           // follows
RINGLET_CONSTANT uint kPhaseContacts = 2;  // an iteration with contacts

// Fields that kernels compiled with RINGLET_TAPS write, each vec4[particles]; the value of edge i is that of
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
  float bendFactor;      // of the bend stiffness profile, root to tip; 1 without one
};

// A particle that the head carries.
struct RootRest {
  vec3 pin;     // its rest position [m]
  float shift;  // root shift of the strand relative to the head, along axis k in root k [m]
};

// Constant for each strand. Stiffnesses K and dampings C [N and N s per mass unit]: those of an edge are
// these divided by its length. For `paper` they are k and c of every edge.
struct StrandRest {
  uint firstParticle;
  uint particleCount;
  float bendBeta;  // smoothing weight 1 - exp(-l / alpha_b)
  float coreBeta;  // smoothing weight with alpha_c
  float stretchStiffness;
  float stretchDamping;
  float bendStiffness;
  float bendDamping;
  float coreStiffness;
  float coreDamping;
  float restCoreLength;  // sum of |b_i| at rest [m]
  float jacobiGap;       // 1 - mu^2, where mu is a bound on the spectral radius of the point Jacobi
                         // iteration; stored as this difference to keep its digits
  vec3 firstEdge;        // e_0 at rest [m]
  float massUnit;        // [kg]
  RootRest roots[kMaxRootCount];  // its first particles
};

// Numerical state of a strand; maxStretch, limitedEdges, degenerateEdges and velocityResidual cover all steps
// since the simulation began.
struct StrandReport {
  float maxStretch;         // largest ratio of an edge's length to its length in the groom
  uint limitedEdges;        // edges x steps that the stretch limit changed
  uint degenerateEdges;     // edges x steps that had no direction
  uint nonfiniteParticles;  // now
  uint firstNonfinite;      // the first of them, counted along the strand
  float velocityResidual;   // of the solve L v = r, if it is measured; see velocityResidualShare
};

// The head, per outer step. poses[0] is the frame's start, poses[1 + k] the end of step k.
struct StepPose {
  vec4 rotation;        // quaternion (x, y, z, w)
  vec4 turn;            // quaternion from the pose one step before to this one; computed as the difference of
                        // two rotations it would lose digits
  vec3 velocityChange;  // velocity of the head in this step minus that in the step before [m/s]
  float shiftedShare;   // share of their shift by which shifted roots are displaced
};

// The transform that carries a strand's roots: the head's pose combined with the strand's own pose in the
// head's frame. It gives the place of the groom's origin, relative to the head's origin, along world axes.
// Pose 0 is the frame's start, 1 + k the end of step k.
struct RootPose {
  vec4 position;  // xyz [m]
  vec4 rotation;  // quaternion (x, y, z, w)
  vec4 turn;      // rotation from the pose before to this one
  vec4 velocity;  // xyz: of the groom's origin in the step that ends here, relative to the head's translation [m/s]
};

// Push constants of a dispatch.
struct StepParameters {
  uint strandBegin;  // this dispatch's strands, device order
  uint strandEnd;
  uint stepBegin;  // this dispatch's steps within the frame
  uint stepEnd;
  uint phases;         // with contacts: kPhaseMove, kPhaseContacts
  uint particleCount;  // of the chunk: stride of the taps
  uint strandCount;    // of the chunk: stride of the root poses
  uint headCount;      // number of heads that the dispatch steps, if buffers hold many
  uint headParticles;  // distance from one head to the next, in particles, strands and poses
  uint headStrands;
  uint headPoses;
};

// Settings, material and counts of a frame.
struct HairNumbers {
  vec3 gravity;         // [m/s^2], times Material::gravityFactor
  float inertiaFactor;  // Material::inertiaFactor
  vec3 fallGravity;     // gravity of fallen hair [m/s^2]
  float seconds;        // the outer step T
  float maxStretch;
  float coreRelaxedShare;
  float coreElongationLow;
  float coreElongationHigh;
  float dragStrength;  // g / U^2, U the fall speed [1/m]
  float dragAlong;     // drag of motion along a strand, relative to that across it
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
