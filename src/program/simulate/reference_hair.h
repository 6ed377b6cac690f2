// A scene's hair by the reference.
#pragma once

#include <memory>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::program {

/// In double precision, on one thread. Refuses what the solver refuses, and warns of what it warns of.
Result<std::unique_ptr<SceneHair>> makeReferenceHair(const SceneHairInput& input);

}  // namespace ringlet::program
