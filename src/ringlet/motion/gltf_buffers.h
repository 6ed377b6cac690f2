// gltf_buffers: the files that a glTF file names for its buffers. They are in the file's own folder or below
// it; a file of a stranger reads nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

struct GltfBuffer {
  std::filesystem::path file;   // the folder / the name
  std::uint64_t byteCount = 0;  // as the glTF file states
};

/// The bytes that a URI's %NN stand for.
std::string decodedUri(std::string_view uri);

/// Of the text of a glTF file in a folder ("": the current one), in its order; those that are inside it left
/// out. Nothing where it is no JSON. Errors: a name that is absolute, has a scheme, a backslash or a NUL, or
/// leads out of the folder, symbolic links followed.
Result<std::vector<GltfBuffer>> gltfBuffersOf(std::string_view json, const std::filesystem::path& folder);

/// The same for a file; none where it cannot be read, which its reader says. Reads the file, and none of its
/// buffers.
std::vector<std::filesystem::path> gltfBufferFiles(const std::filesystem::path& path);

/// That each is a regular file of the size that is stated, before any is read.
Status checkGltfBuffers(std::span<const GltfBuffer> buffers);

}  // namespace ringlet
