// Draws hairs, edge by edge, onto the samples of a picture. An edge is traversed along its longer axis in the
// picture; a sample on the way is hit with the hair's coverage as probability, drawn from hair and edge, so
// that the noise moves with the hair. Hits are spread evenly along the edge, so that the work is proportional
// to the covered area and not to the length.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/drawn_hairs.glsl"
#include "shared/visible.glsl"

void main() {
  uint p = gl_GlobalInvocationID.x;
  if (p >= picture.pointCount) return;
  uvec4 record = pointRecord(p);
  if ((record.w & kHairEnd) != 0) return;
  vec3 a = inView(uintBitsToFloat(record.xyz));
  vec3 b = inView(hairPoint(p + 1));
  if (min(a.z, b.z) < picture.near) return;

  // Coordinates along the longer axis and across it; the band has samples from low to high. All values depend
  // on the whole picture, so that bands meet without a seam.
  vec2 from = inSamples(a);
  vec2 to = inSamples(b);
  vec2 low = vec2(0, bandTop());
  vec2 high = low + vec2(bandSize());
  bool isSteep = abs(to.y - from.y) > abs(to.x - from.x);
  if (isSteep) from = from.yx, to = to.yx, low = low.yx, high = high.yx;
  float run = to.x - from.x;
  float start = ceil(min(from.x, to.x) - 0.5);
  float end = ceil(max(from.x, to.x) - 0.5);

  DrawnHair hair = drawnHair(record.w);
  uint i = p - hair.firstPoint;
  float share = (float(i) + 0.5) / float(hair.pointCount - 1);
  float across = 2.0 * radiusAt(hair, share) * picture.focus * float(picture.side) / (0.5 * (a.z + b.z));
  float width = across * length(to - from) / max(abs(run), 1e-6);  // along the shorter axis [samples]
  // A hair thinner than a sample hits only some steps, evenly spaced; a wider one hits all.
  float rate = min(width, 1.0);
  uint seed = mixed(record.w * 747796405u + 1u);
  float phase = fract(unitOf(seed) + float(i) * 0.618034);
  seed += i * 83492791u;
  float m = floor((clamp(low.x, start, end) - start) * rate + phase);
  float hits = floor((clamp(high.x, start, end) - start) * rate + phase);
  float apart = 1.0 / rate;
  float inverse = 1.0 / run;
  float nearnessA = picture.near / a.z;
  float nearnessB = picture.near / b.z;
  uint stride = picture.side * picture.width;
  // Each turn draws one row of one hit, so that lanes do not wait for those with more rows.
  float q = 0.0;
  if (m < hits) do {
    uint random = seed + uint(m) * 0x9e3779b9u;
    random = (random ^ random >> 15) * 0x2c1b3c6du;
    float chance = float((random ^ random >> 12) >> 8) * (1.0 / 16777216.0);
    float x = clamp(start + ceil((m + 1.0 - phase) * apart) - 1.0, low.x, high.x - 1.0);
    float t = (x + 0.5 - from.x) * inverse;
    // Nearness is linear across the picture.
    float nearness = mix(nearnessA, nearnessB, clamp(t, 0.0, 1.0));
    float rows = max(floor(width + chance), 1.0);
    float y = floor(mix(from.y, to.y, t) + (width < 1.0 ? chance - 0.5 : 0.5 - 0.5 * rows)) + q;
    vec2 at = vec2(x, y) - low;
    if (at.y >= 0.0 && y < high.y)
      show(isSteep ? uint(at.x) * stride + uint(at.y) : uint(at.y) * stride + uint(at.x), nearness, p + 1);
    bool isLast = q + 1.0 >= rows;
    q = isLast ? 0.0 : q + 1.0;
    m += isLast ? 1.0 : 0.0;
  } while (m < hits);
}
