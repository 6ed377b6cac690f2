// Grids of velocities for force fields: NumPy files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/scene/force_field.h"

namespace ringlet {

/// An array of shape (x, y, z, 3), little-endian numbers of 4 or 8 bytes, in C's or Fortran's order, as
/// numpy.save writes it; `cell` is the grid's. Errors: another array, fewer than 2 nodes on a side, a number
/// that is not finite, a file that is cut off.
Result<VelocityGrid> parseVelocities(std::span<const std::byte> bytes, double cell);
Result<VelocityGrid> readVelocities(const std::filesystem::path& path, double cell);

}  // namespace ringlet
