// What seems wrong with a groom by itself, for whoever is about to simulate it: a sentence each, with what
// mends it. What `ringlet info` counts as faults without harm is not said.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

/// Particles far off where hair is, and edges that lead there. Of a groom as its file has it: the origin is
/// the file's. Cost: n log n in the particles.
std::vector<std::string> doubtsOfPlaces(const Groom& groom);

/// Strands that end on the ball that is the head, where others begin.
std::optional<std::string> doubtOfRootEnds(const Groom& groom);

/// A groom whose strands hang along another axis than the one that is up, Y or Z, and whose roots, where they
/// lie on a ball, do not say otherwise.
std::optional<std::string> doubtOfUp(const Groom& groom, bool upIsZ);

/// All of these of a groom that was read so.
std::vector<std::string> doubtsOf(const LoadedGroom& loaded, const GroomReading& reading);

/// Where a groom's own head is, as far as one can tell: the middle of the ball that its roots lie on, else of
/// the roots [m]. Not empty.
Vec3d headMiddle(const Groom& groom);

/// Whether no root is nearer to the origin than half a metre and the groom's own size.
bool standsFarOff(const Groom& groom);

/// A groom that stands far from where the motion turns it: about the origin, an axis through that, or as keys
/// say.
std::optional<std::string> doubtOfPivot(const Groom& groom, const Motion& motion);

}  // namespace ringlet
