// Everything GLSL and C++ must agree on: structs, binding numbers, push constants, limits. One text, read by both.
// "Device order" is the order strands and particles have in the buffers; RestState decides it once.
#ifndef RINGLET_SHADERS_SHARED_LAYOUT_H
#define RINGLET_SHADERS_SHARED_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
namespace ringlet::layout {
using uint = std::uint32_t;
struct alignas(16) vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
// In GLSL it is aligned to 16 bytes, and a float behind it fills them.
struct alignas(4) vec3 {
  float x = 0, y = 0, z = 0;
};
struct alignas(16) uvec4 {
  uint x = 0, y = 0, z = 0, w = 0;
};
#define RINGLET_CONSTANT inline constexpr
#else
#define RINGLET_CONSTANT const
#endif

// Specialization constants: of every kernel that has one;
RINGLET_CONSTANT uint kSpecGroupSize = 0;  // invocations of a workgroup
RINGLET_CONSTANT uint kSpecTexels = 1;     // records are read as texels (shared/texels.glsl)
// of the strand kernels, whose shaders say what each means;
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
// and of the contact kernels.
RINGLET_CONSTANT uint kSpecBesideVolume = 2;

// Bindings of the strand_step kernels, all in set 0.
RINGLET_CONSTANT uint kBindPositions = 0;   // vec4[particles]: position relative to the head [m], 0
RINGLET_CONSTANT uint kBindVelocities = 1;  // vec4[particles]: velocity relative to the head's translation [m/s], 0
RINGLET_CONSTANT uint kBindParticles = 2;   // ParticleRest[particles]
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
// What hair stays out of, and the air it moves in:
RINGLET_CONSTANT uint kBindBodies = 15;      // BodyRest[bodies]
RINGLET_CONSTANT uint kBindBodyPoses = 16;   // BodyPose[steps + 1][bodies]
RINGLET_CONSTANT uint kBindGridCells = 17;   // uvec4[cells]: the distances of a cell's corners, see gridDistance
RINGLET_CONSTANT uint kBindAir = 18;         // StepAir[steps]
RINGLET_CONSTANT uint kBindWindModes = 19;   // WindWave[kWindWaves]
RINGLET_CONSTANT uint kBindBodyTexels = 20;  // 5 a body
RINGLET_CONSTANT uint kBindBodyPoseTexels = 21;  // 4 a pose
RINGLET_CONSTANT uint kBindGridCellTexels = 22;
RINGLET_CONSTANT uint kBindAirTexels = 23;       // 4 a step
RINGLET_CONSTANT uint kBindWindModeTexels = 24;  // 2 a mode
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

// Integrators (kSpecIntegrator).
RINGLET_CONSTANT uint kIntegratorJacobi = 0;
RINGLET_CONSTANT uint kIntegratorPointJacobi = 1;
RINGLET_CONSTANT uint kIntegratorPaper = 2;

// Within 16 KiB, the smallest uniform buffer Vulkan guarantees: 340 outer steps in a frame and the pose it starts from.
RINGLET_CONSTANT uint kMaxStepPoses = 341;
RINGLET_CONSTANT uint kMaxRootCount = 3;
RINGLET_CONSTANT uint kWindWaves = 12;   // modes of the turbulent wind: a multiple of 4

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
  vec4 pins[kMaxRootCount];  // xyz: rest positions of the first particles, which the head carries [m]; the three w: the
                             // strand's shift beside the head, x, y and z [m]
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

// A body, constant. Boxes, spheres and capsules are boxes with rounded edges.
struct BodyRest {
  vec3 halfExtents;  // of the box within [m]
  float rounding;    // of the box, or what hair keeps away from a plane or grid [m]
  vec4 bounds;       // a sphere about it: xyz: middle, its own axes [m]; w: radius [m]
  vec3 gridOrigin;   // [m]
  float cell;        // of the grid [m]
  uint cells[3];     // of the grid
  uint firstCell;
  float friction;
  uint shape;        // kShapeBox, kShapePlane or kShapeGrid
  uint unused[2];
};
RINGLET_CONSTANT uint kShapeBox = 0;
RINGLET_CONSTANT uint kShapePlane = 1;
RINGLET_CONSTANT uint kShapeGrid = 2;

// Where a body is, relative to the head's origin, along world axes. Pose 0 is the frame's start, 1 + k the end of step
// k.
struct BodyPose {
  vec3 position;  // [m]
  float moves;    // how far any of it does in the step that ends here [m]
  vec4 rotation;  // quaternion (x, y, z, w)
  vec4 turn;      // from the pose before to this
  vec4 velocity;  // xyz: of its origin in that step, relative to the head's translation [m/s]
};

// The air in a step, relative to the head's translation.
struct StepAir {
  vec4 wind;       // xyz: without turbulence [m/s]
  vec4 phases[3];  // of its waves, at the head's origin [rad]
};
// A mode of the turbulent wind.
struct WindWave {
  vec4 wave;       // xyz [rad/m]
  vec4 amplitude;  // xyz [m/s]
};

struct StepParameters {
  vec3 gravity;   // [m/s^2]
  float seconds;  // the outer step T
  float maxStretch;
  float coreRelaxedShare;
  float coreElongationLow;
  float coreElongationHigh;
  uint strandBegin;  // this dispatch's strands, device order
  uint strandEnd;
  uint stepBegin;  // this dispatch's steps within the frame
  uint stepEnd;
  uint rootCount;
  uint pointIterations;
  uint chebyshev;
  uint forceLoops;
  uint dampingLoops;
  uint particleCount;  // of the chunk: stride of the taps
  uint phases;         // with contacts: kPhaseMove, kPhaseContacts
  uint bodyCount;
  float dragStrength;  // g / U^2, U the fall speed [1/m]
  float dragAlong;     // share of drag that what passes along a strand has
  uint strandCount;    // of the chunk: stride of the root poses
};

// Bindings of the contact kernels, all in set 0.
RINGLET_CONSTANT uint kBindContactPositions = 0;   // vec4[particles]: as above
RINGLET_CONSTANT uint kBindContactVelocities = 1;  // vec4[particles]: as above
RINGLET_CONSTANT uint kBindContactSolved = 2;      // vec4[particles]: v^k
RINGLET_CONSTANT uint kBindContacts = 3;           // ContactRest[contacts]
RINGLET_CONSTANT uint kBindNeighbours = 4;         // uvec4: who may touch whom, see kNoStrand
RINGLET_CONSTANT uint kBindIndices = 5;            // uvec4: the contact particle of each particle, four a record
RINGLET_CONSTANT uint kBindGrid = 6;               // uint: see gridStart and its like in shared/contact_buffers.glsl
RINGLET_CONSTANT uint kBindPlaces = 7;             // ContactPlace[contacts], in cell order
RINGLET_CONSTANT uint kBindHistories = 8;          // ContactHistory[contacts]
RINGLET_CONSTANT uint kBindGuesses = 9;            // vec4[particles]: xyz: the first iterate's velocity [m/s]; w:
                                                   // radius [m]
RINGLET_CONSTANT uint kBindLists = 10;              // uint: see listOf and its like in shared/contact_buffers.glsl
RINGLET_CONSTANT uint kBindPairs = 11;             // ContactPair[blocks][kListBlock]
RINGLET_CONSTANT uint kBindLiveLists = 12;         // uint: see liveListOf
RINGLET_CONSTANT uint kBindLives = 13;             // ContactLife[2][liveBlocks][kLiveBlock]
RINGLET_CONSTANT uint kBindForces = 14;            // ContactForce[liveBlocks][kLiveBlock]
RINGLET_CONSTANT uint kBindSystems = 15;           // ContactSystem[particles]
RINGLET_CONSTANT uint kBindControl = 16;           // ContactControl
RINGLET_CONSTANT uint kContactBindingCount = 17;
// And as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindContactPositionTexels = 17;
RINGLET_CONSTANT uint kBindContactVelocityTexels = 18;
RINGLET_CONSTANT uint kBindContactSolvedTexels = 19;
RINGLET_CONSTANT uint kBindContactTexels = 20;  // 2 a contact particle
RINGLET_CONSTANT uint kBindNeighbourTexels = 21;
RINGLET_CONSTANT uint kBindIndexTexels = 22;
RINGLET_CONSTANT uint kBindPlaceTexels = 23;    // 2 a contact particle
RINGLET_CONSTANT uint kBindHistoryTexels = 24;  // 4 a contact particle
RINGLET_CONSTANT uint kBindGuessTexels = 25;
RINGLET_CONSTANT uint kBindPairTexels = 26;
RINGLET_CONSTANT uint kBindLifeTexels = 27;
RINGLET_CONSTANT uint kBindForceTexels = 28;    // 2 a contact
RINGLET_CONSTANT uint kContactTexelBindingCount = 12;

// Lists are as long as they must be, in blocks of this many pairs that are given out as they are asked for. Which block
// went where depends on threads; what is in a list, and its order, does not.
RINGLET_CONSTANT uint kListBlock = 16;          // two bits of an integer for each (contact_touch.comp)
RINGLET_CONSTANT uint kLiveBlock = 4;
RINGLET_CONSTANT uint kBucketBlock = 1024;      // buckets of the grid that are summed together
// Beside a volume, who is in a cell: 0 nobody, a group and one more, or several groups.
RINGLET_CONSTANT uint kSeveralGroups = 0xffffffffu;
RINGLET_CONSTANT uint kNoBucket = 0xffffffffu;  // of a contact particle that is not in the grid
RINGLET_CONSTANT uint kNoStrand = 0xffffffffu;  // a free slot of the table of who may touch whom: that has a record for
                                                // each strand, (first of its buckets, how many less one, its group, 0),
                                                // then the buckets of four strands; see solver/neighbour_table.h

// Constant per contact particle; contact particles stand in device order.
struct ContactRest {
  vec3 point;    // at rest [m]
  float radius;  // [m]
  uint particle;
  uint strand;
  float mass;             // m_c [kg]
  float inverseMassUnit;  // 1 / the strand's mass unit [1/kg]; 0 for a particle that follows the head
};

// A contact particle's neighbour: near enough to touch while the list is good.
struct ContactPair {
  uint particle;     // the other, device order
  float restLength;  // r0 [m]
  float stiffness;   // k [N/m]
  float damping;     // c [N s/m]
};

// What a contact remembers from step to step, in two rows, that of the step and that of the step before. The shares are
// one number, for the damping's is 1 while the stiffness's is not 0: -kappa, or delta where kappa is 0.
struct ContactLife {
  uint particle;     // the other, device order
  float shares;
  float restLength;  // r0 [m]
  float stiffness;   // k [N/m]
};

// What a contact is in a step, for one of its particles; the other has the contact too, with the same numbers.
struct ContactForce {
  vec4 normal;     // xyz: n; w: q_s [kg]
  uint particle;   // the other, device order
  float damping;   // q_d [kg]
  float gap;       // r0 - d [m]
  uint unused;
};

// What contacts add to a particle's velocity system, (L + 2 D) v = base + momentum, in the strand's mass units.
struct ContactSystem {
  vec4 diagonal;     // xyz: of D xx, yy, zz; w: push x
  vec4 offDiagonal;  // xyz: of D yz, xz, xy; w: push y
  vec4 momentum;     // xyz: push and sum of Q (v_a + v_b) [mass unit m/s]; w: push z. The push is the sum of push n
};

// A place of the grid: a contact particle as it was when lists were made. Numbers of both kinds are integers here: a
// driver may flush an integer to 0 that it moves as a float, and none a float that it moves as an integer.
struct ContactPlace {
  uvec4 position;  // xyz: [m], bits of floats; w: its strand's group, see groupOf in shared/contact_buffers.glsl
  uvec4 velocity;  // xyz: v^0 [m/s], bits of floats; w: which contact particle
};

// What a contact particle was: when its list was made, and in the step before.
struct ContactHistory {
  vec4 position;      // when its list was made [m]
  vec4 velocity;      // v^0 then [m/s]
  vec4 predicted[2];  // v^0 of this step and the one before, by parity [m/s]
};

// What contact kernels decide among themselves and tell the host.
struct ContactControl {
  uint indirectContacts[3];  // workgroups over contact particles of a rebuild, or none
  uint isListed;             // there are lists
  uint indirectBuckets[3];   // over blocks of buckets
  uint parity;               // which of the two rows is in use
  uint indirectOne[3];       // one workgroup
  uint isHalted;             // 0, kHaltedForRoom or kHaltedByTurns
  uint indirectSample[3];    // over the contact particles that are looked at to see whether lists may stay, or none
  uint isDue;                // the step makes new lists
  uint indirectQuery[3];     // over contact particles, or none
  uint sampled;              // pairs that touch, of those looked at
  uint indirectMeeting[3];   // over contact particles that have contacts, or had
  uint meetingCount;         // how many they are
  uint motion;       // how far a contact particle may have come since its list was made, T |dv| included [m], as bits
  uint speed;        // the fastest contact particle's [m/s], as bits
  float cellSize;    // [m]
  float cellsPerMetre;  // its inverse
  uint longestList;  // pairs of the longest list
  uint blocks;       // that lists have asked for
  uint longestLive;  // contacts of the particle that has most
  uint liveBlocks;   // that contacts have asked for in this step
  uint missed;       // of the sample's pairs that touch, those that the lists lack
  uint step;         // of the frame, that the lists are for
  uint steps;        // since hair was last put somewhere
  uint rebuilds;     // since the simulation began
  uint listed;       // pairs in all lists, both sides counted
  uint pairTests;    // pairs looked at since the simulation began, modulo 2^32
};

// In dense hair lists are kept as long as, in a sample, no more than one in so many of the pairs that touch is missing
// from them: among many neighbours one is not missed. Elsewhere lists hold all.
RINGLET_CONSTANT uint kMissedOneIn = 100;

// Why everything stands still: lists have no room until the host has made some; or more particles are near one than the
// device's loops can look at (lavapipe ends an invocation's loops at 65,535 turns, without a word).
RINGLET_CONSTANT uint kHaltedForRoom = 1;
RINGLET_CONSTANT uint kHaltedByTurns = 2;

struct ContactParameters {
  uint contactCount;
  uint bucketCount;     // a power of two
  uint blockCount;      // there are
  uint mostBlocks;      // of a list
  uint liveBlockCount;  // there are in a row
  uint mostLiveBlocks;  // of a contact particle
  uint everyPair;       // any two strands may touch
  uint step;            // of the frame
  float seconds;        // T
  float skin;           // [m]
  float largestRadius;  // [m]
  float stiffness;      // k R / m_c [m/s^2]
  float dampingRatio;
  float friction;
  float ramp;           // what a share changes by in a step
  float stiffnessRelease;
  float dampingRelease;
  float reachFactor;    // lists hold what is nearer than this times r0, by place alone
  float breakFactor;    // beyond this times r0 a contact is over
  float seenAhead;      // a contact is seen ahead from this times r0
  float listedAhead;    // and in lists from this times r0 on, no more than seenAhead
  uint sampleStride;    // in dense hair: one contact particle in so many is in the sample; 0: there is none
  float warmth;         // share of a step's change by contacts that the next one is guessed to have
  float cellsPerMetre;  // beside a volume: cells are longer than any list reaches, and do not change
};

// Bindings of the volume's kernels, all in set 0.
RINGLET_CONSTANT uint kBindVolumePositions = 0;   // vec4[particles]: as above
RINGLET_CONSTANT uint kBindVolumeVelocities = 1;  // vec4[particles]: as above
RINGLET_CONSTANT uint kBindVolumeSolved = 2;      // vec4[particles]: v^k
RINGLET_CONSTANT uint kBindVolumePoses = 3;       // uniform: StepPose[kMaxStepPoses]
RINGLET_CONSTANT uint kBindVolumeParticles = 4;   // VolumeParticle[volume particles]
RINGLET_CONSTANT uint kBindVolumeStates = 5;      // VolumeState[volume particles]
RINGLET_CONSTANT uint kBindVolumeBrought = 6;     // vec4[volume particles]: as VolumeParcel's rate, first iterate
RINGLET_CONSTANT uint kBindVolumeCells = 7;       // uint: see cellCount and its like in shared/volume_buffers.glsl
RINGLET_CONSTANT uint kBindVolumeParcels = 8;     // VolumeParcel[volume particles], in cell order
RINGLET_CONSTANT uint kBindVolumeNodes = 9;       // vec4[nodes]: xyz: mean of a [m/s]; w: density [kg/m^3]
RINGLET_CONSTANT uint kBindVolumeAdded = 10;      // vec4[particles]: see kBindAddedByVolume
RINGLET_CONSTANT uint kBindVolumeControl = 11;    // VolumeControl
RINGLET_CONSTANT uint kBindVolumeHalt = 12;       // ContactControl
RINGLET_CONSTANT uint kBindVolumeLocated = 13;    // uvec4[volume particles]: xyz: place in cells, bits of floats; w:
                                                  // which parcel
RINGLET_CONSTANT uint kVolumeBindingCount = 14;
// And as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindVolumePositionTexels = 14;
RINGLET_CONSTANT uint kBindVolumeVelocityTexels = 15;
RINGLET_CONSTANT uint kBindVolumeSolvedTexels = 16;
RINGLET_CONSTANT uint kBindVolumeParticleTexels = 17;
RINGLET_CONSTANT uint kBindVolumeStateTexels = 18;  // 3 a volume particle
RINGLET_CONSTANT uint kBindVolumeBroughtTexels = 19;
RINGLET_CONSTANT uint kBindVolumeParcelTexels = 20;  // 2 a volume particle
RINGLET_CONSTANT uint kBindVolumeNodeTexels = 21;
RINGLET_CONSTANT uint kBindVolumeLocatedTexels = 22;
RINGLET_CONSTANT uint kBindVolumeCellTexels = 23;  // four numbers each
RINGLET_CONSTANT uint kVolumeTexelBindingCount = 10;

// Constant per volume particle, in device order: one in so many of a strand that meets others as a volume, for as many.
struct VolumeParticle {
  uint particle;
  float mass;             // of those it stands for [kg]
  float ownDensity;       // of its own strand at its place at rest [kg/m^3]
  float inverseMassUnit;  // 1 / the strand's mass unit [1/kg]; 0 for a particle that follows the head
};

// What it remembers from step to step.
struct VolumeState {
  vec4 memory;     // xyz: fading displacement s, in the head's frame [m]; w: density about it [kg/m^3]
  vec4 place;      // xyz: in the head's frame at the step's start [m]; w: what of its mass counts in the step, m o [kg]
  vec4 predicted;  // xyz: v^0 [m/s]; w: 1 where all this is known, 0 where the hair was just put there
};

// What it brings to the grid in an iteration.
struct VolumeParcel {
  vec4 rate;   // xyz: g a [kg m/s]; w: g [kg]
  vec4 place;  // xyz: in cells, from the box's first node; w: mass [kg]
};

// The box of cells about all such particles, and what kernels tell each other.
struct VolumeControl {
  uint indirectParticles[3];  // workgroups over particles of a sort, or none
  uint untilSort;             // steps until particles are next put into cells; 0: this step does
  uint indirectBlocks[3];     // over blocks of cells of a sort, or none
  uint cellCount;             // of the box, which has as many nodes
  uint indirectNodes[3];      // over nodes
  uint unused;
  int least[3];               // of the cells particles are in, as found so far in this step
  float cellsPerMetre;
  int greatest[3];
  float cell;                 // [m]
  int low[3];                 // the box's first cell
  uint unused2;
  uint size[3];               // and how many there are along each axis
  uint unused3;
};

struct VolumeParameters {
  uint count;         // volume particles
  uint cellCapacity;  // cells there is room for, a multiple of kBucketBlock
  uint step;          // of the frame
  float seconds;      // T
  float cell;         // h [m]
  float drag;         // lambda [1/s]
  float stiffness;    // k [1/s^2]
  float kept;         // share of a displacement that is still known a step later, exp(-T / tau)
  float warmth;       // as in ContactParameters
  uint sortSteps;     // particles are put into cells every so many steps; between they stay where they were
};

// Bindings of the follow_* kernels: hairs that follow guides (equations/follow.glsl).
RINGLET_CONSTANT uint kBindGuidePoints = 0;   // vec4[guide particles]: position [m], 0
RINGLET_CONSTANT uint kBindCoreRows = 1;      // CoreRow[guide particles]
RINGLET_CONSTANT uint kBindCoreWeights = 2;   // vec4[records of four weights]
RINGLET_CONSTANT uint kBindCores = 3;         // vec4[guide particles]: the guide's core there [m], 0
RINGLET_CONSTANT uint kBindFollowGuides = 4;  // FollowGuide[guides]
RINGLET_CONSTANT uint kBindCoreFrames = 5;    // vec4[guide particles]: quaternion
RINGLET_CONSTANT uint kBindCurls = 6;         // vec4[guide particles]: from the core, along its frame [m], 0
RINGLET_CONSTANT uint kBindFollowHairs = 7;   // FollowHair[hairs]
RINGLET_CONSTANT uint kBindHairPoints = 8;    // uvec4[points of hairs]: position's bits, hair and end (hairPoint)
// The same as texels, these numbers further:
RINGLET_CONSTANT uint kFollowTexels = 10;
RINGLET_CONSTANT uint kFollowBindingCount = 9;

// Constant per guide particle: its core is a weighted sum of particles about it.
struct CoreRow {
  uint firstParticle;  // of the sum
  uint firstRecord;    // of its weights, four to a record; those past the sum's end are 0
  uint recordCount;
  uint unused;
};

// Constant per guide.
struct FollowGuide {
  vec4 restFrame;  // quaternion: from the core's frame at the root, as it was groomed, to the groom's axes
  uint firstParticle;
  uint particleCount;
  uint unused[2];
};

// Constant per hair: where it stands beside its guide, and how it differs.
struct FollowHair {
  vec3 offset;  // of its root from the guide's, along the guide's restFrame [m]
  uint guide;
  float phase;   // by which the curl is turned about its core [rad]
  float radius;  // of the curl, over the guide's
  float lengthShare;  // of the guide that it follows
  float spread;  // what becomes of the offset beyond the root
  uint firstPoint;
  uint unused[3];
};

struct FollowParameters {
  vec4 head;      // quaternion: how the head has turned since the rest pose
  uint count;     // of what the kernel has an invocation for
  uint stride;    // invocations a hair: the most particles of any guide
  uint particles; // of all guides
};

// A point of a hair says which hair it is of, and whether it is the last of it.
RINGLET_CONSTANT uint kHairEnd = 0x80000000u;

// Bindings of the pose_* kernels: where simulated hair is, for what follows or draws it on the same device.
RINGLET_CONSTANT uint kBindPosePositions = 0;  // vec4[particles]: position [m], 0; as the solver has them
RINGLET_CONSTANT uint kBindPosePlaces = 1;     // PosePlace[particles]
RINGLET_CONSTANT uint kBindPosePoints = 2;     // uvec4[points]: position's bits, PosePlace::tag
RINGLET_CONSTANT uint kBindPoseBounds = 3;     // PoseBounds
RINGLET_CONSTANT uint kPoseBindingCount = 4;
// The positions as texels, this much further:
RINGLET_CONSTANT uint kPoseTexels = 10;

// Constant per particle.
struct PosePlace {
  uint point;  // where it goes
  uint tag;    // what stands behind its position there
};

struct PoseParameters {
  vec4 turn;  // quaternion: of particles that the head carries
  uint count;
  uint isTurned;
};

// The highest of all points along x, y, z, then how low the lowest are; as ordered bits (pose_bounds.comp), so that
// 0 is below all.
struct PoseBounds {
  uint high[3];
  uint low[3];
};

// Bindings of the render_* kernels: pictures of hair and bodies, without a graphics pipeline.
RINGLET_CONSTANT uint kBindPicture = 0;       // uniform: Picture
RINGLET_CONSTANT uint kBindDrawnPoints = 1;   // uvec4[points], as kBindHairPoints
RINGLET_CONSTANT uint kBindDrawnHairs = 2;    // DrawnHair[hairs]
RINGLET_CONSTANT uint kBindShadows = 3;       // uint[2][slices][cells][cells]: hair before each light
RINGLET_CONSTANT uint kBindDensity = 4;       // uint[cells^3]: hair about each place
RINGLET_CONSTANT uint kBindOpenness = 5;      // float[cells^3]: share of the sky that is seen from there
RINGLET_CONSTANT uint kBindSamples = 6;       // uvec2[samples]: what is seen and its nearness; then its colour
RINGLET_CONSTANT uint kBindSeen = 7;          // uint[samples]: those in which hair is seen
RINGLET_CONSTANT uint kBindSeenCounts = 8;    // SeenCounts
RINGLET_CONSTANT uint kBindSolidPoints = 9;   // SolidPoint[points of bodies, then patches]
RINGLET_CONSTANT uint kBindSolidTriangles = 10;  // SolidTriangle[triangles of bodies]
RINGLET_CONSTANT uint kBindSeenSolids = 11;   // uvec2[pixels]: those in which bodies are seen << 4 |
                                              // a sample there, and the triangle
RINGLET_CONSTANT uint kBindSolidColours = 12; // uvec2[pixels]: their colour, in halves
RINGLET_CONSTANT uint kBindPixels = 13;       // vec4[pixels]: sum of pictures, linear; w: their number
RINGLET_CONSTANT uint kBindShown = 14;        // uint[pixels]: red, green, blue, 255, as they are shown
RINGLET_CONSTANT uint kRenderBindingCount = 15;
// Those read as texels, these numbers further:
RINGLET_CONSTANT uint kRenderTexels = 20;

RINGLET_CONSTANT uint kSpecPass = 2;     // of render_hairs and render_solids without 64-bit atomics: 0 nearness, 1 what
RINGLET_CONSTANT uint kSolid = 0x80000000u;  // what is seen is a triangle of a body
RINGLET_CONSTANT uint kShadedHair = 0x80000000u;  // of a sample's second word: it holds a colour, no nearness

RINGLET_CONSTANT uint kSolidRows = 64;  // of samples, that an invocation of render_solids has

// Of a picture and its camera.
struct Picture {
  vec4 view[3];            // rows: from the world to the camera's right, up and forward axes [m]
  vec4 eye;                // [m], 0
  vec4 lightAxes[6];       // rows, three a light: from the world to the light's box, each of x, y and depth in [0, 1]
  vec4 lightDirection[2];  // towards it, 0
  vec4 lightColour[2];     // irradiance, 0
  vec4 skyAbove;           // radiance, 0
  vec4 skyBelow;
  vec4 densityBox;         // lower corner [m], cell [m]
  vec4 pigments[2];        // absorption over a fibre's radius, between which hairs are; 0
  vec4 solidColour;        // reflected share, 0
  vec4 backColours[2];     // radiance behind all: in the middle, at the edge; 0
  uint width;
  uint height;
  uint side;               // samples along a pixel's side
  uint hairCount;
  uint pointsPerHair;      // the most of any hair
  uint pointCount;
  uint triangleCount;
  uint shadowCells;        // across a light's box
  uint shadowSlices;       // along it
  uint densityCells;       // along each side of the density's box
  uint shadowStride;       // every so many hairs count, for as many
  float focus;             // pixels a metre one metre away
  float near;              // what is nearer is left out [m]
  float shadowCellArea;    // [m^2]
  float fixedPoint;        // units a square metre of hair
  float shadowOpacity;     // share of light that a hair keeps from what is behind it
  float along;             // HairFibre
  float about;
  float tilt;
  float exposure;
  float tipRadius;         // share of a hair's radius that is left at its tip
  float throughHair;       // brightness of light that came through other hairs
};

// Constant per hair.
struct DrawnHair {
  uint firstPoint;
  uint pointCount;
  float radius;   // at the root [m]
  float pigment;  // place between the picture's two pigments, in [0, 1]
};

struct SolidPoint {
  vec4 position;  // [m]; w: of a patch, its area [m^2]
  vec4 normal;    // 0
};

struct SolidTriangle {
  uint points[3];
  uint unused;
};

// What is seen of hair and of bodies, as groups of invocations and as numbers.
struct SeenCounts {
  uint indirectHairs[3];
  uint hairs;
  uint indirectSolids[3];
  uint solids;
};

// Bindings of render_stretch: hairs take the colour of how far their strand is stretched.
RINGLET_CONSTANT uint kBindStretchPoints = 0;   // uvec4[points of strands]: position's bits, anything
RINGLET_CONSTANT uint kBindStretchLengths = 1;  // float[points of strands]: of the edge that begins there, at rest [m]
RINGLET_CONSTANT uint kBindStretchStrands = 2;  // StretchStrand[hairs]
RINGLET_CONSTANT uint kBindStretchHairs = 3;    // DrawnHair[hairs]

// Constant per hair: the strand that it is, or follows.
struct StretchStrand {
  uint firstPoint;
  uint pointCount;
};

struct StretchParameters {
  uint count;  // of hairs
  float most;  // share of its length by which an edge of the second pigment is longer
};

// A part of a picture: whole rows of pixels.
struct PictureBand {
  uint firstRow;
  uint rowCount;
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
