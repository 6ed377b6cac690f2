// The buffers and parameters of the volume's kernels (layout/volume.h).
#ifndef RINGLET_VOLUME_BUFFERS
#define RINGLET_VOLUME_BUFFERS

#include "equations/volume.glsl"
#include "maths/quaternion.glsl"
#include "layout/contacts.h"
#include "layout/strands.h"
#include "layout/volume.h"
#include "shared/texels.glsl"
#include "shared/workgroup.glsl"


layout(set = 0, binding = kBindVolumePositions) readonly buffer Positions { vec4 positions[]; };
layout(set = 0, binding = kBindVolumeVelocities) readonly buffer Velocities { vec4 velocities[]; };
layout(set = 0, binding = kBindVolumeSolved) readonly buffer Solved { vec4 solved[]; };
layout(set = 0, binding = kBindVolumePoses) uniform Poses { StepPose poses[kMaxStepPoses]; };
layout(set = 0, binding = kBindVolumeParticles) readonly buffer Particles { VolumeParticle particles[]; };
layout(set = 0, binding = kBindVolumeStates) buffer States { VolumeState states[]; };
layout(set = 0, binding = kBindVolumeBrought) buffer Brought { VolumeBrought brought[]; };
layout(set = 0, binding = kBindVolumeCells) buffer Cells { uint cells[]; };
layout(set = 0, binding = kBindVolumeParcels) buffer Parcels { VolumeParcel parcels[]; };
layout(set = 0, binding = kBindVolumeNodes) buffer Nodes { vec4 nodes[]; };
layout(set = 0, binding = kBindVolumeAdded) buffer AddedByVolume { vec4 addedByVolume[]; };
layout(set = 0, binding = kBindVolumeControl) buffer Control { VolumeControl control; };
layout(set = 0, binding = kBindVolumeHalt) buffer Halt { ContactControl halt; };
layout(set = 0, binding = kBindVolumeCornerSums) buffer CornerSums { ivec4 cornerSums[]; };
layout(set = 0, binding = kBindVolumeLocated) buffer Located { uvec4 located[]; };
layout(set = 0, binding = kBindVolumePositionTexels) uniform usamplerBuffer positionTexels;
layout(set = 0, binding = kBindVolumeVelocityTexels) uniform usamplerBuffer velocityTexels;
layout(set = 0, binding = kBindVolumeSolvedTexels) uniform usamplerBuffer solvedTexels;
layout(set = 0, binding = kBindVolumeParticleTexels) uniform usamplerBuffer particleTexels;
layout(set = 0, binding = kBindVolumeStateTexels) uniform usamplerBuffer stateTexels;
layout(set = 0, binding = kBindVolumeBroughtTexels) uniform usamplerBuffer broughtTexels;
layout(set = 0, binding = kBindVolumeParcelTexels) uniform usamplerBuffer parcelTexels;
layout(set = 0, binding = kBindVolumeNodeTexels) uniform usamplerBuffer nodeTexels;
layout(set = 0, binding = kBindVolumeLocatedTexels) uniform usamplerBuffer locatedTexels;
layout(set = 0, binding = kBindVolumeCellTexels) uniform usamplerBuffer cellTexels;
layout(set = 0, binding = kBindVolumeAddedTexels) uniform usamplerBuffer addedTexels;
layout(set = 0, binding = kBindVolumeCornerSumTexels) uniform usamplerBuffer cornerSumTexels;
layout(set = 0, binding = kBindVolumeSums) buffer Sums { int sums[]; };
layout(push_constant) uniform Parameters { VolumeParameters parameters; };
layout(set = 0, binding = kBindVolumeNumbers) uniform Numbers { VolumeNumbers numbers; };

layout(constant_id = kSpecDivided) const bool kDivided = false;  // other devices step some of the strands
layout(constant_id = kSpecForGpu) const bool kForGpu = false;

const uint kDealt = kForGpu ? 1 : 16;  // the workgroups of gather are a multiple of it

/// The box of cells, of VolumeControl. A number of a buffer that is one for all lanes is read at the top of main
/// (readBox): behind a branch a driver may read it lane by lane.
struct Box {
  ivec3 low;
  float cell, cellsPerMetre;
  uvec3 size;
  uint cellCount, filled, reached;
};
Box box;
void readBox() {
  box = Box(ivec3(control.low[0], control.low[1], control.low[2]), control.cell, control.cellsPerMetre,
            uvec3(control.size[0], control.size[1], control.size[2]), control.cellCount, control.filled,
            control.reached);
}

/// Finds the volume particle of this invocation; false if there is none.
bool findParticle(out uint i) {
  i = gl_GlobalInvocationID.x;
  return halt.isHalted == 0 && i < numbers.count;
}

// Accessors of records, as these were when the dispatch began.
vec3 positionOf(uint particle) { return kTexels ? vectorAt(positionTexels, particle).xyz : positions[particle].xyz; }
vec3 lastVelocityOf(uint particle) {
  return kTexels ? vectorAt(velocityTexels, particle).xyz : velocities[particle].xyz;
}
vec3 velocityOf(uint particle) { return kTexels ? vectorAt(solvedTexels, particle).xyz : solved[particle].xyz; }
vec4 addedTo(uint particle) { return kTexels ? vectorAt(addedTexels, particle) : addedByVolume[particle]; }
VolumeBrought broughtBy(uint i) {
  if (!kTexels) return brought[i];
  return VolumeBrought(vectorAt(broughtTexels, 4 * i), vectorAt(broughtTexels, 4 * i + 1),
                       vectorAt(broughtTexels, 4 * i + 2), vectorAt(broughtTexels, 4 * i + 3));
}
uvec4 locatedAt(uint i) { return kTexels ? recordAt(locatedTexels, i) : located[i]; }
vec4 nodeAt(uint node) { return kTexels ? vectorAt(nodeTexels, node) : nodes[node]; }
VolumeParticle volumeParticle(uint i) {
  if (!kTexels) return particles[i];
  uvec4 a = recordAt(particleTexels, 2 * i);
  vec4 b = vectorAt(particleTexels, 2 * i + 1);
  return VolumeParticle(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
VolumeParcel parcelAt(uint place) {
  if (!kTexels) return parcels[place];
  return VolumeParcel(vectorAt(parcelTexels, 4 * place), vectorAt(parcelTexels, 4 * place + 1),
                      vectorAt(parcelTexels, 4 * place + 2), vectorAt(parcelTexels, 4 * place + 3));
}
vec3 parcelPlace(uint place) {
  return kTexels ? vectorAt(parcelTexels, 4 * place + 1).xyz : parcels[place].place.xyz;
}
mat3 gradientOf(VolumeParcel parcel) {
  return mat3(parcel.gradientX.xyz, parcel.gradientY.xyz, vec3(parcel.place.w, parcel.gradientX.w, parcel.gradientY.w));
}
/// All of a parcel but its rate.
void setParcel(uint place, vec3 inCells, mat3 gradient) {
  parcels[place].place = vec4(inCells, gradient[2].x);
  parcels[place].gradientX = vec4(gradient[0], gradient[2].y);
  parcels[place].gradientY = vec4(gradient[1], gradient[2].z);
}
VolumeState volumeState(uint i) {
  if (!kTexels) return states[i];
  vec4 a = vectorAt(stateTexels, 3 * i), b = vectorAt(stateTexels, 3 * i + 1), c = vectorAt(stateTexels, 3 * i + 2);
  return VolumeState(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w);
}
vec3 displacementOf(uint i) { return kTexels ? vectorAt(stateTexels, 3 * i).xyz : states[i].displacement; }
vec3 placeOf(uint i) { return kTexels ? vectorAt(stateTexels, 3 * i + 1).xyz : states[i].place; }
float countedMassOf(uint i) { return kTexels ? vectorAt(stateTexels, 3 * i + 1).w : states[i].countedMass; }

/// The mean place [m] and velocity [m/s] of what a volume particle represents, at the step's start and of the
/// last iterate. `precise` as in placeInCells.
struct VolumeMotion {
  vec3 place, velocity;
};
VolumeMotion meanMotion(VolumeParticle self) {
  precise vec3 x = vec3(0), v = vec3(0);
  for (uint j = 0; j < self.present; ++j) {
    x += positionOf(self.first + j);
    v += velocityOf(self.first + j);
  }
  float count = max(float(self.present), 1.0);
  x /= count;
  v /= count;
  return VolumeMotion(x, v);
}

// Between world axes and the head's frame at the step's start; pose 0 is the frame's start.
vec3 inHeadFrame(vec3 x) { return rotate(conjugate(poses[parameters.step].rotation), x); }
vec3 inWorld(vec3 x) { return rotate(poses[parameters.step].rotation, x); }
/// Velocity at x of a rigid body that the head carries [m/s].
vec3 carriedVelocity(vec3 x) { return displacement(poses[parameters.step + 1].turn, x) / numbers.seconds; }

// The parts of the buffer of cells, one after another.
uint cellCount(uint cell) { return cell; }  // particles in a cell; 0 between two sorts
uint cellStart(uint cell) { return numbers.cellCapacity + cell; }  // place of a cell's first particle
uint cellSum(uint block) { return 2 * numbers.cellCapacity + block; }  // sum before a block of cells
uint cellOf(uint i) { return cellSum(numbers.cellCapacity / kBucketBlock) + i; }
uint cellRank(uint i) { return cellOf(numbers.count) + i; }  // rank in its cell, in arbitrary order
uint parcelMass(uint place) { return cellRank(numbers.count) + place; }  // bits of a float, of unit unitsPerMass
uint cellBin(uint bin) { return parcelMass(numbers.count) + bin; }  // number of cells in a bin, then where it begins
uint filledCell(uint slot) { return cellBin(kCellBins) + slot; }  // the cells with parcels, bin by bin
uint slotOf(uint cell) { return filledCell(numbers.cellCapacity) + cell; }  // the slot of a cell there, or kNoSlot
uint reachedNode(uint k) { return slotOf(numbers.cellCapacity) + k; }  // the nodes with parcels around them

/// Cells with so many parcels are in one bin: four bins from a power of two to the next.
uint binOf(uint count) { return min((floatBitsToUint(float(count)) >> 21) - (127u << 2), kCellBins - 1); }

// Sums over the parcels of a cell at one of its corners, by its slot. cornerSum: of the parcels' rates, high and low
// (maths/split_sum.glsl) one after another; cornerMass: x high, y low.
uint cornerSum(uint slot, uint corner) { return kCornerSumsOfCell * slot + 2 * corner; }
uint cornerMass(uint slot, uint corner) { return kCornerSumsOfCell * slot + 16 + corner; }
ivec4 cornerSumAt(uint at) { return kTexels ? ivec4(recordAt(cornerSumTexels, at)) : cornerSums[at]; }

/// A number of that buffer as it was when the dispatch began.
uint cellNumber(uint at) { return kTexels ? recordAt(cellTexels, at / 4)[at % 4] : cells[at]; }
uint startOf(uint cell) { return cellNumber(cellStart(cell)); }

const float kFarthestCell = 1e6;  // from the head [cells]; farther places and NaN are clamped to it
ivec3 cellAt(vec3 place, float cellsPerMetre) {
  return ivec3(clamp(floor(place * cellsPerMetre), vec3(-kFarthestCell), vec3(kFarthestCell)));
}
/// The box of cells that the step's particles reached before this invocation; it only spares atomics.
struct Reach {
  ivec3 least, greatest;
};
Reach readReach() {
  return Reach(ivec3(control.least[0], control.least[1], control.least[2]),
               ivec3(control.greatest[0], control.greatest[1], control.greatest[2]));
}
/// Extends the step's box of cells to the cell of a place.
void reachTo(vec3 place, Reach seen) {
  ivec3 cell = cellAt(place, 1.0 / numbers.cell);
  for (int axis = 0; axis < 3; ++axis) {
    // Most cells lie inside the box so far, and a read costs less than an atomic.
    if (cell[axis] < seen.least[axis]) atomicMin(control.least[axis], cell[axis]);
    if (cell[axis] > seen.greatest[axis]) atomicMax(control.greatest[axis], cell[axis]);
  }
}
/// `precise` gives the same bits with and without texels: drivers fuse multiplication and subtraction in one
/// case and not in the other.
vec3 placeInCells(vec3 place) {
  precise vec3 inCells = place * box.cellsPerMetre - vec3(box.low);
  return inCells;
}
/// The cell of a place, which is given in units of cells. The last cell along each axis only provides nodes.
uvec3 cellInBox(vec3 inCells) { return uvec3(clamp(floor(inCells), vec3(0), vec3(box.size) - 2.0)); }
uvec3 cornerOf(uvec3 cell, uint corner) { return cell + uvec3(corner & 1, corner >> 1 & 1, corner >> 2); }
/// a / b; exact for a < 2^21, and faster than an integer division.
uint quotient(uint a, uint b) { return uint((float(a) + 0.5) / float(b)); }
uvec3 placeOfCell(uint cell) {
  uint row = quotient(cell, box.size.x);
  uint z = quotient(row, box.size.y);
  return uvec3(cell - row * box.size.x, row - z * box.size.y, z);
}
uint cellIndex(uvec3 cell) { return (cell.z * box.size.y + cell.y) * box.size.x + cell.x; }

// If strands are divided among devices, the parts of the buffer of sums: for each node eight numbers from
// gather, then for each node two of mass, high and low (maths/split_sum.glsl).
uint nodeSum(uint node) { return 8 * node; }
uint densitySum(uint node) { return 8 * numbers.cellCapacity + 2 * node; }
/// The mean of a at a node [m/s], from sums of terms in integer units.
vec3 meanRate(vec4 sum) { return sum.w > 0.0 ? numbers.mostRate * sum.xyz / sum.w : vec3(0); }
/// The density at a node [kg/m^3], from a sum in integer units.
float densityFrom(float units) {
  return units / numbers.unitsPerMass * box.cellsPerMetre * box.cellsPerMetre * box.cellsPerMetre;
}

/// kappa: g is kappa times the mass m o.
float gain() { return volumeGain(numbers.drag, numbers.stiffness, numbers.seconds); }
/// The contribution to the nodes of a mass m o at x with velocity v, as VolumeParcel's rate. An a that is too
/// large for the sums is cut off and counted. seen: control.largest when the dispatch began.
vec4 rateFrom(float mass, vec3 v, vec3 x, vec3 s, uint seen) {
  vec3 w = inHeadFrame(v - carriedVelocity(x));
  vec3 share =
      volumeRate(numbers.drag, numbers.stiffness, numbers.seconds, w, s) / numbers.mostRate;
  vec3 size = abs(share);
  float largest = max(size.x, max(size.y, size.z));
  // Bits of positive floats have the same order as the floats. Fallen hair has no mass here.
  if (mass > 0.0 && floatBitsToUint(largest) > seen) atomicMax(control.largest, floatBitsToUint(largest));
  if (mass > 0.0 && largest > 1.0) atomicAdd(control.cut, 1);
  float units = numbers.unitsPerGain * mass * gain();
  return vec4(units * clamp(share, -1.0, 1.0), units);
}

uint groupsOf(uint invocations) { return (invocations + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x; }

// Required by shared/last_group.glsl.
uint addFinished() { return atomicAdd(control.finished, 1); }
void clearFinished() { control.finished = 0; }

#endif
