// Accessors of a glTF file as numbers: every index and size that TinyGLTF found is checked, and every number
// becomes a double.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"

// Under a name of our own: a program that uses Ringlet may hold a TinyGLTF too.
#define tinygltf ringlet_tinygltf
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace ringlet {

namespace gltf = ringlet_tinygltf;

/// The index as it is said, if it is below the count.
inline std::optional<std::size_t> indexOf(int index, std::size_t count) {
  if (index < 0 || static_cast<std::size_t>(index) >= count) return std::nullopt;
  return static_cast<std::size_t>(index);
}

/// The numbers of an accessor, element after element.
struct Numbers {
  std::size_t width = 0, count = 0;
  std::vector<double> values;

  Vec3d vec3(std::size_t i) const { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }
};

/// Elements of `width` numbers. Errors: an accessor, view or buffer that is not there, elements of another
/// width or beyond their buffer, numbers that are not finite; `what` they are begins the sentence.
Result<Numbers> readAccessor(const gltf::Model& model, int accessor, std::size_t width,
                             std::string_view what);

}  // namespace ringlet
