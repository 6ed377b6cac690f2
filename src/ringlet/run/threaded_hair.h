// ThreadedHair: a part of divided hair whose frames are stepped on a thread of its own.
#pragma once

#include <memory>

#include "ringlet/run/scene_hair.h"

namespace ringlet {

/// submit returns at once; every other call waits until the frame is over.
std::unique_ptr<SceneHair> onThread(std::unique_ptr<SceneHair> hair);

}  // namespace ringlet
