// Vectors and quaternions as the device has them: four floats.
#pragma once

#include "layout/types.h"
#include "ringlet/base/vec3.h"

namespace ringlet {

inline layout::vec4 packed(Vec3d v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}
inline layout::vec3 packed3(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline layout::vec4 packed(Vec3f v) { return {v.x, v.y, v.z, 0}; }
inline layout::vec4 packed(Quatd q) { return packed(Vec3d{q.x, q.y, q.z}, q.w); }
inline Vec3f unpacked(layout::vec4 v) { return {v.x, v.y, v.z}; }

}  // namespace ringlet
