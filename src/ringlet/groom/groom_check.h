// checkGroom: whether a groom can be written, the same rule for every format.
#pragma once

#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

/// Whether `points`, as many as the topology's own, make strands that can be read back: at least one strand,
/// two particles in each, all finite. `path` is for the message. A firstPoint that does not fit its points is
/// the caller's fault.
Status checkGroom(const Groom& topology, std::span<const Vec3f> points, const std::filesystem::path& path);

}  // namespace ringlet
