// The archive of hair that Ringlet writes: a transform, /Hair, and below it the curves, /Hair/HairShape.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/vec3.h"
#include "ringlet/groom/alembic/abc_out.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

inline constexpr const char *kAbcHairPath = "/Hair/HairShape", *kAbcPoints = "P",
                            *kAbcVelocities = ".velocities";
/// How many numbers a transform's matrix has, in rows of 4; points are rows.
inline constexpr unsigned kAbcMatrixNumbers = 16;
/// What the archive's metadata has of Ringlet's: metres, and the axis that points up, Y or Z.
inline constexpr const char *kAbcUnit = "ringlet_metresPerUnit", *kAbcUp = "ringlet_upAxis";

/// A curves object of linear strands: strand lengths, and of the rest without samples `.selfBnds` and `P`.
/// The transform says nothing yet.
AbcOutArchive abcHairOf(const Groom& topology);

/// Of such an archive. They stay where they are as long as the archive does.
std::vector<AbcOutProperty>& abcTransformOf(AbcOutArchive& hair);
std::vector<AbcOutProperty>& abcGeometryOf(AbcOutArchive& hair);

/// Coordinates as the file has them, over the 12 bytes a point that are there from `at` on.
void putAbcPoints(std::span<const Vec3f> points, std::string& bytes, std::size_t at);
/// The lowest and the highest corner of a box.
std::string abcBoxBytes(const std::array<Vec3f, 2>& corners);

}  // namespace ringlet
