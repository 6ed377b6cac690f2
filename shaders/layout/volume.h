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
RINGLET_CONSTANT uint kBindVolumeBrought = 6;     // VolumeBrought[volume particles]
RINGLET_CONSTANT uint kBindVolumeCells = 7;       // uint: see cellCount and the functions after it in
                                                  // shared/volume_buffers.glsl
RINGLET_CONSTANT uint kBindVolumeParcels = 8;     // VolumeParcel[volume particles], sorted by cell, in any
                                                  // order within one
RINGLET_CONSTANT uint kBindVolumeNodes = 9;       // vec4[nodes]: xyz: mean of a [m/s]; w: density [kg/m^3]
RINGLET_CONSTANT uint kBindVolumeAdded = 10;      // vec4[particles]: see kBindAddedByVolume
RINGLET_CONSTANT uint kBindVolumeControl = 11;    // VolumeControl
RINGLET_CONSTANT uint kBindVolumeHalt = 12;       // ContactControl
RINGLET_CONSTANT uint kBindVolumeLocated = 13;    // uvec4[volume particles]: xyz: place in units of cells,
                                                  // bits of floats; w: index of its parcel
RINGLET_CONSTANT uint kBindVolumeSums = 14;       // int: if strands are divided among devices, sums at nodes,
                                                  // see nodeSum and the functions after it in
                                                  // shared/volume_buffers.glsl
RINGLET_CONSTANT uint kBindVolumeCornerSums = 27;  // ivec4: see cornerSum there
RINGLET_CONSTANT uint kVolumeBindingCount = 16;
// Some of them also as texels (shared/texels.glsl):
RINGLET_CONSTANT uint kBindVolumePositionTexels = 15;
RINGLET_CONSTANT uint kBindVolumeVelocityTexels = 16;
RINGLET_CONSTANT uint kBindVolumeSolvedTexels = 17;
RINGLET_CONSTANT uint kBindVolumeParticleTexels = 18;  // 2 a volume particle
RINGLET_CONSTANT uint kBindVolumeStateTexels = 19;  // 3 a volume particle
RINGLET_CONSTANT uint kBindVolumeBroughtTexels = 20;  // 4 a volume particle
RINGLET_CONSTANT uint kBindVolumeParcelTexels = 21;   // 4 a volume particle
RINGLET_CONSTANT uint kBindVolumeNodeTexels = 22;
RINGLET_CONSTANT uint kBindVolumeLocatedTexels = 23;
RINGLET_CONSTANT uint kBindVolumeCellTexels = 24;  // four numbers each
RINGLET_CONSTANT uint kBindVolumeAddedTexels = 25;
RINGLET_CONSTANT uint kBindVolumeNumbers = 26;  // uniform: VolumeNumbers
RINGLET_CONSTANT uint kBindVolumeCornerSumTexels = 28;
RINGLET_CONSTANT uint kVolumeTexelBindingCount = 12;

// Constant for each volume particle, in device order: it represents some consecutive particles of a strand by
// their mean. Of these, `pinned` at the start follow the head, and those from `present` on have fallen.
struct VolumeParticle {
  uint first;  // particle
  uint count;
  uint present;
  uint pinned;
  float mass;             // total mass of those present [kg]
  float ownDensity;       // of its own strand at its place at rest [kg/m^3]
  float inverseMassUnit;  // 1 / the strand's mass unit [1/kg]
  float unused;
};

// The state that a volume particle keeps from step to step.
struct VolumeState {
  vec3 displacement;  // s, which decays, in the head's frame [m]
  float density;      // at the particle [kg/m^3]
  vec3 place;         // in the head's frame at the step's start [m]
  float countedMass;  // the part of its mass that counts in the step, m o [kg]
  vec3 predicted;     // v^0 [m/s]
  float isKnown;      // 1: all of this is known; 0: the hair was just placed
};

// The contribution of a volume particle to the grid in an iteration. Sums at nodes are sums of integers and
// so do not depend on the order of their terms; the largest possible term is kVolumeUnits. Terms are rounded
// to the nearest integer: rounding towards 0 would hold hair back, by 1e-5 m in half a second.
RINGLET_CONSTANT uint kVolumeUnits = 1u << 30;
struct VolumeParcel {
  vec4 rate;       // xyz: g a, of unit unitsPerGain / mostRate; w: g, of unit unitsPerGain (VolumeNumbers)
  vec4 place;      // xyz: in units of cells, from the box's first node; w: of C's column along z the first
  vec4 gradientX;  // xyz: C's column along x [1/s]; w: of that along z the second
  vec4 gradientY;  // likewise along y, and the third
};

// What a step that sorts brings to the parcels before these have places.
struct VolumeBrought {
  vec4 rate;       // as VolumeParcel's, of the first iterate
  vec4 gradientX;  // columns of C
  vec4 gradientY;
  vec4 gradientZ;
};

// Bins of cells by the number of parcels in them.
RINGLET_CONSTANT uint kCellBins = 64;
RINGLET_CONSTANT uint kNoSlot = 0xffffffffu;  // of a cell without parcels
// Records of 16 bytes in the buffer of corner sums per cell.
RINGLET_CONSTANT uint kCornerSumsOfCell = 24;

// The box of cells around all volume particles, and the state that the volume's kernels share.
struct VolumeControl {
  uint indirectBlocks[3];  // workgroups over blocks of cells in a step that sorts; none if the frame has
                           // halted
  uint cellCount;          // number of cells in the box, which has as many nodes
  uint indirectNodes[3];   // workgroups over nodes
  uint cut;                // how often a particle's a exceeded mostRate, over all iterations so far
  int least[3];            // lowest cell with a particle, as found so far in this step
  float cellsPerMetre;
  int greatest[3];
  float cell;              // [m]
  int low[3];              // the box's first cell
  uint largest;            // largest component of a so far, as a share of mostRate, as bits
  uint size[3];            // number of cells along each axis
  float largestCell;       // largest cell size so far [m]
  uint finished;           // workgroups of this dispatch that are done (shared/last_group.glsl)
  uint indirectFilled[3];  // workgroups over cells with parcels
  uint filled;             // number of these
  uint indirectReached[3];  // workgroups over nodes with parcels around them
  uint reached;             // number of these
};

// Push constants of a dispatch.
struct VolumeParameters {
  uint step;   // of the frame
  uint sorts;  // 1: in the first iteration of a step that sorts particles into cells; else they keep their cells
};

// Settings, and sizes of the buffers.
struct VolumeNumbers {
  uint count;         // volume particles
  uint cellCapacity;  // number of cells in the buffers, a multiple of kBucketBlock
  float seconds;      // T
  float cell;         // h [m]
  float drag;         // lambda [1/s]
  float stiffness;    // k [1/s^2]
  float kept;         // share of a displacement that is left a step later, exp(-T / tau)
  float warmth;       // volumeWarmth
  float gradient;     // kVolumeGradient
  float rim;          // kVolumeRim
  float mostRate;      // largest component of a that the sums can hold, volumeMostRate [m/s]
  float unitsPerGain;  // kVolumeUnits per largest g [1/kg]
  float unitsPerMass;  // kVolumeUnits per largest mass [1/kg]
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
