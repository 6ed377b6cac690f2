// Animations of other programs, in USD and Alembic: frames have the strands of the first.
#include "ringlet/output/foreign/foreign_reader.h"

#include <algorithm>

#include "tests/fuzz/memory_file.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  constexpr int kMostFrames = 3;
  const MemoryFile file(bytes);
  for (const char* ending : {".usd", ".abc"}) {
    const auto path = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + ending);
    std::filesystem::create_symlink(file.path(), path);
    auto reader = ForeignReader::open(path, {});
    std::filesystem::remove(path);
    if (!reader) continue;
    std::vector<Vec3f> points;
    for (int frame = 1; frame <= std::min(reader->frameCount(), kMostFrames); ++frame) {
      if (!reader->readFrame(frame, points)) continue;
      demand(points.size() == reader->firstPoint().back(), "a frame has every particle");
      demandFinite(std::span<const Vec3f>(points));
    }
  }
}

}  // namespace ringlet::fuzz
