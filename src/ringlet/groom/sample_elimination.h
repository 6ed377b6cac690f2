// Blue noise on a surface: of many samples those stay that are evenly spread. Yuksel, "Sample elimination for
// generating Poisson disk sample sets", 2015.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ringlet/base/vec3.h"

namespace ringlet {

/// Indices of `count` of the points, rising; all of them where there are no more. `area`: of the surface the
/// points are on [m^2], about. Always the sample goes that has most others near it, as the paper weighs
/// them: (1 - d / 2 r)^8 for each at the distance d below 2 r, r the largest radius `count` discs may have.
/// Of equals the first goes. Cost: with points times the samples within 2 r, 14 times points over count.
std::vector<std::uint32_t> eliminateSamples(std::span<const Vec3d> points, std::size_t count, double area);

}  // namespace ringlet
