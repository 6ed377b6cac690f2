// Orders the cells of the volume's grid by the number of parcels in them, 1 of 2: counts cells by bin of that number,
// and the last workgroup computes where each bin begins. Invocations that run in lockstep then have sums of about the
// same length, and cells without parcels none. Which cell comes first within a bin is arbitrary; no result depends on
// it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/last_group.glsl"
#include "shared/volume_buffers.glsl"

shared uint counts[kCellBins];

void main() {
  readBox();
  uint cell = gl_GlobalInvocationID.x;
  uint count = halt.isHalted == 0 && cell < box.cellCount ? startOf(cell + 1) - startOf(cell) : 0;
  if (count > 0) atomicAdd(cells[cellBin(binOf(count))], 1);
  if (!isLastGroup()) return;
  uint bin = gl_LocalInvocationID.x;
  if (bin < kCellBins) counts[bin] = atomicOr(cells[cellBin(bin)], 0);
  barrier();
  if (bin >= kCellBins) return;
  uint before = 0;
  for (uint other = 0; other < bin; ++other) before += counts[other];
  cells[cellBin(bin)] = before;
  if (bin + 1 < kCellBins) return;
  uint filled = before + counts[bin];
  control.filled = filled;
  control.reached = 0;
  uint groups = groupsOf(kForGpu ? 8 * filled : filled);
  control.indirectFilled[0] = (groups + kDealt - 1) / kDealt * kDealt;
}
