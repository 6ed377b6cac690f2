// Hair as a volume: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_VOLUME
#define RINGLET_LAYOUT_VOLUME

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the volume's kernels, all in set 0.
RINGLET_CONSTANT uint kBindVolumePositions = 0;   // vec4[particles]: as above
RINGLET_CONSTANT uint kBindVolumeVelocities = 1;  // vec4[particles]: as above
RINGLET_CONSTANT uint kBindVolumeSolved = 2;      // vec4[particles]: v^k
RINGLET_CONSTANT uint kBindVolumePoses = 3;       // uniform: StepPose[kMaxStepPoses]
RINGLET_CONSTANT uint kBindVolumeParticles = 4;   // VolumeParticle[volume particles]
RINGLET_CONSTANT uint kBindVolumeStates = 5;      // VolumeState[volume particles]
RINGLET_CONSTANT uint kBindVolumeBrought = 6;     // vec4[volume particles]: as VolumeParcel's rate, first iterate
RINGLET_CONSTANT uint kBindVolumeCells = 7;       // uint: see cellCount and its like in shared/volume_buffers.glsl
RINGLET_CONSTANT uint kBindVolumeParcels = 8;     // VolumeParcel[volume particles], by cell; within one in any order
RINGLET_CONSTANT uint kBindVolumeNodes = 9;       // vec4[nodes]: xyz: mean of a [m/s]; w: density [kg/m^3]
RINGLET_CONSTANT uint kBindVolumeAdded = 10;      // vec4[particles]: see kBindAddedByVolume
RINGLET_CONSTANT uint kBindVolumeControl = 11;    // VolumeControl
RINGLET_CONSTANT uint kBindVolumeHalt = 12;       // ContactControl
RINGLET_CONSTANT uint kBindVolumeLocated = 13;    // uvec4[volume particles]: xyz: place in cells, bits of floats; w:
                                                  // which parcel
RINGLET_CONSTANT uint kBindVolumeSums = 14;       // int: where strands are divided, sums at nodes, see nodeSum and its
                                                  // like in shared/volume_buffers.glsl
RINGLET_CONSTANT uint kVolumeBindingCount = 15;
// And as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindVolumePositionTexels = 15;
RINGLET_CONSTANT uint kBindVolumeVelocityTexels = 16;
RINGLET_CONSTANT uint kBindVolumeSolvedTexels = 17;
RINGLET_CONSTANT uint kBindVolumeParticleTexels = 18;
RINGLET_CONSTANT uint kBindVolumeStateTexels = 19;  // 3 a volume particle
RINGLET_CONSTANT uint kBindVolumeBroughtTexels = 20;
RINGLET_CONSTANT uint kBindVolumeParcelTexels = 21;  // 2 a volume particle
RINGLET_CONSTANT uint kBindVolumeNodeTexels = 22;
RINGLET_CONSTANT uint kBindVolumeLocatedTexels = 23;
RINGLET_CONSTANT uint kBindVolumeCellTexels = 24;  // four numbers each
RINGLET_CONSTANT uint kBindVolumeAddedTexels = 25;
RINGLET_CONSTANT uint kBindVolumeNumbers = 26;  // uniform: VolumeNumbers
RINGLET_CONSTANT uint kVolumeTexelBindingCount = 11;

// Constant per volume particle, in device order: one in so many of a strand that meets others as a volume, for as many.
struct VolumeParticle {
  uint particle;
  float mass;             // of those it stands for [kg]
  float ownDensity;       // of its own strand at its place at rest [kg/m^3]
  float inverseMassUnit;  // 1 / the strand's mass unit [1/kg]; 0 for a particle that follows the head
};

// What it remembers from step to step.
struct VolumeState {
  vec3 displacement;  // fading, s, in the head's frame [m]
  float density;      // about it [kg/m^3]
  vec3 place;         // in the head's frame at the step's start [m]
  float countedMass;  // what of its mass counts in the step, m o [kg]
  vec3 predicted;     // v^0 [m/s]
  float isKnown;      // 1 where all this is known, 0 where the hair was just put there
};

// What it brings to the grid in an iteration. Sums at nodes are of integers, and so do not depend on the order of their
// terms: the largest possible term is kVolumeUnits. Terms are rounded to the nearest integer: towards 0 they would hold
// hair back, by 1e-5 m in half a second.
RINGLET_CONSTANT uint kVolumeUnits = 1u << 30;
struct VolumeParcel {
  vec4 rate;   // xyz: g a, of unit unitsPerGain / mostRate; w: g, of unit unitsPerGain (VolumeNumbers)
  vec3 place;  // in cells, from the box's first node
  float mass;  // of unit unitsPerMass
};

// The box of cells about all such particles, and what kernels tell each other.
struct VolumeControl {
  uint indirectBlocks[3];  // workgroups over blocks of cells of a sort; none where everything has halted
  uint cellCount;          // of the box, which has as many nodes
  uint indirectNodes[3];   // over nodes
  uint cut;                // how often a particle's a was larger than mostRate, over all iterations so far
  int least[3];            // of the cells particles are in, as found so far in this step
  float cellsPerMetre;
  int greatest[3];
  float cell;              // [m]
  int low[3];              // the box's first cell
  uint largest;            // component of a so far, as a share of mostRate, as bits
  uint size[3];            // and how many there are along each axis
  float largestCell;       // so far [m]
  uint finished;           // workgroups of this dispatch (shared/last_group.glsl)
};

// Push constants: what a dispatch is of.
struct VolumeParameters {
  uint step;   // of the frame
  uint sorts;  // 1: this step puts particles into cells; 0: they stay where they were
};

// Settings, and what there is room for.
struct VolumeNumbers {
  uint count;         // volume particles
  uint cellCapacity;  // cells there is room for, a multiple of kBucketBlock
  float seconds;      // T
  float cell;         // h [m]
  float drag;         // lambda [1/s]
  float stiffness;    // k [1/s^2]
  float kept;         // share of a displacement that is still known a step later, exp(-T / tau)
  float warmth;       // kVolumeWarmth
  float mostRate;      // largest component of a that the sums have room for, volumeMostRate [m/s]
  float unitsPerGain;  // kVolumeUnits per largest g [1/kg]
  float unitsPerMass;  // kVolumeUnits per largest mass [1/kg]
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
