// PLY files of strands (.ply), as hairutil writes them: an element `vertex` of points, and `strand`, how many
// edges each has, or `edge`, the two ends of each.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads the bytes of a .ply file, text or binary little-endian; `path` is for messages, which name line or
/// byte, what was found and what was expected. `strand` says `nsegs`, the edges of each, and its points
/// follow each other, root first; without it the ends of `edge`, `vertex1` and `vertex2`, are joined as
/// obj_file.h joins lines of two. Strands of one point or with one that is not finite are left out, and
/// points that no strand has, with a warning. A file without either is cut into strands of
/// `reading.pointsPerStrand`. All other elements and properties are read over. Errors: anything that breaks
/// the format, no strands. Memory is taken only for what the file has bytes for. Throws nothing but
/// std::bad_alloc. Cost: one pass.
Result<LoadedGroom> readPly(std::span<const std::byte> bytes, const std::filesystem::path& path,
                            const GroomReading& reading = {});

/// Writes a groom with other positions, as many as its own, in its order and unit: a frame of an animation.
/// Binary, `nsegs` of 16 bits unless a strand has more edges; reading it gives the same bits. Errors: see
/// writeGroom.
Status writePly(const std::filesystem::path& path, const Groom& topology, std::span<const Vec3f> points);

}  // namespace ringlet
