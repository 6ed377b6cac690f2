// Force fields on the particles of this lane's run. Included by bodies/run_pulls.glsl.
#ifndef RINGLET_RUN_FIELDS
#define RINGLET_RUN_FIELDS

#include "bodies/run_pulled.glsl"
#include "equations/force_field.glsl"
#include "maths/quaternion.glsl"
#include "shared/field_buffers.glsl"
#include "shared/strand_run.glsl"

// The grid's value, trilinear between nodes; 0 outside the grid.
vec3 fieldGrid(StepField field, vec3 x) {
  vec3 g = rotate(conjugate(field.rotation), x - field.place) / field.cell;
  uvec3 nodes = uvec3(field.nodes[0], field.nodes[1], field.nodes[2]);
  vec3 last = vec3(nodes) - 1.0;
  bool outside = any(lessThan(g, vec3(0))) || any(greaterThan(g, last));
  uvec3 at = uvec3(clamp(g, vec3(0), max(last - 1.0, vec3(0))));
  vec3 t = clamp(g - vec3(at), 0.0, 1.0);
  vec3 sum = vec3(0);
  [[unroll]] for (uint c = 0; c < 8; ++c) {
    uvec3 corner = uvec3(c & 1u, c >> 1 & 1u, c >> 2);
    uvec3 node = min(at + corner, nodes - 1);
    vec3 share = mix(1.0 - t, t, vec3(corner));
    sum += share.x * share.y * share.z * fieldNode(field.firstNode + (node.z * nodes.y + node.y) * nodes.x + node.x);
  }
  return outside ? vec3(0) : rotate(field.rotation, field.gridShare * sum);
}

// Uses positions at the step's start.
void feelFields(uint step) {
  uint f = 0;
  if (numbers.fieldCount > 0) do {
    StepField field = stepField(step * numbers.fieldCount + f);
    RINGLET_OVER_RUN for (int k = 0; k < runEnd; ++k) {
      vec3 q = fieldArm(field, p[k]);
      vec3 F = fieldStrength(field, q);
      if (field.nodes[0] > 0) F += fieldGrid(field, p[k]);
      float m = isParticle(k) ? restEdge[k].x : 0.0;
      pulled[k] += m * fieldPull(field, F, fieldWeight(field, length(q)), stepSeconds());
    }
  } while (++f < numbers.fieldCount);
}

#endif
