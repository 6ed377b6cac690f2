// Implements output/partial_frames.h.
#include "ringlet/output/partial_frames.h"

#include <fmt/format.h>

#include <system_error>

namespace ringlet {

Error framesKept(const Error& cause, std::size_t frameCount, const std::filesystem::path& partial) {
  if (frameCount == 0) return cause;
  return {fmt::format("{} (the first {} frames are kept in {})", cause.message, frameCount, partial.string()),
          cause.fault};
}

Error framesKept(const Error& cause, std::size_t frameCount, const ByteFile& partial) {
  return partial.isThere() ? framesKept(cause, frameCount, partial.path()) : cause;
}

Error cannotGoOn(const ByteFile& partial, int frameCount, const char* found) {
  return Error{fmt::format("cannot go on with {}: expected {} whole frames of this animation, found {}",
                           partial.path().string(), frameCount, found),
               Fault::input};
}

void removeWithoutFrames(const ByteFile& partial, std::size_t frameCount) {
  if (!partial.isOpen() || frameCount > 0 || !partial.isThere()) return;
  std::error_code ignored;
  std::filesystem::remove(partial.path(), ignored);
}

}  // namespace ringlet
