// OBJ polylines (.obj): `v x y z` lines, then one `l i j k ...` per strand, root first.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads the text of an .obj file; `path` is for messages, which name the line, what was found and what was
/// expected. An `l` of three or more indices is a strand, root first. Lines of two indices are edges and are
/// joined where they share a point, in whatever order they come; a strand then runs the way most of its edges
/// do. Closed loops, edges that branch and strands with a point that is not finite are left out, with a
/// warning. Other keywords are ignored. A file of points only is cut into strands of
/// `reading.pointsPerStrand`. Errors: a bad number or index, no strand at all. Throws nothing but
/// std::bad_alloc. Cost: one pass over the text, one over the edges.
Result<LoadedGroom> readObj(std::span<const std::byte> text, const std::filesystem::path& path,
                            const GroomReading& reading = {});

/// Writes a groom as .obj with nine significant digits; reading it gives the same bits. Errors: see
/// writeGroom.
Status writeObj(const std::filesystem::path& path, const Groom& groom);

/// A line a strand; or a line an edge, for programs that read no longer ones, as Blender 3.
enum class ObjLines { strands, edges };

/// The same with other positions, as many as the groom's, in its order and unit: a frame of an animation.
Status writeObj(const std::filesystem::path& path, const Groom& topology, std::span<const Vec3f> points,
                ObjLines lines = ObjLines::strands);

}  // namespace ringlet
