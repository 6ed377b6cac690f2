// The stage of an animation of hair: its prims and their attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/usd/usd_matrix.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/groom_writer.h"
#include "ringlet/output/usd/usd_stage.h"

namespace ringlet {

/// A prim of curves: which strands of the groom it has.
struct HairCurves {
  std::string path;  // "/Hair"
  std::uint32_t firstStrand = 0, strandCount = 0;
  double unit = 1;                          // its lengths in the file's
  std::optional<UsdTransform> fromGroom{};  // to where its points stand; none: where the groom's do
  float margin = 0;                         // that extents have beyond the points: half the thickest diameter
};

struct HairStage {
  UsdStage stage;
  std::vector<HairCurves> curves;  // one after the other, all strands of the groom
};

/// One prim, /Hair; or, for changes of the groom's own prims (UsdExtras::originPrims), `over`s at their
/// paths. The groom's points are looked at for the rest positions only, where these are asked for.
HairStage hairStageOf(const Groom& topology, const AnimationOptions& options);

/// A groom at rest: one prim, /Hair, with its points as they are, and nothing that has samples. Widths are
/// those of the origin (UsdExtras::origin), or there are none.
HairStage groomStageOf(const Groom& groom, const GroomWriting& writing);

/// What moves, by its name.
inline constexpr const char *kUsdPoints = "points", *kUsdExtent = "extent", *kUsdVelocities = "velocities",
                            *kUsdHead = "xformOp:transform";

}  // namespace ringlet
