// The rows that parts of divided hair exchange: binding numbers, push constants.
#ifndef RINGLET_LAYOUT_PARTS
#define RINGLET_LAYOUT_PARTS

#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of part_pack.comp and part_unpack.comp, in set 0.
RINGLET_CONSTANT uint kBindPartPositions = 0;   // vec4[particles]
RINGLET_CONSTANT uint kBindPartVelocities = 1;  // vec4[particles]
RINGLET_CONSTANT uint kBindPartSolved = 2;      // vec4[particles]
RINGLET_CONSTANT uint kBindPartParticles = 3;   // uint: the contact particles of the rows, peer by peer
RINGLET_CONSTANT uint kBindPartRows = 4;        // float: the rows, each with the number of floats below

// A row at a step's start: position, velocity, v^0; a row after a solve: v^k.
RINGLET_CONSTANT uint kFloatsOfStepRow = 9;
RINGLET_CONSTANT uint kFloatsOfSolveRow = 3;

struct PartParameters {
  uint count;   // rows
  uint isStep;  // 1: rows at a step's start; 0: rows after a solve
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
