// The archive of an animation of hair: what usd_hair_stage.h says of hair, as Alembic has it.
#pragma once

#include "ringlet/groom/alembic/abc_hair.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"

namespace ringlet {

struct AbcStage {
  AbcOutArchive archive;  // of which no sample is written yet
  float margin = 0;       // that boxes have beyond the points: half the thickest diameter
};

/// Of the archive's metadata, beside its unit and up axis (abc_hair.h).
inline constexpr const char* kAbcRate = "_ai_DCC_FPS";

/// What moves is `.vals` of the transform, where the head's motion is kept apart, `.selfBnds`, `P` and
/// `.velocities`. Of AnimationOptions::usd all counts but clipFrames and originPrims. The groom's points are
/// looked at for the rest positions only, where these are asked for.
AbcStage abcStageOf(const Groom& topology, const AnimationOptions& options);

/// The same of a groom at rest, with its points: nothing has further samples, and no rate is stated.
AbcOutArchive abcGroomOf(const Groom& groom, const GroomWriting& writing);

}  // namespace ringlet
