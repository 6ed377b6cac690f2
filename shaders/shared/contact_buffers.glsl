// The buffers and parameters of the contact kernels (layout.h).
#ifndef RINGLET_CONTACT_BUFFERS
#define RINGLET_CONTACT_BUFFERS

#include "shared/layout.h"
#include "shared/texels.glsl"

layout(local_size_x_id = 0) in;

layout(set = 0, binding = kBindContactPositions) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindContactSolved) readonly buffer Solved { vec4 solved[]; };
layout(set = 0, binding = kBindContacts) readonly buffer Contacts { ContactRest contacts[]; };
layout(set = 0, binding = kBindNeighbours) readonly buffer Neighbours { uint neighbours[]; };
layout(set = 0, binding = kBindGrid) buffer Grid { uint grid[]; };
layout(set = 0, binding = kBindPlaces) buffer Places { ContactPlace places[]; };
layout(set = 0, binding = kBindLists) buffer Lists { uint lists[]; };
layout(set = 0, binding = kBindPairs) buffer Pairs { ContactPair pairs[]; };
layout(set = 0, binding = kBindLives) buffer Lives { ContactLife lives[]; };
layout(set = 0, binding = kBindNormals) buffer Normals { vec4 normals[]; };
layout(set = 0, binding = kBindSystems) buffer Systems { ContactSystem systems[]; };
layout(set = 0, binding = kBindQueue) buffer Queues { vec2 queues[]; };
layout(set = 0, binding = kBindControl) buffer Control { ContactControl control; };
layout(set = 0, binding = kBindContactPositionTexels) uniform usamplerBuffer positionTexels;
layout(set = 0, binding = kBindContactSolvedTexels) uniform usamplerBuffer solvedTexels;
layout(set = 0, binding = kBindContactTexels) uniform usamplerBuffer contactTexels;
layout(set = 0, binding = kBindPlaceTexels) uniform usamplerBuffer placeTexels;
layout(set = 0, binding = kBindPairTexels) uniform usamplerBuffer pairTexels;
layout(set = 0, binding = kBindLifeTexels) uniform usamplerBuffer lifeTexels;
layout(set = 0, binding = kBindNormalTexels) uniform usamplerBuffer normalTexels;
layout(push_constant) uniform Parameters { ContactParameters parameters; };

// Records as they were when the dispatch began.
vec3 positionOf(uint particle) { return kTexels ? vectorAt(positionTexels, particle).xyz : positions[particle].xyz; }
vec3 velocityOf(uint particle) { return kTexels ? vectorAt(solvedTexels, particle).xyz : solved[particle].xyz; }
ContactRest contactOf(uint c) {
  if (!kTexels) return contacts[c];
  uvec4 b = recordAt(contactTexels, 2 * c + 1);
  return ContactRest(vectorAt(contactTexels, 2 * c), b.x, b.y, uintBitsToFloat(b.z), uintBitsToFloat(b.w));
}
vec4 sortedAt(uint place) { return kTexels ? vectorAt(placeTexels, 3 * place) : places[place].sorted; }
vec3 listedPosition(uint c) { return kTexels ? vectorAt(placeTexels, 3 * c + 1).xyz : places[c].position.xyz; }
vec3 listedVelocity(uint c) { return kTexels ? vectorAt(placeTexels, 3 * c + 2).xyz : places[c].velocity.xyz; }
ContactPair pairAt(uint entry) {
  if (!kTexels) return pairs[entry];
  uvec4 pair = recordAt(pairTexels, entry);
  return ContactPair(pair.x, uintBitsToFloat(pair.y), uintBitsToFloat(pair.z), uintBitsToFloat(pair.w));
}
ContactLife lifeAt(uint entry) {
  if (!kTexels) return lives[entry];
  uvec4 two = recordAt(lifeTexels, entry / 2);
  return entry % 2 == 0 ? ContactLife(uintBitsToFloat(two.x), two.y) : ContactLife(uintBitsToFloat(two.z), two.w);
}
vec4 normalAt(uint entry) { return kTexels ? vectorAt(normalTexels, entry) : normals[entry]; }

// The grid's buffer, one part after another; its size is reckoned in solver/contact_stage.cpp. Bucket b's contact particles are entries [start of b, start of b + 1).
uint gridCount(uint bucket) { return bucket; }  // how many are in a bucket; 0 outside a rebuild
uint gridStart(uint bucket) { return parameters.bucketCount + bucket; }  // within its block; one more than buckets
uint gridSum(uint block) { return 2 * parameters.bucketCount + 1 + block; }  // before a block; one more than blocks
uint gridBucketOf(uint c) { return gridSum(parameters.bucketCount / kBucketBlock + 1) + c; }
uint gridRank(uint c) { return gridBucketOf(parameters.contactCount) + c; }  // among its bucket's, in any order
uint gridEntry(uint place) { return gridRank(parameters.contactCount) + place; }  // contact particle, in any order in a bucket

uint startOf(uint bucket) { return grid[gridStart(bucket)] + grid[gridSum(bucket / kBucketBlock)]; }

// Cells of one size, hashed, so that hair may be anywhere. Cells that follow each other along x are in buckets that do, so
// that three of them are one range. Beyond 2^30 cells all share the last.
ivec3 cellOf(vec3 x) { return ivec3(clamp(floor(x / control.cellSize), vec3(-1073741824.0), vec3(1073741824.0))); }
uint bucketOf(ivec3 cell) {
  uint row = uint(cell.y) * 2654435761u ^ uint(cell.z) * 2246822519u;
  row = (row ^ (row >> 15)) * 2654435769u;
  return ((row ^ (row >> 13)) + uint(cell.x)) & (parameters.bucketCount - 1);
}

// A contact particle has two lists: that in use, and the one before, from which lives are taken over. Where one starts;
// there its length stands.
uint listOf(uint c, uint parity) { return (2 * c + parity) * (1 + parameters.mostBlocks); }
/// Where pair j of a list is.
uint entryOf(uint list, uint j) { return lists[list + 1 + j / kListBlock] * kListBlock + j % kListBlock; }
/// The same, pair after pair: a block is looked up once.
uint nextEntry(uint list, uint j, uint entry) { return j % kListBlock == 0 ? entryOf(list, j) : entry + 1; }
uint lifeOf(uint parity, uint entry) { return parity * parameters.blockCount * kListBlock + entry; }

#endif
