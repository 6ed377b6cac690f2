// The grooms of the built-in scenes (builtin_scene.h). Each takes the number of particles and strands from
// the options, else its own, and fails where they do not fit.
#pragma once

#include "ringlet/base/result.h"
#include "ringlet/groom/generate.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scenes/builtin_scene.h"

namespace ringlet {

/// The curl of all measurements: radius 1 cm, 8 turns, 25 cm, which is what CurlParameters has by default; 64
/// particles.
CurlParameters sceneCurl(const SceneOptions& options);

/// Curls that hang side by side, 2.5 cm apart; one.
Result<Groom> hangingCurls(const SceneOptions& options);
/// Rows of curls that stand out from a wall, along +Z.
Result<Groom> horizontalSwatch(const SceneOptions& options);
/// Two curls, their cores 5 cm apart along X.
Result<Groom> twoCurls(const SceneOptions& options);
/// Two hanging sheets of 10 x 5 curls, the nearest rows 10 cm apart along Z.
Result<Groom> curtain(const SceneOptions& options);
/// Two swatches that stand out from walls, crosswise: the second 4 cm above the first and across its middle.
Result<Groom> pile(const SceneOptions& options);
/// Two swatches that stand out from facing walls, the first 6 cm above the second: it droops onto what stands
/// firm near the other's roots.
Result<Groom> oneAboveTheOther(const SceneOptions& options);
/// The generated head, of 1,500 curls and of 100.
Result<Groom> wholeHead(const SceneOptions& options);
Result<Groom> sparseHead(const SceneOptions& options);
/// Hair of 500 long curls in locks, on the head of the bust (bodies/bust_mesh.h), down to its shoulders.
Result<Groom> bustHair(const SceneOptions& options);
/// A straight strand with one nearly flat fold.
Result<Groom> foldedStrand(const SceneOptions& options);

}  // namespace ringlet
