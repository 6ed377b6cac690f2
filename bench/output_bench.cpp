// What writing a frame costs: an animation's frames through every writer, and read back and compared. Times
// are medians over frames; CPU time is the process's. Run:
//   ringlet make head --strands 1000 --particles 64 -o head.obj
//   ringlet simulate head.obj --frames 240 --cache float32 --no-usd -o out
//   build/release/bench/output_bench out/hair.rgc
// It writes beside its input and removes what it wrote.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/clocks.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/usd/usd_reader.h"
#include "ringlet/output/usd/usd_writer.h"

namespace {

using namespace ringlet;
using Frames = std::vector<std::vector<Vec3f>>;

// Wall and CPU milliseconds of many calls.
struct Times {
  std::vector<double> wall, cpu;

  template <class Call>
  bool time(Call&& call) {
    const double wallBefore = bench::wallSeconds(), cpuBefore = bench::processCpuSeconds();
    const bool fine = call();
    cpu.push_back(1e3 * (bench::processCpuSeconds() - cpuBefore));
    wall.push_back(1e3 * (bench::wallSeconds() - wallBefore));
    return fine;
  }
};

int fail(const std::string& message) {
  fmt::print(stderr, "output_bench: {}\n", message);
  return 1;
}

double farthestApart(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, length(Vec3d(a[i]) - Vec3d(b[i])));
  return largest;
}

double pointCount(const Frames& frames) {
  return static_cast<double>(frames.size()) * static_cast<double>(frames[0].size());
}

void printRow(const char* name, const Times& write, const Times& read, double bytesOfAPoint, double apart,
              double bound) {
  fmt::print("{:<16}{:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f} {:>12.2f} {:>12.5f} {:>12.5f}\n", name,
             bench::median(write.wall), bench::median(write.cpu), bench::median(read.wall),
             bench::median(read.cpu), bytesOfAPoint, 1000 * apart, 1000 * bound);
  std::fflush(stdout);
}

template <class Writer>
std::string writeAll(Writer& writer, const Frames& frames, Times& times) {
  for (const auto& frame : frames) {
    if (!times.time([&] { return static_cast<bool>(writer.addFrame(frame)); }))
      return "a frame was not written";
  }
  const Status finished = writer.finish();
  return finished ? "" : finished.error().message;
}

std::string benchCache(const char* name, const std::filesystem::path& path, const Groom& groom,
                       CacheHeader header, CachePrecision precision, const Frames& frames) {
  header.precision = precision;
  Times write, read;
  auto writer = CacheWriter::create(path, groom, header);
  if (!writer) return writer.error().message;
  if (const std::string wrong = writeAll(*writer, frames, write); !wrong.empty()) return wrong;
  auto reader = CacheReader::open(path);
  if (!reader) return reader.error().message;
  std::vector<Vec3f> points;
  double apart = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (!read.time([&] { return static_cast<bool>(reader->readFrame(static_cast<int>(k) + 1, points)); }))
      return "a frame cannot be read";
    apart = std::max(apart, header.metresPerUnit * farthestApart(points, frames[k]));
  }
  if (apart > reader->errorBound()) return "a frame read back is farther off than the file says";
  printRow(name, write, read, static_cast<double>(writer->byteCount()) / pointCount(frames), apart,
           reader->errorBound());
  return "";
}

std::string benchUsd(const std::filesystem::path& path, const Groom& groom, const CacheHeader& header,
                     const Frames& frames) {
  Times write, read;
  auto writer = UsdWriter::create(path, groom,
                                  {.framesPerSecond = header.framesPerSecond,
                                   .metresPerUnit = header.metresPerUnit,
                                   .up = header.up,
                                   .diameter = header.diameter,
                                   .frameCount = static_cast<int>(frames.size())});
  if (!writer) return writer.error().message;
  if (const std::string wrong = writeAll(*writer, frames, write); !wrong.empty()) return wrong;
  const std::uint64_t bytes = std::filesystem::file_size(path);
  auto reader = UsdReader::open(path);
  if (!reader) return reader.error().message;
  std::vector<Vec3f> points;
  for (const auto& frame : frames) {
    if (!read.time([&] { return static_cast<bool>(reader->readFrame(points)); }))
      return "a frame cannot be read";
    if (farthestApart(points, frame) > 0) return "a frame read back is another";
  }
  printRow("USD text", write, read, static_cast<double>(bytes) / pointCount(frames), 0, 0);
  return "";
}

}  // namespace

int main(int argumentCount, char** arguments) {
  if (argumentCount != 2) return fail("name a cache, as out/hair.rgc");
  const std::filesystem::path input = arguments[1], output = input.string() + ".bench";
  auto reader = CacheReader::open(input);
  if (!reader) return fail(reader.error().message);
  Groom groom;
  groom.firstPoint = reader->firstPoint();
  Frames frames(static_cast<std::size_t>(reader->frameCount()));
  if (frames.empty()) return fail(input.string() + " holds no frame");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (Status read = reader->readFrame(static_cast<int>(k) + 1, frames[k]); !read)
      return fail(read.error().message);
  }

  fmt::print("{} frames of {} strands, {} particles\n", frames.size(), reader->strandCount(),
             reader->particleCount());
  fmt::print("{:<16}{:>10} {:>10} {:>10} {:>10} {:>12} {:>12} {:>12}\n", "", "write ms", "CPU ms", "read ms",
             "CPU ms", "bytes/point", "off by mm", "bound mm");
  std::string wrong = benchUsd(output, groom, reader->header(), frames);
  for (auto [name, precision] :
       {std::pair{"cache, float32", CachePrecision::float32}, {"cache, 16bit", CachePrecision::bits16}}) {
    if (wrong.empty()) wrong = benchCache(name, output, groom, reader->header(), precision, frames);
  }
  std::error_code ignored;
  std::filesystem::remove(output, ignored);
  return wrong.empty() ? 0 : fail(wrong);
}
