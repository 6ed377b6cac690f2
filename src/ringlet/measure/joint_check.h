// Checks that a groom suits the joint that carries it: other programs may use other axes and places.
#pragma once

#include <optional>
#include <string>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/scene/motion.h"

namespace ringlet {

/// A sentence if the joint's axis that points up, on average over its keys, is not the groom's `up`: the
/// groom would lie on its side. None for a joint that turns over repeatedly, or for a motion without keys.
/// `joint`: its name. Cost: up to a thousand keys are read.
std::optional<std::string> checkJointAxes(const Motion& motion, Vec3d up, const std::string& joint);

/// A sentence if no root is near the joint, with the head at its pose `head` in the bind frame; `isWorld`:
/// the groom is bound in world coordinates. Cost: linear in strands.
std::optional<std::string> checkJointDistance(const Groom& groom, const HeadPose& head, bool isWorld,
                                              const std::string& joint);

}  // namespace ringlet
