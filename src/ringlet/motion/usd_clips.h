// What value clips say of a mesh that moves: points, transforms and joints, at the times of the stage.
//
//   layer   /Hero ( clips )     primPath "/Model"      clip   /Model
//           /Hero/Body                                        /Model/Body
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/motion/sampled_mesh.h"
#include "ringlet/motion/usd_clip_files.h"
#include "ringlet/motion/usd_prims.h"

namespace ringlet {

struct UsdClipped {
  std::optional<PointSamples> points{};  // with time codes as seconds; none: the layer's own count
  std::vector<std::string> warnings{};
};

/// Fills in what clips say of the mesh, of the prims above it and of what deforms it. The layer's own values
/// count more, and sets of a prim more than those of prims above it. Samples become attributes of the layer,
/// those of the mesh's points come back. Faces, and what else does not move, are taken from the first clip
/// where the layer has none. Each clip that is ever used is read once, and one at a time is held. `prims` are
/// those of the layer; null `files`: there are none to read. Errors, with file and prim: those of
/// clipSchedulesOf(); a clip that cannot be read, lacks the prim or its samples, or has other faces or
/// another count of points; times that come to more samples than files of that size may. Cost: linear in the
/// clips and in the times.
Result<UsdClipped> readUsdClips(UsdLayer& layer, const UsdPrims& prims, std::uint32_t mesh,
                                const UsdClipFiles* files);

}  // namespace ringlet
