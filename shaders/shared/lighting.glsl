// Light on hair and bodies: two lights and a sky, through the hair in front of them.
//
// Light that reaches a hair has two parts: direct light, which every hair in front of it weakens; and light
// that passed through hairs and took on their colour, which is scattered in all directions (dual scattering,
// Zinke et al. 2008, with the two factors below instead of its sums).
#ifndef RINGLET_LIGHTING
#define RINGLET_LIGHTING

#define RINGLET_READS_SHADOWS
#include "equations/hair_scattering.glsl"
#include "shared/shadow_volume.glsl"

const float kDims = 0.9;     // loss of direct light at a hair
const float kScattered = 0.10;  // loss of transmitted light at each hair: of white hair, and
const float kAbsorbed = 0.45;   // the additional loss of black hair

/// Radiance of a hair at x towards the eye. `colour`: of light that passed through a fibre.
vec3 shadedHair(vec3 x, vec3 tangent, HairFibre fibre) {
  vec3 eye = normalize(picture.eye.xyz - x);
  vec3 colour = exp(-4.0 * fibre.absorption);
  vec3 kept = sqrt(colour);
  vec3 facing = normalize(eye - tangent * dot(eye, tangent) + 1e-6);
  vec3 radiance = vec3(0);
  for (uint l = 0; l < 2; ++l) {
    vec3 light = picture.lightDirection[l].xyz;
    float hairs = hairsBefore(l, x);
    vec3 straight = exp(-kDims * hairs) * scatteredByHair(fibre, tangent, light, eye);
    float wrapped = clamp(0.25 * (dot(facing, light) + 1.0), 0.0, 1.0);
    float across = 1.0 - abs(dot(tangent, light));
    vec3 through = exp(-hairs * (kScattered + kAbsorbed * (1.0 - kept)));
    vec3 scattered = picture.throughHair * mix(wrapped, across, 0.33) * through * colour;
    radiance += picture.lightColour[l].rgb * (straight + scattered);
  }
  float open = opennessAt(x);
  vec3 sky = mix(picture.skyBelow.rgb, picture.skyAbove.rgb, 0.5 + 0.5 * facing.y);
  // Where little of the sky is visible, its light passed through hair.
  return radiance + sky * (0.8 * colour * mix(vec3(open), vec3(1), colour) * sqrt(open) + 0.012 * open * open);
}

/// Share of a light that arrives around x: the mean over the corners of a cube, since patches and hairs are
/// counted in cells, which would show as steps.
float softLight(uint light, vec3 x) {
#ifdef RINGLET_PREVIEW
  return exp(-hairsBefore(light, x));
#else
  float reach = 1.5 * sqrt(picture.shadowCellArea);
  float sum = 0.0;
  for (uint k = 0; k < 8; ++k) sum += exp(-hairsBefore(light, x + reach * (2.0 * vec3(cornerOf(k)) - 1.0)));
  return 0.125 * sum;
#endif
}

/// Radiance of a surface. colour: its reflectance.
vec3 shadedSolid(vec3 x, vec3 normal, vec3 colour) {
  vec3 eye = normalize(picture.eye.xyz - x);
  vec3 above = x + normal * (3.0 * sqrt(picture.shadowCellArea));  // outside of the cells that contain the
                                                                   // surface
  vec3 radiance = vec3(0);
  for (uint l = 0; l < 2; ++l) {
    vec3 light = picture.lightDirection[l].xyz;
    float facing = dot(normal, light);
    vec3 wrapped = clamp((facing + vec3(0.22, 0.17, 0.15)) / vec3(1.22, 1.17, 1.15), 0.0, 1.0);
    float shine = max(dot(normal, normalize(light + eye)), 0.0);
    shine *= shine;
    shine *= shine;
    shine *= shine;
    radiance += picture.lightColour[l].rgb * softLight(l, above + light * picture.densityBox.w) *
                (0.31830989 * colour * wrapped + 0.04 * shine * shine * shine * max(facing, 0.0));
  }
  float open = opennessAt(above);
  return radiance + mix(picture.skyBelow.rgb, picture.skyAbove.rgb, 0.5 + 0.5 * normal.y) * colour * (0.6 * open);
}

#endif
