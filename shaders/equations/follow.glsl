// The place of a point of a hair that follows a guide. With s the share of the way from root to tip,
//
//     r = smoothstep(0, 1/5, s),   k = 1 + (spread - 1) smoothstep(0, 2/5, s)
//     x = c + F Rz(r phase) z (1 + (radius - 1) r) + k ((1 - r) e + r F d)
//
// c: the guide's core; F: the frame along it; z: the guide's curl in F; d: the hair's offset; e: vector from
// the guide's root to the hair's: F_root d with the frame at rest carried by the head, or as a deforming
// scalp gives it. Choe and Ko 2005 (wisps). If it follows several guides, with shares w_j of the core and the
// hair's offsets from each, it is displaced by
//
//     sum_j w_j (y_j - y_1),   y_j = c_j + (1 - r) F_j z_j + k ((1 - r) e_j + r F_j d_j)
//
// and keeps the first guide's curl. A hair with points of its own has, beside them, its own shape at rest: x moves
// by F q, with q what at rest is left of it, along F. It is pushed out of a body by
//
//     max(min(0, D, (1 - r) D_root) - d_x, 0)
//
// d_x, D, D_root: distances from the body's surface, negative inside, of the point, of its guide beside it
// (between particles interpolated; of several guides the sum of w_j D_j), and of the hair's root. Mirrored by
// reference/equations/follow.h.
#ifndef RINGLET_FOLLOW
#define RINGLET_FOLLOW

#include "equations/turbulence.glsl"
#include "maths/quaternion.glsl"

/// A guide at one place along it.
struct GuidePlace {
  vec3 core;   // [m]
  vec3 curl;   // offset of the strand from its core, in `frame` [m]
  vec4 frame;  // takes normal, binormal, tangent to world axes
};

/// Rises smoothly from 0 at 0 to 1 at `end`; constant outside.
float risesOver(float end, float share) {
  float x = clamp(share / end, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// Interpolates between two places, frames along the shorter way. The length of the curl is interpolated too.
GuidePlace placeBetween(GuidePlace a, GuidePlace b, float share) {
  vec4 frame = mix(a.frame, dot(a.frame, b.frame) < 0.0 ? -b.frame : b.frame, share);
  vec3 curl = mix(a.curl, b.curl, share);
  float size = mix(length(a.curl), length(b.curl), share);
  return GuidePlace(mix(a.core, b.core, share), curl * (size * inversesqrt(max(dot(curl, curl), 1e-30))),
                    normalize(frame));
}

/// phase [rad], radius, spread: of the hair; offset: along the frames [m]; rootOffset: e [m]; share: s.
/// Returns x [m].
vec3 followedPoint(float phase, float radius, float spread, vec3 offset, GuidePlace place, vec3 rootOffset,
                   float share) {
  float r = risesOver(0.2, share);
  float angle = r * phase;
  float cosine = cosOfFolded(foldedAngle(angle));
  float sine = cosOfFolded(foldedAngle(angle - 1.5707963268));
  vec3 z = place.curl;
  vec3 curl = (1.0 + (radius - 1.0) * r) * vec3(cosine * z.x - sine * z.y, sine * z.x + cosine * z.y, z.z);
  float k = 1.0 + (spread - 1.0) * risesOver(0.4, share);
  return place.core + rotate(place.frame, curl) +
         k * ((1.0 - r) * rootOffset + r * rotate(place.frame, offset));
}

/// y_j for one of several guides [m]; offset, rootOffset: d_j and e_j.
vec3 blendedPoint(float spread, vec3 offset, GuidePlace place, vec3 rootOffset, float share) {
  float r = risesOver(0.2, share);
  float k = 1.0 + (spread - 1.0) * risesOver(0.4, share);
  return place.core + (1.0 - r) * rotate(place.frame, place.curl) +
         k * ((1.0 - r) * rootOffset + r * rotate(place.frame, offset));
}

/// The distance from a body's surface, negative inside, from which a point is kept [m]: no farther out than its
/// guide beside it and its own root are, whose distances these are [m].
float keptBesideGuide(float ofGuide, float ofRoot, float share) {
  return min(0.0, min(ofGuide, (1.0 - risesOver(0.2, share)) * ofRoot));
}

#endif
