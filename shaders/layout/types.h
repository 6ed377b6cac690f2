// The files of this folder are read by both GLSL and C++, which must agree on their content. This one has the
// types, and constants of all kernels.
#ifndef RINGLET_LAYOUT_TYPES
#define RINGLET_LAYOUT_TYPES

#ifdef __cplusplus
#include <cstdint>
namespace ringlet::layout {
using uint = std::uint32_t;
struct alignas(16) vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
// In GLSL it is aligned to 16 bytes, which a float after it fills.
struct alignas(4) vec3 {
  float x = 0, y = 0, z = 0;
};
struct alignas(16) uvec4 {
  uint x = 0, y = 0, z = 0, w = 0;
};
#define RINGLET_CONSTANT inline constexpr
#else
#define RINGLET_CONSTANT const
#endif

// Specialization constants that any kernel may have.
RINGLET_CONSTANT uint kSpecGroupSize = 0;  // invocations of a workgroup
RINGLET_CONSTANT uint kSpecTexels = 1;     // records are read as texels (shared/texels.glsl)
RINGLET_CONSTANT uint kSpecForGpu = 30;    // contacts and volumes: the form for GPUs instead of that for CPU
                                           // devices

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
