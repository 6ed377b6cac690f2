// Collects what is visible in each pixel: samples of hair go into a list, to be shaded; pixels in which
// bodies are visible go into another, each with one of their triangles. In a preview one sample of a pixel's
// hair stands for all.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"
#include "shared/sample_texels.glsl"

layout(set = 0, binding = kBindSeen) writeonly buffer Seen { uint seen[]; };
layout(set = 0, binding = kBindSeenCounts) buffer Counts { SeenCounts counts; };
layout(set = 0, binding = kBindSeenSolids) writeonly buffer SeenSolids { uvec2 seenSolids[]; };

void main() {
  uint pixel = gl_GlobalInvocationID.x;
  if (pixel >= picture.width * band.rowCount) return;
  uint side = picture.side;
  uint stride = side * picture.width;
  uint row = pixel / picture.width;
  uint first = row * side * stride + (pixel - row * picture.width) * side;
  uint end = first + side * stride;
  uint hairs = 0;
  uint solid = 0;    // a visible triangle
  uint solidAt = 0;  // its sample within the pixel
  uint marks = 0;    // a bit for each sample of hair
  uint index = 0;      // index of the sample
  for (uint at = first; at < end; at += stride) {
    for (uint k = 0; k < side; ++k) {
      uint what = sampleAt(at + k).x;
      bool isHair = what != 0 && (what & kSolid) == 0;
      marks = marks << 1 | uint(isHair);
      hairs += uint(isHair);
      solid = (what & kSolid) != 0 ? what : solid;
      solidAt = (what & kSolid) != 0 ? index : solidAt;
      ++index;
    }
  }
  if (solid != 0) {
    uint k = atomicAdd(counts.solids, 1);
    if (k % gl_WorkGroupSize.x == 0) atomicAdd(counts.indirectSolids[0], 1);
    seenSolids[k] = uvec2(pixel << 4 | solidAt, (solid & ~kSolid) - 1);
  }
#ifdef RINGLET_PREVIEW
  marks &= ~marks + 1;
  hairs = min(hairs, 1);
#endif
  uint place = 0;
  if (hairs != 0) {
    place = atomicAdd(counts.hairs, hairs);
    atomicAdd(counts.indirectHairs[0], (place + hairs + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x -
                                           (place + gl_WorkGroupSize.x - 1) / gl_WorkGroupSize.x);
  }
  // The last sample has the lowest bit. The loop has one turn for each sample of hair: none for most pixels.
  while (marks != 0) {
    uint k = uint(findMSB(marks));
    marks ^= 1u << k;
    uint fromFirst = side * side - 1 - k;
    uint down = fromFirst / side;
    seen[place++] = first + down * stride + fromFirst - down * side;
  }
}
