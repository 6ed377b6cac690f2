// The curl a strand was groomed with, measured on its rest curve: how long a turn is, how wide, how steep,
// which way it winds.
#pragma once

#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// A straight strand has turns = 0 and turnLength = radius = pitch = 0.
struct CurlShape {
  double turns = 0;       // how often the strand winds about its core, each stretch counted positive
  double turnLength = 0;  // L: arc length of one turn [unit of the points]
  double radius = 0;      // r: distance of the strand from its core [unit]
  double pitch = 0;       // distance along the core per turn [unit]
  int handedness =
      0;  // of most of it: +1 right-handed, -1 left-handed; 0 straight, or as much one as the other
  int perversions = 0;  // how often the hand changes along the strand
};

/// Fits a helix to the whole strand from its joints: the turn from edge to edge (angle theta) and the
/// dihedral angle phi between successive planes compose to the helix's own rotation per edge, cos(w/2) =
/// cos(theta/2) cos(phi/2), exact for a uniformly cut helix however coarse. Where the hand changes (a
/// perversion: real tight coils have several) phi changes sign; it counts with the sign it has over a turn,
/// so that the two hands of a strand do not cancel into a flat ring. A joint counts by how much it bends, so
/// L, r and pitch are those of the curled part of a strand that is straight elsewhere. A flat ring has pitch
/// 0 and an arbitrary hand. Cost: one pass.
///
/// Straight is a strand that makes less than one turn, whose curl is shallower than a tenth
/// (2 pi r < 0.1 pitch), whose bends follow no one helix (noise, flat waves), or that has fewer than 2.5
/// particles a turn (a zigzag).
CurlShape measureCurl(std::span<const Vec3d> strand);

/// A part of a strand, about a turn long, and the helix it follows.
struct CurlStretch {
  double length = 0;  // arc length [unit]
  CurlShape shape;    // turns: of this part
};

/// A strand's curl as a whole, and from root to tip a turn at a time: curl varies along real hair. Straight
/// parts of a curled strand are left out; a straight strand has no stretches.
struct CurlAlong {
  CurlShape whole;
  std::vector<CurlStretch> stretches;
};

/// As measureCurl, whose cost it has.
CurlAlong measureCurlAlong(std::span<const Vec3d> strand);

/// Arc length of each of the strand's edges [unit]: the chord lengthened to the circular arc through its
/// neighbours, chord (a/2) / sin(a/2) with a the mean turning angle at its two ends. n - 1 values. An edge
/// that is not finite has arc 0.
void measureArcs(std::span<const Vec3d> strand, std::span<double> arcs);

}  // namespace ringlet
