// Generated grooms: one curl, a swatch of curls, a head of curls. Y is up, -Y is where hair hangs, +Z is
// where a face looks.
//
// The same parameters give the same groom, on every machine up to the rounding of its sine.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/hair_cut.h"
#include "ringlet/groom/scalp_surface.h"

namespace ringlet {

/// A helix about a core: radius [m] in (0, 1], length in (0, 10], turns in [0, 1000] (0 is a straight
/// strand), particleCount in [2, 65536]. A curl holds its shape from 4 particles per turn on; fewer are
/// allowed.
struct CurlParameters {
  double radius = 0.01;    // of the strand from its core [m]
  double turns = 8;        // about the core, root to tip
  double length = 0.25;    // of the core [m]
  int particleCount = 64;  // evenly spaced along the core
  int handedness = 1;      // +1 right-handed, -1 left-handed
  double phase = 0;        // where about the core the curl begins [rad], any finite number
  double metresPerUnit =
      0.01;  // unit of the groom's points [m], in [1e-6, 1000]; everything else here is in metres
};

/// How the strands of a groom differ from one another. A length that varies keeps its turns per metre.
struct Variation {
  double radius = 0.1;           // largest relative difference, in [0, 0.9]
  double length = 0.1;           // likewise
  double phase = 1;              // share of a full turn, in [0, 1]
  double leftHandedShare = 0.5;  // share of strands, in [0, 1], that wind against CurlParameters::handedness
  std::uint64_t seed = 1;
};

/// Curls hanging side by side from y = 0, columns along X and rows along Z, in the middle of which the origin
/// is.
struct SwatchParameters {
  CurlParameters curl{};
  Variation variation{};
  int columnCount = 8, rowCount = 8;  // each in [1, 10000]
  double spacing = 0.025;             // between neighbouring cores [m], in (0, 10]
};

/// A head of curls: a sphere about the origin whose hair grows above a hairline, high at the brow and low at
/// the nape.
struct HeadParameters {
  CurlParameters curl{};
  Variation variation{};
  int strandCount = 1000;       // in [1, 1000000]
  int lockCount = 0;            // in [0, 10000]; 0: every strand is a curl of its own
  double scalpRadius = 0.09;    // [m], in (0, 10], and at least 2 curl.radius
  double browElevation = 0.75;  // of the hairline above the head's centre in front [rad], in [-1.5, 1.5]
  double napeElevation = -0.6;  // likewise behind [rad]
  double bendLength =
      0.025;  // how far along a strand it turns from the scalp's normal to hanging [m], in (0, 10]
  double rampShare = 0.2;  // share of its length over which the curl's radius grows from 0, in (0, 1]
  HairCut cut{};
  /// In place of the sphere (bodies/mesh_scalp.h): hair grows where it is above the hairline, as seen from
  /// the origin. scalpRadius is then a length among others, for what rises with it.
  std::shared_ptr<const ScalpSurface> scalp{};
};

/// A sentence for the user where a curl is cut too coarsely to hold its shape.
std::optional<std::string> coarseCurlWarning(const CurlParameters& parameters);

/// One curl. Its root is at (radius cos(phase), 0, radius sin(phase)) and its core hangs from the origin to
/// (0, -length, 0). Errors: a parameter outside its range.
Result<Groom> makeCurl(const CurlParameters& parameters = {});

/// Row after row of curls. Errors: a parameter outside its range, or more than 100 million particles in all.
Result<Groom> makeSwatch(const SwatchParameters& parameters = {});

/// Guides evenly spread over the scalp. Each starts on it along its normal, bends over to hang down beside or
/// behind the head, combed away from the face, and stays outside the sphere. With locks a strand belongs to
/// the nearest of `lockCount` places, evenly spread too: strands of a lock wind the same way, and differ from
/// each other by a tenth of what locks differ by. `cut` shortens, combs and clumps them. Errors as for
/// makeSwatch; a scalp that is not about the origin. Cost: with strands times locks; with half a millimetre
/// of a strand what the scalp takes for a height.
Result<Groom> makeHead(const HeadParameters& parameters = {});

}  // namespace ringlet
