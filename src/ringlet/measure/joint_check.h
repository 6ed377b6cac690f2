// Whether a groom suits the joint that carries it: axes and places of other programs differ from a groom's.
#pragma once

#include <optional>
#include <string>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

/// A sentence where the joint's axis that points up, on average over its keys, is not the groom's, `up`: the
/// groom would stand on its side. None for a joint that turns over and over, or is no file's. `joint`: its
/// name. Cost: a look at a thousand keys.
std::optional<std::string> checkJointAxes(const Motion& motion, Vec3d up, const std::string& joint);

/// A sentence where no root is near the joint, with the head at its pose `head` of the bind frame; `isWorld`:
/// the groom is bound in the world. Cost: a look at each strand.
std::optional<std::string> checkJointDistance(const Groom& groom, const HeadPose& head, bool isWorld,
                                              const std::string& joint);

}  // namespace ringlet
