// The share of the sky that is visible from each cell: the attenuation in 14 directions, through the hair
// around it. Steps grow with distance.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/picture.glsl"

layout(set = 0, binding = kBindDensity) readonly buffer Density { uint density[]; };
layout(set = 0, binding = kBindOpenness) writeonly buffer Openness { float openness[]; };

const float kFirst = 0.7;   // first step [cells]
const float kGrows = 1.35;  // factor from step to step
const int kSteps = 7;
const float kDims = 0.35;   // attenuation of the sky by a hair

void main() {
  uint n = picture.densityCells;
  uint id = gl_GlobalInvocationID.x;
  if (id >= n * n * n) return;
  vec3 middle = vec3(id % n, id / n % n, id / (n * n)) + 0.5;
  float scale = 1.0 / (picture.fixedPoint * picture.densityBox.w * picture.densityBox.w);
  float seen = 0.0;
  float most = 0.0;
  int k = 0;
  do {
    // The axes in both directions, and the diagonals of the cube.
    vec3 axis = vec3(k % 3 == 0, k % 3 == 1, k % 3 == 2) * (k < 3 ? 1.0 : -1.0);
    vec3 diagonal = 0.57735027 * (2.0 * vec3(k & 1, k >> 1 & 1, k >> 2 & 1) - 1.0);
    vec3 way = k < 6 ? axis : diagonal;
    float hairs = 0.0;
    float reach = kFirst;
    float step = 1.0;
    for (int s = 0; s < kSteps; ++s) {
      vec3 at = middle + reach * way;
      if (all(greaterThanEqual(at, vec3(0))) && all(lessThan(at, vec3(n)))) {
        uvec3 cell = uvec3(at);
        hairs += step * float(density[(cell.z * n + cell.y) * n + cell.x]);
      }
      reach += step;
      step *= kGrows;
    }
    float weight = 0.7 + 0.3 * way.y;
    seen += weight * exp(-kDims * scale * hairs);
    most += weight;
  } while (++k < 14);
  openness[id] = seen / most;
}
