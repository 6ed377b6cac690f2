// Sets the box of cells around all particles, in a step that sorts them into cells; one invocation. If hair
// extends farther than the buffer has cells for, cells become larger, which is reported to the host.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/volume_buffers.glsl"

void main() {
  if (gl_GlobalInvocationID.x > 0) return;
  control.indirectBlocks[0] = 0;
  if (halt.isHalted != 0) return;
  ivec3 least = ivec3(control.least[0], control.least[1], control.least[2]);
  ivec3 greatest = ivec3(control.greatest[0], control.greatest[1], control.greatest[2]);
  float cell = numbers.cell;
  uvec3 size = uvec3(0);
  bool fits = false;
  do {
    size = uvec3(greatest - least) + 2;  // one more along each axis, for the nodes
    // At least one cell stays free, since the end of a cell is the start of the next.
    fits = float(size.x) * float(size.y) * float(size.z) < 0.999 * float(numbers.cellCapacity);
    if (!fits) {
      least >>= 1;
      greatest >>= 1;
      cell *= 2.0;
    }
  } while (!fits);
  control.cellCount = size.x * size.y * size.z;
  control.cell = cell;
  control.cellsPerMetre = 1.0 / cell;
  control.largestCell = max(control.largestCell, cell);
  for (int axis = 0; axis < 3; ++axis) {
    control.low[axis] = least[axis];
    control.size[axis] = size[axis];
    control.least[axis] = 0x7fffffff;
    control.greatest[axis] = -0x7fffffff;
    control.indirectBlocks[axis] = 1;
    control.indirectNodes[axis] = 1;
    control.indirectFilled[axis] = 1;
    control.indirectReached[axis] = 1;
  }
  control.indirectBlocks[0] = control.cellCount / kBucketBlock + 1;
  for (uint bin = 0; bin < kCellBins; ++bin) cells[cellBin(bin)] = 0;
  control.indirectNodes[0] = groupsOf(control.cellCount);
}
