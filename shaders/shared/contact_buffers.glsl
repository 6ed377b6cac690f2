// The buffers and parameters of the contact kernels (layout/contacts.h).
#ifndef RINGLET_CONTACT_BUFFERS
#define RINGLET_CONTACT_BUFFERS

#include "layout/contacts.h"
#include "shared/at_once.glsl"
#include "shared/texels.glsl"
#include "shared/workgroup.glsl"


layout(set = 0, binding = kBindContactPositions) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindContactVelocities) readonly buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = kBindContactSolved) readonly buffer Solved { vec4 solved[]; };
layout(set = 0, binding = kBindContacts) readonly buffer Contacts { ContactRest contacts[]; };
layout(set = 0, binding = kBindNeighbours) readonly buffer Neighbours { uvec4 neighbours[]; };
layout(set = 0, binding = kBindIndices) readonly buffer Indices { uvec4 indices[]; };
layout(set = 0, binding = kBindGrid) buffer Grid { uint grid[]; };
layout(set = 0, binding = kBindPlaces) buffer Places { ContactPlace places[]; };
layout(set = 0, binding = kBindHistories) buffer Histories { ContactHistory histories[]; };
layout(set = 0, binding = kBindGuesses) buffer Guesses { vec4 guesses[]; };
layout(set = 0, binding = kBindLists) buffer Lists { uint lists[]; };
layout(set = 0, binding = kBindPairs) buffer Pairs { ContactPair pairs[]; };
layout(set = 0, binding = kBindLiveLists) buffer LiveLists { uint liveLists[]; };
layout(set = 0, binding = kBindLives) buffer Lives { ContactLife lives[]; };
layout(set = 0, binding = kBindForces) buffer Forces { ContactForce forces[]; };
layout(set = 0, binding = kBindSystems) buffer Systems { ContactSystem systems[]; };
layout(set = 0, binding = kBindSampled) readonly buffer Sampled { uint sampled[]; };
layout(set = 0, binding = kBindControl) buffer Control { ContactControl control; };
layout(set = 0, binding = kBindContactPositionTexels) uniform usamplerBuffer positionTexels;
layout(set = 0, binding = kBindContactVelocityTexels) uniform usamplerBuffer velocityTexels;
layout(set = 0, binding = kBindContactSolvedTexels) uniform usamplerBuffer solvedTexels;
layout(set = 0, binding = kBindContactTexels) uniform usamplerBuffer contactTexels;
layout(set = 0, binding = kBindNeighbourTexels) uniform usamplerBuffer neighbourTexels;
layout(set = 0, binding = kBindIndexTexels) uniform usamplerBuffer indexTexels;
layout(set = 0, binding = kBindPlaceTexels) uniform usamplerBuffer placeTexels;
layout(set = 0, binding = kBindHistoryTexels) uniform usamplerBuffer historyTexels;
layout(set = 0, binding = kBindGuessTexels) uniform usamplerBuffer guessTexels;
layout(set = 0, binding = kBindPairTexels) uniform usamplerBuffer pairTexels;
layout(set = 0, binding = kBindLifeTexels) uniform usamplerBuffer lifeTexels;
layout(set = 0, binding = kBindForceTexels) uniform usamplerBuffer forceTexels;
layout(push_constant) uniform Parameters { ContactParameters parameters; };
layout(set = 0, binding = kBindContactNumbers) uniform Numbers { ContactNumbers numbers; };

layout(constant_id = kSpecInGroups) const bool kInGroups = false;  // strands of one group do not touch pair
                                                                   // by pair
layout(constant_id = kSpecDivided) const bool kDivided = false;   // other devices step some of the strands
layout(constant_id = kSpecForGpu) const bool kForGpu = false;

uvec4 neighbourRecord(uint i) { return kTexels ? recordAt(neighbourTexels, i) : neighbours[i]; }
/// The group of a strand. Strands of one group do not touch pair by pair (rest/volume_strands.h).
uint groupOf(uint strand) { return kInGroups ? neighbourRecord(strand).z : strand; }
/// Strands that another device steps are found as neighbours, but have no lists and no contacts here
/// (solver/divided/divided_hair.h).
bool isElsewhere(uint strand) { return kDivided && neighbourRecord(strand).w != 0; }

// Accessors of records, as they were when the dispatch began.
vec3 positionOf(uint particle) { return kTexels ? vectorAt(positionTexels, particle).xyz : positions[particle].xyz; }
vec3 lastVelocityOf(uint particle) {
  return kTexels ? vectorAt(velocityTexels, particle).xyz : velocities[particle].xyz;
}
vec3 velocityOf(uint particle) { return kTexels ? vectorAt(solvedTexels, particle).xyz : solved[particle].xyz; }
ContactRest contactOf(uint c) {
  if (!kTexels) return contacts[c];
  uvec4 b = recordAt(contactTexels, 2 * c + 1);
  vec4 sphere = vectorAt(contactTexels, 2 * c);
  return ContactRest(sphere.xyz, sphere.w, b.x, b.y, uintBitsToFloat(b.z), uintBitsToFloat(b.w));
}
uint contactAt(uint particle) {
  uvec4 four = kTexels ? recordAt(indexTexels, particle / 4) : indices[particle / 4];
  uvec2 two = (particle & 2) == 0 ? four.xy : four.zw;
  return (particle & 1) == 0 ? two.x : two.y;
}
/// Whether a particle comes before another in the whole groom. If strands are divided among devices, those of
/// other devices come last on this one, but contact particles are in groom order everywhere.
bool isBefore(uint particle, uint other) {
  return kDivided ? contactAt(particle) < contactAt(other) : particle < other;
}
uvec4 placedPosition(uint place) { return kTexels ? recordAt(placeTexels, 2 * place) : places[place].position; }
uvec4 placedVelocity(uint place) { return kTexels ? recordAt(placeTexels, 2 * place + 1) : places[place].velocity; }
/// Numbers of ContactControl that do not change in a dispatch that reads them. main reads them first
/// (readControl): a number of a buffer that is one for all lanes may be read lane by lane behind a branch.
struct Now {
  bool isHalted;
  uint parity, steps, meetingCount;
  float cellSize, cellsPerMetre;
};
Now now;
void readControl() {
  now = Now(control.isHalted != 0, control.parity, control.steps, control.meetingCount, control.cellSize,
            control.cellsPerMetre);
}

vec3 listedPosition(uint c) { return kTexels ? vectorAt(historyTexels, 4 * c).xyz : histories[c].position.xyz; }
vec3 listedVelocity(uint c) { return kTexels ? vectorAt(historyTexels, 4 * c + 1).xyz : histories[c].velocity.xyz; }
void setListed(uint c, vec3 x, vec3 v) {
  histories[c].position = vec4(x, 0);
  histories[c].velocity = vec4(v, 0);
}
vec3 predictedBefore(uint c) {
  return kTexels ? vectorAt(historyTexels, 4 * c + 2 + now.parity).xyz : histories[c].predicted[now.parity].xyz;
}
/// xyz: the guessed velocity [m/s]; w: the radius [m].
vec4 guessOf(uint particle) { return kTexels ? vectorAt(guessTexels, particle) : guesses[particle]; }
ContactPair pairAt(uint entry) {
  if (!kTexels) return pairs[entry];
  uvec4 pair = recordAt(pairTexels, entry);
  return ContactPair(pair.x, uintBitsToFloat(pair.y), uintBitsToFloat(pair.z), uintBitsToFloat(pair.w));
}
ContactLife lifeAt(uint entry) {
  if (!kTexels) return lives[entry];
  uvec4 life = recordAt(lifeTexels, entry);
  return ContactLife(life.x, uintBitsToFloat(life.y), uintBitsToFloat(life.z), uintBitsToFloat(life.w));
}
ContactForce forceAt(uint entry) {
  if (!kTexels) return forces[entry];
  uvec4 b = recordAt(forceTexels, 2 * entry + 1);
  return ContactForce(vectorAt(forceTexels, 2 * entry), b.x, uintBitsToFloat(b.y), uintBitsToFloat(b.z), 0);
}

/// Contact particle k of this step's sample, one in sampleStride of all; kNoContact if there are fewer. If
/// strands are divided among devices, the contact particles of strands stepped here are in a list by their
/// index in the whole groom modulo the stride; before them the list has the start of each remainder.
const uint kNoContact = 0xffffffffu;
/// Invocations that share a particle of a sample: on a GPU a dispatch takes as long as its longest search.
const uint kSampleLanes = kForGpu ? 9 : 1;
/// Particles of a sample for each workgroup.
uint sampledOfGroup() { return gl_WorkGroupSize.x / kSampleLanes; }
uint sampledContact(uint k) {
  uint remainder = now.steps % numbers.sampleStride;
  if (kDivided) {
    uint at = sampled[remainder] + k;
    return at < sampled[remainder + 1] ? sampled[at] : kNoContact;
  }
  uint c = k * numbers.sampleStride + remainder;
  return c < numbers.contactCount ? c : kNoContact;
}

// The parts of the grid's buffer, one after another; solver/contacts/contact_stage.cpp computes its size. The contact
// particles of bucket b are the entries [start of b, start of b + 1).
uint gridCount(uint bucket) { return bucket; }  // contact particles in a bucket; 0 outside a rebuild
// Start of a bucket within its block; one entry more than there are buckets.
uint gridStart(uint bucket) { return numbers.bucketCount + bucket; }
// Sum before a block; one entry more than there are blocks.
uint gridSum(uint block) { return 2 * numbers.bucketCount + 1 + block; }
uint gridBucketOf(uint c) { return gridSum(numbers.bucketCount / kBucketBlock + 1) + c; }
// Rank of c in its bucket; the order is arbitrary.
uint gridRank(uint c) { return gridBucketOf(numbers.contactCount) + c; }
/// The contact particle at a place; the order within a bucket is arbitrary.
uint gridEntry(uint place) { return gridRank(numbers.contactCount) + place; }

/// If some hair is a volume: the group in a cell, and in a region of eight cells; see kSeveralGroups.
uint cellGroups(uint bucket) { return gridEntry(numbers.contactCount) + bucket; }
uint regionGroups(uint bucket) { return cellGroups(numbers.bucketCount) + bucket; }
bool hasOthers(uint groups, uint group) { return groups != 0 && groups != group + 1; }
/// Contact particles in the grid: if some hair is a volume, only those with a possible partner nearby.
uint placedCount() {
  return kInGroups ? grid[gridSum(numbers.bucketCount / kBucketBlock)] : numbers.contactCount;
}

uint startOf(uint bucket) { return grid[gridStart(bucket)] + grid[gridSum(bucket / kBucketBlock)]; }

// The cell of a place. Cells have one size and are hashed, so that hair may be anywhere. Consecutive cells along x have
// consecutive buckets, so that three of them are one range of entries. Coordinates beyond 2^30 cells are clamped.
// The coordinate is a product and not a quotient: Vulkan specifies the rounding of products exactly, and two kernels
// must find the same cell for the same place.
ivec3 cellOf(vec3 x) {
  float cellsPerMetre = kInGroups ? numbers.cellsPerMetre : now.cellsPerMetre;
  return ivec3(clamp(floor(x * cellsPerMetre), vec3(-1073741824.0), vec3(1073741824.0)));
}
uint bucketOf(ivec3 cell) {
  uint row = uint(cell.y) * 2654435761u ^ uint(cell.z) * 2246822519u;
  row = (row ^ (row >> 15)) * 2654435769u;
  return ((row ^ (row >> 13)) + uint(cell.x)) & (numbers.bucketCount - 1);
}

// The buffer of lists. listOf: where the list of a contact particle starts. A list is its length, followed by two
// numbers per block of pairs: the index of the block, and bits. The lower half of the bits marks the pairs that act on
// each other, the upper half those that touch or, between iterations, those whose springs push.
uint listOf(uint c) { return c * (1 + 2 * numbers.mostBlocks); }
uint listedBlock(uint list, uint b) { return list + 1 + 2 * b; }
uint pairBits(uint list, uint b) { return list + 2 + 2 * b; }
/// After the lists: the contact particles that have contacts or had some, in arbitrary order; then whether each has
/// any.
uint meetingPlace(uint i) { return listOf(numbers.contactCount) + i; }
uint meetsPlace(uint c) { return meetingPlace(numbers.contactCount) + c; }
/// Where the list of a contact particle's contacts starts, of this step or of the last: their number, then blocks.
uint liveListOf(uint c, uint parity) { return (2 * c + parity) * (1 + numbers.mostLiveBlocks); }
/// Index of contact j of a list among the forces, and of such an entry among the lives.
uint forceEntry(uint list, uint j) { return liveLists[list + 1 + j / kLiveBlock] * kLiveBlock + j % kLiveBlock; }
uint lifeEntry(uint parity, uint force) { return parity * numbers.liveBlockCount * kLiveBlock + force; }

/// Pairs, with place and velocity of the other particle, loaded together.
struct Partners {
  ContactPair pair[kAtOnce];
  vec3 x[kAtOnce];
  vec3 v[kAtOnce];
};
Partners partnersAt(uint entries[kAtOnce]) {
  Partners some;
  for (uint j = 0; j < kAtOnce; ++j) some.pair[j] = pairAt(entries[j]);
  for (uint j = 0; j < kAtOnce; ++j) {
    some.x[j] = positionOf(some.pair[j].particle);
    some.v[j] = velocityOf(some.pair[j].particle);
  }
  return some;
}

/// Whether every list had room for all its pairs.
bool listsHadRoom() {
  uint blocks = control.blocks, longest = control.longestList;
  return blocks <= numbers.blockCount && longest <= numbers.mostBlocks * kListBlock;
}
/// Called by one invocation. If lists had no room, contact kernels do nothing until the host has enlarged the
/// buffers. If they had, the step has tested every pair in them.
void endLists(bool hadRoom) {
  if (hadRoom) {
    control.pairTests += control.listed;
  } else {
    control.isHalted = kHaltedForRoom;
  }
}

// Required by shared/last_group.glsl.
uint addFinished() { return atomicAdd(control.finished, 1); }
void clearFinished() { control.finished = 0; }

#endif
