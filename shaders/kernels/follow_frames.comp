// The frames along every guide's core, transported from the root without twist, and the guide's curl relative
// to them. Mirrored by reference/follow_guide.h.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "equations/frame.glsl"
#include "shared/follow_buffers.glsl"

layout(set = 0, binding = kBindCores) readonly buffer Cores { vec4 cores[]; };
layout(set = 0, binding = kBindCoreFrames) writeonly buffer CoreFrames { vec4 coreFrames[]; };
layout(set = 0, binding = kBindCurls) writeonly buffer Curls { vec4 curls[]; };

vec3 coreAt(uint i) { return (kTexels ? vectorAt(coreTexels, i) : cores[i]).xyz; }

void main() {
  uint g = gl_GlobalInvocationID.x;
  if (g >= parameters.count) return;
  FollowGuide guide = followGuide(g);
  uint last = guide.firstParticle + guide.particleCount - 1;
  vec4 frame = multiply(parameters.head, guide.restFrame);
  vec3 tangent = rotate(frame, vec3(0, 0, 1));
  uint i = guide.firstParticle;
  vec3 before = coreAt(i);
  vec3 here = before;
  do {
    vec3 next = coreAt(min(i + 1, last));
    vec3 along = (beginsPiece(min(i + 1, last)) ? here : next) - (beginsPiece(i) ? here : before);
    vec3 turnedTo = dot(along, along) > 0.0 ? normalize(along) : tangent;
    frame = renormalized(turned(smallestTurn(tangent, turnedTo), frame));
    tangent = turnedTo;
    coreFrames[i] = frame;
    curls[i] = vec4(rotate(conjugate(frame), guidePoint(i) - here), 0);
    before = here;
    here = next;
  } while (++i <= last);
}
