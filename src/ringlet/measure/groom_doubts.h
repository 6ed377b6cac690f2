// Likely mistakes in a groom, reported before it is simulated: a sentence each, with the remedy. Faults that
// `ringlet info` counts but that do no harm are not reported.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

/// Particles far away from all hair, and edges that lead there. The groom must be as in its file, with the
/// file's origin. Cost: n log n in the particles.
std::vector<std::string> doubtsOfPlaces(const Groom& groom);

/// Strands whose tips lie on the ball that is the head, on which other strands have their roots.
std::optional<std::string> doubtOfRootEnds(const Groom& groom);

/// A groom whose strands hang along another axis than the up axis (Y or Z), unless its roots lie on a ball
/// and suggest otherwise.
std::optional<std::string> doubtOfUp(const Groom& groom, bool upIsZ);

/// All of these doubts about a groom that was read with `reading`.
std::vector<std::string> doubtsOf(const LoadedGroom& loaded, const GroomReading& reading);

/// The likely position of a groom's head: the centre of the ball that its roots lie on, or else the mean of
/// the roots [m]. The groom must not be empty.
Vec3d headMiddle(const Groom& groom);

/// Whether every root is farther from the origin than half a metre and than the groom's own size.
bool standsFarOff(const Groom& groom);

/// A groom that stands far from the pivot of the motion: the origin, an axis through it, or a place given by
/// keys.
std::optional<std::string> doubtOfPivot(const Groom& groom, const Motion& motion);

}  // namespace ringlet
