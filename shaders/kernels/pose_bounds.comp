// The bounding box of all points; each invocation takes every n-th of them. Floats are compared as integers
// with the same order: bits of positive floats are put above those of negative ones, whose order is reversed.
#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "layout/pose.h"

layout(local_size_x_id = kSpecGroupSize) in;

layout(set = 0, binding = kBindPosePoints) readonly buffer Points { uvec4 points[]; };
layout(set = 0, binding = kBindPoseBounds) buffer Bounds { PoseBounds bounds; };
layout(push_constant) uniform Parameters { PoseParameters parameters; };

uvec3 ordered(uvec3 bits) {
  uvec3 isBelow = bits >> 31u;
  return bits ^ (isBelow * 0x7fffffffu + 0x80000000u);
}

void main() {
  uint stride = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uvec3 high = uvec3(0), low = uvec3(0);
  for (uint i = gl_GlobalInvocationID.x; i < parameters.count; i += stride) {
    uvec3 x = ordered(points[i].xyz);
    high = max(high, x);
    low = max(low, ~x);
  }
  [[unroll]] for (uint axis = 0; axis < 3; ++axis) {
    atomicMax(bounds.high[axis], high[axis]);
    atomicMax(bounds.low[axis], low[axis]);
  }
}
