// Draws triangles of bodies onto the samples of a picture. An invocation has one triangle and kSolidRows rows
// of samples, and in each row fills the samples between the triangle's edges.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/solids.glsl"
#include "shared/visible.glsl"

// Where a row at this height intersects the line from a to b: widens the range (least, greatest).
vec2 cutBy(vec2 range, vec2 a, vec2 b, float height) {
  if ((a.y <= height) == (b.y <= height)) return range;
  float x = a.x + (b.x - a.x) * ((height - a.y) / (b.y - a.y));
  return vec2(min(range.x, x), max(range.y, x));
}

void main() {
  uvec2 size = bandSize();
  uint blocks = (size.y + kSolidRows - 1) / kSolidRows;
  uint t = gl_GlobalInvocationID.x / blocks;
  if (t >= picture.triangleCount) return;
  uint firstRow = (gl_GlobalInvocationID.x - t * blocks) * kSolidRows;
  uvec3 corners = solidTriangle(t);
  vec3 a = inView(solidPosition(corners.x).xyz);
  vec3 b = inView(solidPosition(corners.y).xyz);
  vec3 c = inView(solidPosition(corners.z).xyz);
  if (min(min(a.z, b.z), c.z) < picture.near) return;
  vec2 p = inSamples(a);
  vec2 q = inSamples(b);
  vec2 r = inSamples(c);

  // Nearness is linear over the picture: n = n_a + slope . (x - p).
  vec2 u = q - p;
  vec2 v = r - p;
  float area = u.x * v.y - u.y * v.x;
  if (abs(area) < 1e-12) return;
  float na = picture.near / a.z;
  vec2 rise = vec2(picture.near / b.z, picture.near / c.z) - na;
  vec2 slope = vec2(rise.x * v.y - rise.y * u.y, rise.y * u.x - rise.x * v.x) / area;

  float top = bandTop();
  float lowest = max(ceil(min(min(p.y, q.y), r.y) - 0.5), top + float(firstRow));
  float highest = min(ceil(max(max(p.y, q.y), r.y) - 0.5), top + float(min(firstRow + kSolidRows, size.y))) - 1.0;
  float y = lowest;
  if (y <= highest) do {
    vec2 range = vec2(1e30, -1e30);
    range = cutBy(range, p, q, y + 0.5);
    range = cutBy(range, q, r, y + 0.5);
    range = cutBy(range, r, p, y + 0.5);
    float x = max(ceil(range.x - 0.5), 0.0);
    float last = min(ceil(range.y - 0.5) - 1.0, float(size.x) - 1.0);
    if (x <= last) do {
      float nearness = na + dot(slope, vec2(x, y) + 0.5 - p);
      show(uint(y - top) * size.x + uint(x), clamp(nearness, 1e-6, 1.0), (t + 1) | kSolid);
    } while (++x <= last);
  } while (++y <= highest);
}
