// ThreadedBackend: a part of divided hair, whose frames are stepped on a thread of their own.
#pragma once

#include <memory>

#include "program/backend.h"

namespace ringlet::program {

/// submitFrame comes back at once; every other call waits until the frame is over.
std::unique_ptr<Backend> onThread(std::unique_ptr<Backend> hair);

}  // namespace ringlet::program
