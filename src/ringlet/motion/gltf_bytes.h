// gltf_bytes: checks those bytes of a glTF file that TinyGLTF 2.7 trusts, so that it reads any file safely.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "ringlet/base/result.h"

namespace ringlet {

enum class GltfForm { text, binary };

/// Tells the form. Checks the chunks of a .glb (TinyGLTF lets the second one end beyond the file) and how
/// deep brackets are nested (it recurses into them); renames the members that name pictures and materials, so
/// that it does not look at them (it takes their addresses unseen, and refuses files over them).
/// `hidesMeshes`: those too.
Result<GltfForm> guardGltf(std::span<std::byte> bytes, bool hidesMeshes);

/// The JSON of a file that has passed.
std::string_view gltfText(std::span<const std::byte> bytes, GltfForm form);

}  // namespace ringlet
