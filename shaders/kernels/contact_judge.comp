// If strands are divided among devices: evaluates the samples of all parts; one invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/contact_decision.glsl"

void main() {
  if (gl_GlobalInvocationID.x == 0) judgeLists();
}
