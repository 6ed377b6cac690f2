// Probe of `ringlet conform`: values after a loop in which invocations make different numbers of turns. No
// kernel of Ringlet uses forms 0 and 2, which some drivers get wrong; all rely on forms 1 and 3.
// results, n being the number of invocations, four rows of n:
//   0  a sum over loads, added by ?:                     (SwiftShader: lanes that are done add 1)
//   1  the same, added in an if
//   2  the last value of a nested loop, computed anew in every turn
//   3  the same, carried from turn to turn, and set in an if
#version 450

layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };  // n numbers of turns, then 64 values
layout(std430, set = 0, binding = 1) writeonly buffer Results { uint results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint n = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  uint turns = values[i];

  uint sum = 0;
  uint turn = 0;
  do {
    sum += values[n + turn] < 5 ? 1 : 0;
  } while (++turn < turns);
  results[i] = sum;

  sum = 0;
  turn = 0;
  do {
    if (values[n + turn] < 5) ++sum;
  } while (++turn < turns);
  results[n + i] = sum;

  // The largest value of some neighbours, repeated until it is large enough.
  uint last;
  turn = 0;
  do {
    last = 0;
    uint k = 0;
    do {
      last = max(last, values[n + (turn + k) % 64]);
    } while (++k <= (i + turn) % 3);
  } while (++turn < turns && last < 50);
  results[2 * n + i] = last;

  uint kept = 0;
  bool isDone = false;
  turn = 0;
  do {
    uint largest = 0;
    uint k = 0;
    do {
      if (values[n + (turn + k) % 64] > largest) largest = values[n + (turn + k) % 64];
    } while (++k <= (i + turn) % 3);
    kept = isDone ? kept : largest;
    isDone = isDone || largest >= 50 || turn + 1 >= turns;
    ++turn;
  } while (!isDone);
  results[3 * n + i] = kept;
}
