// A scene's hair, stepped by the reference.
#pragma once

#include <memory>

#include "ringlet/base/result.h"
#include "ringlet/run/scene_hair.h"

namespace ringlet::program {

/// In double precision, on one thread. It has the same refusals and warnings as the solver.
Result<std::unique_ptr<SceneHair>> makeReferenceHair(const SceneHairInput& input);

}  // namespace ringlet::program
