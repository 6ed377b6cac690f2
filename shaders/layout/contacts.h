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
RINGLET_CONSTANT uint kBindSampled = 17;           // uint: where strands are divided, see sampledContact
RINGLET_CONSTANT uint kContactBindingCount = 18;
// And as texels (shared/texels.glsl):
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

// Lists are as long as they must be, in blocks of this many pairs that are given out as they are asked for. Which block
// went where depends on threads; what is in a list, and its order, does not.
RINGLET_CONSTANT uint kListBlock = 16;          // two bits of an integer for each (contact_touch.comp)
RINGLET_CONSTANT uint kLiveBlock = 4;
RINGLET_CONSTANT uint kBucketBlock = 1024;      // buckets of the grid that are summed together
// Of strands in groups, who is in a cell: 0 nobody, a group and one more, or several groups.
RINGLET_CONSTANT uint kSeveralGroups = 0xffffffffu;
RINGLET_CONSTANT uint kNoBucket = 0xffffffffu;  // of a contact particle that is not in the grid
RINGLET_CONSTANT uint kNoStrand = 0xffffffffu;  // a free slot of the table of who may touch whom: that has a record for
                                                // each strand, (first of its buckets, how many less one, its group, 1
                                                // where another device steps it), then the buckets of four strands; see
                                                // solver/contacts/neighbour_table.h

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
  uint isHalted;             // 0, kHaltedForRoom or kHaltedByTurns
  uint finished;             // workgroups of this dispatch (shared/last_group.glsl)
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

// The strands whose contact particles a dispatch of contact_motion.comp is for.
RINGLET_CONSTANT uint kOfAll = 0;
RINGLET_CONSTANT uint kOfHere = 1;       // stepped by this device
RINGLET_CONSTANT uint kOfElsewhere = 2;  // by another

// Push constants: what a dispatch is of.
struct ContactParameters {
  uint step;   // of the frame
  uint whose;  // contact_motion.comp: kOfAll, kOfHere or kOfElsewhere
};

// Settings, and what there is room for.
struct ContactNumbers {
  uint contactCount;
  uint bucketCount;     // a power of two
  uint blockCount;      // there are
  uint mostBlocks;      // of a list
  uint liveBlockCount;  // there are in a row
  uint mostLiveBlocks;  // of a contact particle
  uint everyPair;       // any two strands may touch
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
  uint mostSampled;     // contact particles of a sample, at most
  uint sampleStride;    // in dense hair: one contact particle in so many is in the sample; 0: there is none
  float warmth;         // share of a step's change by contacts that the next one is guessed to have
  float cellsPerMetre;  // beside a volume: cells are longer than any list reaches, and do not change
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
