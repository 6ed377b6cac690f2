// The contact sheet of a sweep: the last frame of every run in one picture, with the same camera.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "program/sweep/sweep_run.h"
#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"

namespace ringlet::program {

inline constexpr std::size_t kMostCells = 100;  // in a sheet; if there are more runs, the first are shown

/// The part of a pose that is shown: at most some hundred strands, evenly spaced. points: of the groom, in
/// its unit.
SweepCell cellOf(const Groom& groom, std::span<const Vec3f> points);

/// Draws a cell for each run, with its number and values below; runs that are kept are read from their
/// last.obj. With two axes each row shows one value of the first. Writes nothing if no run is finished.
/// Errors: the file cannot be written.
Status writeSweepSheet(const std::filesystem::path& path, std::vector<SweepEntry>& entries,
                       std::span<const SweepAxis> axes, const SweepOptions& options);

}  // namespace ringlet::program
