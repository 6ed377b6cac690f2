// Hairs that follow strands, moved on the host by the reference, in double precision.
#pragma once

#include "ringlet/pictures/follow_mover.h"

namespace ringlet::program {

/// Cost of a move: with hairs; all cores are used.
FollowMoverMaker followByReference();

}  // namespace ringlet::program
