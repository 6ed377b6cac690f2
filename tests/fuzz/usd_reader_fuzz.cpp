// Animations as USD text.
#include "ringlet/output/usd/usd_reader.h"

#include <numeric>

#include "tests/fuzz/memory_file.h"

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 64};

namespace {

void tryFile(const std::filesystem::path& path) {
  auto reader = UsdReader::open(path);
  if (!reader) return;
  const auto& counts = reader->particleCounts();
  const std::uint64_t particles = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  std::vector<Vec3f> points;
  while (true) {
    const auto more = reader->readFrame(points);
    if (!more || !*more) break;
    demand(points.size() == particles, "a frame has every particle");
    demandFinite(std::span<const Vec3f>(points));
  }
}

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  tryFile(file.path());
  // And as a killed run's, whose end may be torn.
  const auto partial = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + ".usda.partial");
  std::filesystem::create_symlink(file.path(), partial);
  tryFile(partial);
  std::filesystem::remove(partial);
}

}  // namespace ringlet::fuzz
