// The contact kernels: structs, binding numbers, push constants, limits.
#ifndef RINGLET_LAYOUT_CONTACTS
#define RINGLET_LAYOUT_CONTACTS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Specialization constants of the contact kernels.
RINGLET_CONSTANT uint kSpecInGroups = 2;
RINGLET_CONSTANT uint kSpecDivided = 3;

// Bindings of the contact kernels, all in set 0.
RINGLET_CONSTANT uint kBindContactPositions = 0;   // vec4[particles]: as above
RINGLET_CONSTANT uint kBindContactVelocities = 1;  // vec4[particles]: as above
RINGLET_CONSTANT uint kBindContactSolved = 2;      // vec4[particles]: v^k
RINGLET_CONSTANT uint kBindContacts = 3;           // ContactRest[contacts]
RINGLET_CONSTANT uint kBindNeighbours = 4;         // uvec4: strands that may touch, see kNoStrand
RINGLET_CONSTANT uint kBindIndices = 5;            // uvec4: the contact particle of each particle, four a record
RINGLET_CONSTANT uint kBindGrid = 6;               // uint: see gridStart and the functions after it in
                                                   // shared/contact_buffers.glsl
RINGLET_CONSTANT uint kBindPlaces = 7;             // ContactPlace[contacts], in cell order
RINGLET_CONSTANT uint kBindHistories = 8;          // ContactHistory[contacts]
RINGLET_CONSTANT uint kBindGuesses = 9;            // vec4[particles]: xyz: the first iterate's velocity [m/s]; w:
                                                   // radius [m]
RINGLET_CONSTANT uint kBindLists = 10;              // uint: see listOf and the functions after it in
                                                    // shared/contact_buffers.glsl
RINGLET_CONSTANT uint kBindPairs = 11;             // ContactPair[blocks][kListBlock]
RINGLET_CONSTANT uint kBindLiveLists = 12;         // uint: see liveListOf
RINGLET_CONSTANT uint kBindLives = 13;             // ContactLife[2][liveBlocks][kLiveBlock]
RINGLET_CONSTANT uint kBindForces = 14;            // ContactForce[liveBlocks][kLiveBlock]
RINGLET_CONSTANT uint kBindSystems = 15;           // ContactSystem[particles]
RINGLET_CONSTANT uint kBindControl = 16;           // ContactControl
RINGLET_CONSTANT uint kBindSampled = 17;           // uint: if strands are divided among devices, see
                                                   // sampledContact
RINGLET_CONSTANT uint kContactBindingCount = 18;
// Some of them also as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindContactPositionTexels = 18;
RINGLET_CONSTANT uint kBindContactVelocityTexels = 19;
RINGLET_CONSTANT uint kBindContactSolvedTexels = 20;
RINGLET_CONSTANT uint kBindContactTexels = 21;  // 2 a contact particle
RINGLET_CONSTANT uint kBindNeighbourTexels = 22;
RINGLET_CONSTANT uint kBindIndexTexels = 23;
RINGLET_CONSTANT uint kBindPlaceTexels = 24;    // 2 a contact particle
RINGLET_CONSTANT uint kBindHistoryTexels = 25;  // 4 a contact particle
RINGLET_CONSTANT uint kBindGuessTexels = 26;
RINGLET_CONSTANT uint kBindPairTexels = 27;
RINGLET_CONSTANT uint kBindLifeTexels = 28;
RINGLET_CONSTANT uint kBindForceTexels = 29;    // 2 a contact
RINGLET_CONSTANT uint kBindContactNumbers = 30;  // uniform: ContactNumbers
RINGLET_CONSTANT uint kContactTexelBindingCount = 12;

// Lists are divided into blocks of this many pairs, which kernels take from a store as they need them. Which
// block a list gets depends on the timing of threads; the content of a list and its order do not.
RINGLET_CONSTANT uint kListBlock = 16;          // two bits of an integer for each (contact_touch.comp)
RINGLET_CONSTANT uint kLiveBlock = 4;
RINGLET_CONSTANT uint kBucketBlock = 1024;      // buckets of the grid that a workgroup sums
// If strands have groups, which ones are in a cell: 0: none; a group + 1; or several groups.
RINGLET_CONSTANT uint kSeveralGroups = 0xffffffffu;
RINGLET_CONSTANT uint kNoBucket = 0xffffffffu;  // bucket of a contact particle that is not in the grid
RINGLET_CONSTANT uint kNoStrand = 0xffffffffu;  // a free place in the table of strands that may touch. The
                                                // table has a record for each strand (its first bucket, the
                                                // number of its buckets minus 1, its group, 1 if another
                                                // device steps it), then the buckets of four strands; see
                                                // solver/contacts/neighbour_table.h

// Constant for each contact particle, in device order.
struct ContactRest {
  vec3 point;    // at rest [m]
  float radius;  // [m]
  uint particle;
  uint strand;
  float mass;             // m_c [kg]
  float inverseMassUnit;  // 1 / the strand's mass unit [1/kg]; 0 for a particle that follows the head
};

// A neighbour of a contact particle: close enough to touch while the list is valid.
struct ContactPair {
  uint particle;     // the other, device order
  float restLength;  // r0 [m]
  float stiffness;   // k [N/m]
  float damping;     // c [N s/m]
};

// The state that a contact keeps from step to step. There are two rows, for this step and the last. Both
// shares fit into one number, since the damping share is 1 while the stiffness share is not 0: it is -kappa,
// or delta if kappa is 0.
struct ContactLife {
  uint particle;     // the other, device order
  float shares;
  float restLength;  // r0 [m]
  float stiffness;   // k [N/m]
};

// A contact in a step, for one of its particles. The other particle has the contact too, with the same
// numbers.
struct ContactForce {
  vec4 normal;     // xyz: n; w: q_s [kg]
  uint particle;   // the other, device order
  float damping;   // q_d [kg]
  float gap;       // r0 - d [m]
  uint unused;
};

// The terms that contacts add to a particle's velocity system, (L + 2 D) v = base + momentum, in the strand's
// mass units.
struct ContactSystem {
  vec4 diagonal;     // xyz: of D xx, yy, zz; w: push x
  vec4 offDiagonal;  // xyz: of D yz, xz, xy; w: push y
  vec4 momentum;     // xyz: push and sum of Q (v_a + v_b) [mass unit m/s]; w: push z. The push is the sum of push n
};

// A place of the grid: a contact particle as it was when lists were made. Floats are stored as integers here:
// a driver may flush an integer that it moves as a float to 0, but not a float that it moves as an integer.
struct ContactPlace {
  uvec4 position;  // xyz: [m], bits of floats; w: group of its strand, see groupOf in
                   // shared/contact_buffers.glsl
  uvec4 velocity;  // xyz: v^0 [m/s], bits of floats; w: index of the contact particle
};

// Earlier states of a contact particle: when its list was made, and in the step before.
struct ContactHistory {
  vec4 position;      // when its list was made [m]
  vec4 velocity;      // v^0 then [m/s]
  vec4 predicted[2];  // v^0 of this step and the one before, by parity [m/s]
};

// The state that contact kernels share, and results for the host.
struct ContactControl {
  uint indirectContacts[3];  // workgroups over contact particles when lists are made, or none
  uint isListed;             // lists exist
  uint indirectBuckets[3];   // workgroups over blocks of buckets
  uint parity;               // which of the two rows is in use
  uint isHalted;             // 0, kHaltedForRoom or kHaltedByTurns
  uint finished;             // workgroups of this dispatch that are done (shared/last_group.glsl)
  uint indirectSample[3];    // workgroups over the sample that decides whether lists are kept, or none
  uint isDue;                // this step makes new lists
  uint indirectQuery[3];     // workgroups over contact particles, or none
  uint sampled;              // pairs of the sample that touch
  uint indirectMeeting[3];   // workgroups over contact particles that have contacts, or had
  uint meetingCount;         // number of these
  uint motion;       // largest distance that a contact particle may have moved since its list was made, T
                     // |dv| included [m], as bits
  uint speed;        // largest speed of a contact particle [m/s], as bits
  float cellSize;    // [m]
  float cellsPerMetre;  // 1 / cellSize
  uint longestList;  // pairs of the longest list
  uint blocks;       // number of blocks that lists need
  uint longestLive;  // largest number of contacts of a particle
  uint liveBlocks;   // number of blocks that contacts need in this step
  uint missed;       // pairs of the sample that touch but are not in the lists
  uint step;         // step of the frame that the lists are for
  uint steps;        // number of steps since the hair was last placed
  uint rebuilds;     // since the simulation began
  uint listed;       // pairs in all lists, both sides counted
  uint pairTests;    // pairs tested since the simulation began, modulo 2^32
};

// In dense hair lists are kept until more than one in this many of the sample's touching pairs is missing
// from them: among many neighbours a missing one hardly matters. In other hair lists contain all pairs.
RINGLET_CONSTANT uint kMissedOneIn = 100;

// Why contact kernels do nothing: lists are too short, until the host has enlarged them; or a particle has
// more neighbours than the device's loops can visit (lavapipe silently ends an invocation's loops after
// 65,535 turns).
RINGLET_CONSTANT uint kHaltedForRoom = 1;
RINGLET_CONSTANT uint kHaltedByTurns = 2;

// The strands whose contact particles a dispatch of contact_motion.comp measures.
RINGLET_CONSTANT uint kOfAll = 0;
RINGLET_CONSTANT uint kOfHere = 1;       // stepped by this device
RINGLET_CONSTANT uint kOfElsewhere = 2;  // stepped by another device

// Push constants of a dispatch.
struct ContactParameters {
  uint step;   // of the frame
  uint whose;  // contact_motion.comp: kOfAll, kOfHere or kOfElsewhere
};

// Settings, and sizes of the buffers.
struct ContactNumbers {
  uint contactCount;
  uint bucketCount;     // a power of two
  uint blockCount;      // in the store
  uint mostBlocks;      // in one list
  uint liveBlockCount;  // in one row of the store
  uint mostLiveBlocks;  // of one contact particle
  uint everyPair;       // any two strands may touch
  float seconds;        // T
  float skin;           // [m]
  float largestRadius;  // [m]
  float stiffness;      // k R / m_c [m/s^2]
  float dampingRatio;
  float friction;
  float ramp;           // change of a share in a step
  float stiffnessRelease;
  float dampingRelease;
  float reachFactor;    // lists contain pairs closer than this times r0, whatever their speed
  float breakFactor;    // beyond this times r0 a contact ends
  float seenAhead;      // closer than this times r0 a contact may be seen ahead
  float listedAhead;    // lists look ahead up to this times r0; at most seenAhead
  uint mostSampled;     // largest number of contact particles in a sample
  uint sampleStride;    // in dense hair one contact particle in this many is in the sample; 0: no sample
  float warmth;         // share of the last step's change by contacts that is guessed for the next step
  float cellsPerMetre;  // with a volume: cells are larger than the reach of any list, and constant
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
