// Probe of `ringlet conform`: a loop of many turns. lavapipe 22.3 ends all loops of an invocation after 65,535 turns.
// results[i]: state of a linear congruential generator, started from the invocation's index, after this many
// turns.
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 1) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Push { uint turns; };

void main() {
  uint x = gl_GlobalInvocationID.x;
  uint turn = 0;
  do {
    x = 1664525 * x + 1013904223;
  } while (++turn < turns);
  results[gl_GlobalInvocationID.x] = x;
}
