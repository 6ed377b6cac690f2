// The strands of an Alembic archive: its curves (AbcGeom_Curve_v2), placed as the transforms above them say.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// All curves of the file, depth first in its order, as they are at their first sample that has points. Cubic
/// ones become strands by cubic_curve.h. Values (GroomPrim): `widths`, and as primvars st (the uv), N,
/// velocities and what stands in .arbGeomParams. Unit and axis are stated by archives that Ringlet wrote
/// (abc_hair.h); the format has no place for them. Left out, with a warning: objects that are hidden, or
/// whose curves cannot be read (closed ones, a basis or orders that are not read, counts that do not fit,
/// transforms that cannot be followed), and curves of too few points or with one that is not finite. Warned
/// of as well: what moves; cubic curves; instances, NURBS patches and points beside curves. Errors: those of
/// AbcArchive; no strands, with what there is instead; objects that share more than a file of its size can
/// say. Memory and time are bounded by the file's size. Throws nothing but std::bad_alloc. `path` is for
/// messages.
Result<LoadedGroom> readAbcGroom(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                 const GroomReading& reading = {});

class AbcArchive;

/// The same at a time, of curves that move; visibility is the first sample's.
Result<LoadedGroom> abcGroomAt(double seconds, const AbcArchive& archive, const GroomReading& reading);

/// The times at which curves that are drawn, or what places them, have a sample [s], in any order; none:
/// nothing moves.
Result<std::vector<double>> abcGroomTimes(const AbcArchive& archive);

}  // namespace ringlet
