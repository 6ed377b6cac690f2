// The render_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_PICTURE
#define RINGLET_LAYOUT_PICTURE

#include "layout/hair_points.h"
#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the render_* kernels: pictures of hair and bodies, without a graphics pipeline.
RINGLET_CONSTANT uint kBindPicture = 0;       // uniform: Picture
RINGLET_CONSTANT uint kBindDrawnPoints = 1;   // uvec4[points]: hair_points.h
RINGLET_CONSTANT uint kBindDrawnHairs = 2;    // DrawnHair[hairs]
RINGLET_CONSTANT uint kBindShadows = 3;       // uint[2][slices][cells][cells]: hair before each light
RINGLET_CONSTANT uint kBindDensity = 4;       // uint[cells^3]: hair about each place
RINGLET_CONSTANT uint kBindOpenness = 5;      // float[cells^3]: share of the sky that is seen from there
RINGLET_CONSTANT uint kBindSamples = 6;       // uvec2[samples]: what is seen and its nearness; then its colour
RINGLET_CONSTANT uint kBindSeen = 7;          // uint[samples]: those in which hair is seen
RINGLET_CONSTANT uint kBindSeenCounts = 8;    // SeenCounts
RINGLET_CONSTANT uint kBindSolidPoints = 9;   // SolidPoint[points of bodies, then patches]
RINGLET_CONSTANT uint kBindSolidTriangles = 10;  // SolidTriangle[triangles of bodies]
RINGLET_CONSTANT uint kBindSeenSolids = 11;   // uvec2[pixels]: those in which bodies are seen << 4 |
                                              // a sample there, and the triangle
RINGLET_CONSTANT uint kBindSolidColours = 12; // uvec2[pixels]: their colour, and the share that it covers, in halves
RINGLET_CONSTANT uint kBindPixels = 13;       // vec4[pixels]: sum of pictures, linear; w: their number
RINGLET_CONSTANT uint kBindShown = 14;        // uint[pixels]: red, green, blue, 255, as they are shown
RINGLET_CONSTANT uint kBindLight = 15;        // vec4[pixels]: their light, linear; 1
RINGLET_CONSTANT uint kRenderBindingCount = 16;
// Those read as texels, these numbers further:
RINGLET_CONSTANT uint kRenderTexels = 20;

RINGLET_CONSTANT uint kSpecPass = 2;     // of render_hairs and render_solids without 64-bit atomics: 0 nearness, 1 what
RINGLET_CONSTANT uint kSolid = 0x80000000u;  // what is seen is a triangle of a body
RINGLET_CONSTANT uint kShadedHair = 0x80000000u;  // of a sample's second word: it holds a colour, no nearness

RINGLET_CONSTANT uint kSolidRows = 64;  // of samples, that an invocation of render_solids has

RINGLET_CONSTANT uint kMostPigments = 8;

// Of a picture and its camera.
struct Picture {
  vec4 view[3];            // rows: from the world to the camera's right, up and forward axes [m]
  vec4 eye;                // [m], 0
  vec4 lightAxes[6];       // rows, three a light: from the world to the light's box, each of x, y and depth in [0, 1]
  vec4 lightDirection[2];  // towards it, 0
  vec4 lightColour[2];     // irradiance, 0
  vec4 skyAbove;           // radiance, 0
  vec4 skyBelow;
  vec4 densityBox;         // lower corner [m], cell [m]
  vec4 pigments[kMostPigments];  // absorption over a fibre's radius: hairs are between two neighbours; 0
  vec4 solidColour;        // reflected share, 0
  vec4 groundColour;       // likewise
  vec4 backColours[2];     // radiance behind all: in the middle, at the edge; 0
  uint width;
  uint height;
  uint side;               // samples along a pixel's side
  uint hairCount;
  uint pointsPerHair;      // the most of any hair
  uint pointCount;
  uint triangleCount;
  uint shadowCells;        // across a light's box
  uint shadowSlices;       // along it
  uint densityCells;       // along each side of the density's box
  uint shadowStride;       // every so many hairs count, for as many
  float focus;             // pixels a metre one metre away
  float near;              // what is nearer is left out [m]
  float shadowCellArea;    // [m^2]
  float fixedPoint;        // units a square metre of hair
  float shadowOpacity;     // share of light that a hair keeps from what is behind it
  float along;             // HairFibre
  float about;
  float tilt;
  float exposure;
  float tipRadius;         // share of a hair's radius that is left at its tip
  float throughHair;       // brightness of light that came through other hairs
  uint pigmentCount;       // of pigments, at least 2
};

// Constant per hair.
struct DrawnHair {
  uint firstPoint;
  uint pointCount;
  float radius;   // at the root [m]
  float pigment;  // place among the picture's pigments: 0 the first, 1 the last
};

struct SolidPoint {
  vec4 position;  // [m]; w: of a patch, its area [m^2]; of a point, 1 on the ground and 0 on bodies
  vec4 normal;    // w: of a point, the share of what is behind it that is seen
};

struct SolidTriangle {
  uint points[3];
  uint unused;
};

// What is seen of hair and of bodies, as groups of invocations and as numbers.
struct SeenCounts {
  uint indirectHairs[3];
  uint hairs;
  uint indirectSolids[3];
  uint solids;
};

// A part of a picture: whole rows of pixels.
struct PictureBand {
  uint firstRow;
  uint rowCount;
};

// Bindings of render_stretch: hairs take the colour of how far their strand is stretched.
RINGLET_CONSTANT uint kBindStretchPoints = 0;   // uvec4[points of strands]: position's bits, anything
RINGLET_CONSTANT uint kBindStretchLengths = 1;  // float[points of strands]: of the edge that begins there, at rest [m]
RINGLET_CONSTANT uint kBindStretchStrands = 2;  // StretchStrand[hairs]
RINGLET_CONSTANT uint kBindStretchHairs = 3;    // DrawnHair[hairs]

// Constant per hair: the strand that it is, or follows.
struct StretchStrand {
  uint firstPoint;
  uint pointCount;
};

struct StretchParameters {
  uint count;  // of hairs
  float most;  // share of its length by which an edge of the second pigment is longer
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
