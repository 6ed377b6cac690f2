// What GLSL and C++ must agree on is one text, read by both: the files of this folder. This one has the types, and what
// all kernels have.
#ifndef RINGLET_LAYOUT_TYPES
#define RINGLET_LAYOUT_TYPES

#ifdef __cplusplus
#include <cstdint>
namespace ringlet::layout {
using uint = std::uint32_t;
struct alignas(16) vec4 {
  float x = 0, y = 0, z = 0, w = 0;
};
// In GLSL it is aligned to 16 bytes, and a float behind it fills them.
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

// Specialization constants: of every kernel that has one.
RINGLET_CONSTANT uint kSpecGroupSize = 0;  // invocations of a workgroup
RINGLET_CONSTANT uint kSpecTexels = 1;     // records are read as texels (shared/texels.glsl)
RINGLET_CONSTANT uint kSpecForGpu = 30;    // of contacts and volumes: the form for GPUs, and not for processors

#ifdef __cplusplus
}  // namespace ringlet::layout
#endif
#endif
