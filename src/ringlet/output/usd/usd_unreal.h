// What Unreal's importer of grooms reads of a prim of curves: GroomAPI, and primvars that begin with "groom_"
// (version 1.5 of its schema).
#pragma once

#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usd_stage.h"

namespace ringlet {

/// Adds to `prim`, which has its widths, those that it does not have yet. `said`: what the groom's file says
/// of its curves, of which values named groom_*, ids, UVs and colours are used. Widths that are constant
/// become one of each strand, since those are dropped where a prim above has the API.
void addUnreal(const Groom& topology, const HairCurves& curves, const UsdExtras& extras,
               const std::vector<UsdStageAttribute>& said, UsdStagePrim& prim);

}  // namespace ringlet
