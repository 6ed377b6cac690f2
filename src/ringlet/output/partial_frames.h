// What all writers of animations say and do about PATH.partial and the frames in it.
#pragma once

#include <cstddef>
#include <filesystem>

#include "ringlet/base/result.h"
#include "ringlet/output/byte_file.h"

namespace ringlet {

/// The cause, with where the frames before it are; the cause alone if there are none.
Error framesKept(const Error& cause, std::size_t frameCount, const std::filesystem::path& partial);
/// The same, unless somebody has taken the file away.
Error framesKept(const Error& cause, std::size_t frameCount, const ByteFile& partial);

/// A file with which an animation cannot go on after so many frames; `found`: in place of them.
Error cannotGoOn(const ByteFile& partial, int frameCount, const char* found = "another file or fewer");

/// Of a writer that ends without finish(): removes the file if it holds no frame. Nothing is done for one
/// that is closed, or somebody else's by now.
void removeWithoutFrames(const ByteFile& partial, std::size_t frameCount);

}  // namespace ringlet
