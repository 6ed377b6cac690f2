// Implements frame_lines.h.
#include "program/simulate/frame_lines.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace ringlet::program {

void FrameLines::tell(int frame) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::string line =
      fmt::format("{{{}\"frame\": {}, \"frames\": {}, \"seconds\": {:.3f}, \"seconds_left\": {:.3f}}}\n",
                  run_ > 0 ? fmt::format("\"run\": {}, ", run_) : "", frame, count_, seconds,
                  seconds * (count_ - frame) / (frame - first_));
  // Errors are ignored: if nobody reads the lines, frames are written all the same.
  (void)std::fwrite(line.data(), 1, line.size(), stdout);
  (void)std::fflush(stdout);
}

}  // namespace ringlet::program
