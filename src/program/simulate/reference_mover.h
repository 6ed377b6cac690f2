// Moves following hairs on the host by the reference, in double precision.
#pragma once

#include "ringlet/pictures/follow_mover.h"

namespace ringlet::program {

/// Cost of a move: linear in hairs; all cores are used.
FollowMoverMaker followByReference();

}  // namespace ringlet::program
