// Animations as Alembic archives.
#include "ringlet/output/alembic/abc_reader.h"

#include "tests/fuzz/memory_file.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 16 << 20, .perByte = 1024};

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  auto reader = AbcReader::open(file.path());
  if (!reader) return;
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= reader->frameCount(); ++frame) {
    if (!reader->readFrame(frame, points)) continue;
    demand(points.size() == reader->firstPoint().back(), "a frame has every particle");
    demandFinite(std::span<const Vec3f>(points));
  }
}

}  // namespace ringlet::fuzz
