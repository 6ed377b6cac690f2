// The render_* kernels: structs, binding numbers, push constants.
#ifndef RINGLET_LAYOUT_PICTURE
#define RINGLET_LAYOUT_PICTURE

#include "layout/hair_points.h"
#include "layout/types.h"

#ifdef __cplusplus
namespace ringlet::layout {
#endif

// Bindings of the render_* kernels: they draw pictures of hair and bodies without a graphics pipeline.
RINGLET_CONSTANT uint kBindPicture = 0;       // uniform: Picture
RINGLET_CONSTANT uint kBindDrawnPoints = 1;   // uvec4[points]: hair_points.h
RINGLET_CONSTANT uint kBindDrawnHairs = 2;    // DrawnHair[hairs]
RINGLET_CONSTANT uint kBindShadows = 3;       // uint[2][slices][cells][cells]: hair between each light and a
                                              // cell
RINGLET_CONSTANT uint kBindDensity = 4;       // uint[cells^3]: hair in each cell
RINGLET_CONSTANT uint kBindOpenness = 5;      // float[cells^3]: share of the sky that is visible from each
                                              // cell
RINGLET_CONSTANT uint kBindSamples = 6;       // uvec2[samples]: what is visible, and its nearness; later its
                                              // colour
RINGLET_CONSTANT uint kBindSeen = 7;          // uint[samples]: samples in which hair is visible
RINGLET_CONSTANT uint kBindSeenCounts = 8;    // SeenCounts
RINGLET_CONSTANT uint kBindSolidPoints = 9;   // SolidPoint[points of bodies, then patches]
RINGLET_CONSTANT uint kBindSolidTriangles = 10;  // SolidTriangle[triangles of bodies]
RINGLET_CONSTANT uint kBindSeenSolids = 11;   // uvec2[pixels]: pixels in which bodies are visible << 4 | a
                                              // sample there, and the triangle
RINGLET_CONSTANT uint kBindSolidColours = 12; // uvec2[pixels]: colour of bodies, and the share that they
                                              // cover, as halves
RINGLET_CONSTANT uint kBindPixels = 13;       // vec4[pixels]: sum of pictures, linear; w: number of pictures
RINGLET_CONSTANT uint kBindShown = 14;        // uint[pixels]: red, green, blue, 255, as displayed
RINGLET_CONSTANT uint kBindLight = 15;        // vec4[pixels]: linear light; 1
RINGLET_CONSTANT uint kRenderBindingCount = 16;
// Those read as texels, with these added to the binding numbers:
RINGLET_CONSTANT uint kRenderTexels = 20;

RINGLET_CONSTANT uint kSpecPass = 2;     // render_hairs and render_solids without 64-bit atomics: 0:
                                         // nearness, 1: what is visible
RINGLET_CONSTANT uint kSolid = 0x80000000u;  // a triangle of a body is visible
RINGLET_CONSTANT uint kShadedHair = 0x80000000u;  // bit of a sample's second word: the word is a colour and
                                                  // not a nearness

RINGLET_CONSTANT uint kSolidRows = 64;  // rows of samples for each invocation of render_solids

RINGLET_CONSTANT uint kMostPigments = 8;
RINGLET_CONSTANT uint kSolidBody = 0, kSolidGround = 1, kSolidCloth = 2, kSolidKinds = 3;

// A picture and its camera.
struct Picture {
  vec4 view[3];            // rows: from the world to the camera's right, up and forward axes [m]
  vec4 eye;                // [m], 0
  vec4 lightAxes[6];       // rows, three for each light: from the world to the light's box, with x, y and
                           // depth in [0, 1]
  vec4 lightDirection[2];  // towards the light, 0
  vec4 lightColour[2];     // irradiance, 0
  vec4 skyAbove;           // radiance, 0
  vec4 skyBelow;
  vec4 densityBox;         // lower corner [m], cell [m]
  vec4 pigments[kMostPigments];  // absorption over a fibre's radius, 0; hairs interpolate between two
                                 // neighbours
  vec4 solidColours[kSolidKinds];  // reflectance of each kind, 0
  vec4 backColours[2];     // radiance of the background: in the middle, at the edge; 0
  uint width;
  uint height;
  uint side;               // samples along a side of a pixel
  uint hairCount;
  uint pointsPerHair;      // the largest number of a hair
  uint pointCount;
  uint triangleCount;
  uint shadowCells;        // cells across a light's box
  uint shadowSlices;       // slices along a light's box
  uint densityCells;       // cells along each side of the density's box
  uint shadowStride;       // only one hair in this many is counted, with this weight
  float focus;             // size in pixels of one metre at a distance of one metre
  float near;              // nearest distance that is drawn [m]
  float shadowCellArea;    // [m^2]
  float fixedPoint;        // integer units for a square metre of hair
  float shadowOpacity;     // share of light that a hair blocks
  float along;             // along, about and tilt: see HairFibre
  float about;
  float tilt;
  float exposure;
  float tipRadius;         // radius at the tip, relative to the root
  float throughHair;       // factor on light that passed through other hairs
  uint pigmentCount;       // number of pigments used, at least 2
};

// Constant per hair.
struct DrawnHair {
  uint firstPoint;
  uint pointCount;
  float radius;   // at the root [m]
  float pigment;  // index between the picture's pigments, fractional: 0 the first, 1 the last
};

struct SolidPoint {
  vec4 position;  // [m]; w: of a patch, its area [m^2]; of a point, its kind: kSolid...
  vec4 normal;    // w: of a point, the share of the background that shines through
};

struct SolidTriangle {
  uint points[3];
  uint unused;
};

// Numbers of samples and pixels in which hair and bodies are visible, also as workgroups.
struct SeenCounts {
  uint indirectHairs[3];
  uint hairs;
  uint indirectSolids[3];
  uint solids;
};

// A part of a picture: complete rows of pixels.
struct PictureBand {
  uint firstRow;
  uint rowCount;
};

// Bindings of render_stretch: the stretch of a strand gives the colour of its hairs.
RINGLET_CONSTANT uint kBindStretchPoints = 0;   // uvec4[points of strands]: bits of the position, an unused
                                                // number
RINGLET_CONSTANT uint kBindStretchLengths = 1;  // float[points of strands]: rest length of the edge that
                                                // begins there [m]
RINGLET_CONSTANT uint kBindStretchStrands = 2;  // StretchStrand[hairs]
RINGLET_CONSTANT uint kBindStretchHairs = 3;    // DrawnHair[hairs]

// For each hair the strand that it is or follows.
struct StretchStrand {
  uint firstPoint;
  uint pointCount;
};

struct StretchParameters {
  uint count;  // number of hairs
  float most;  // elongation of an edge, relative to its length, that gives the second pigment
};

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
