// Caches: what is read is what was written, or within the bound the file states; whole, torn, spoilt, and on
// a full disk.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <random>

#include "ringlet/output/cache_reader.h"
#include "ringlet/output/cache_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::cache_test {
namespace {

using test::contains;
using test::readText;
using test::scratchFolder;
using test::writeText;

constexpr auto kBothPrecisions = {CachePrecision::float32, CachePrecision::bits16};

// Strands of every length from 1, curled, at seeded places, moved from frame to frame.
Groom curls(int strandCount, int mostParticles = 40) {
  Groom groom;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-20, 20);
  for (int s = 0; s < strandCount; ++s) {
    const Vec3f root{place(random), place(random), place(random)};
    std::vector<Vec3f> strand(1 + s % mostParticles);
    for (std::size_t i = 0; i < strand.size(); ++i) {
      const float along = static_cast<float>(i);
      strand[i] = root + Vec3f{std::sin(along), -0.4f * along, std::cos(along)};
    }
    groom.addStrand(strand);
  }
  return groom;
}

std::vector<Vec3f> frameOf(const Groom& groom, int frame) {
  auto points = groom.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].x += std::sin(static_cast<float>(frame) + 0.01f * static_cast<float>(i));
  return points;
}

void writeFrames(const std::filesystem::path& path, const Groom& groom, int frameCount,
                 CachePrecision precision, bool finishes = true) {
  auto writer = CacheWriter::create(path, groom, {.precision = precision});
  ASSERT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= frameCount; ++frame) {
    const Status added = writer->addFrame(frameOf(groom, frame));
    ASSERT_TRUE(added) << added.error().message;
  }
  if (!finishes) return;
  const Status finished = writer->finish();
  ASSERT_TRUE(finished) << finished.error().message;
}

bool hasSameBits(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0;
}

// The largest distance of two points of the same place in the row [unit].
double farthestApart(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, length(Vec3d(a[i]) - Vec3d(b[i])));
  return largest;
}

// The longest side of any strand's box [unit].
double longestSide(const Groom& groom, const std::vector<Vec3f>& points) {
  double longest = 0;
  for (std::size_t s = 0; s < groom.strandCount(); ++s) {
    for (auto axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
      double low = points[groom.firstPoint[s]].*axis, high = low;
      for (std::size_t i = groom.firstPoint[s]; i < groom.firstPoint[s + 1]; ++i) {
        low = std::min<double>(low, points[i].*axis);
        high = std::max<double>(high, points[i].*axis);
      }
      longest = std::max(longest, high - low);
    }
  }
  return longest;
}

// A file in memory: disks are slow for thousands of them.
class MemoryFile {
 public:
  MemoryFile() : file_(memfd_create("cache", 0)) {}
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }
  bool hold(const std::string& bytes) {
    return ftruncate(file_, 0) == 0 &&
           pwrite(file_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  }

 private:
  int file_;
};

TEST(Cache, Float32KeepsEveryBitAndTheHeader) {
  const auto path = scratchFolder("cache_bits") / "hair.rgc";
  const Groom groom = test::randomGroom(3, 200), awkward = test::awkwardGroom();
  for (const Groom* each : {&groom, &awkward}) {
    auto writer = CacheWriter::create(path, *each,
                                      {.precision = CachePrecision::float32,
                                       .up = UpAxis::z,
                                       .diameter = 0.1f,
                                       .framesPerSecond = 23.976,
                                       .metresPerUnit = 0.00254});
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(writer->addFrame(each->points));
    EXPECT_FALSE(std::filesystem::exists(path) && each == &groom) << "the name is for finished files";
    ASSERT_TRUE(writer->finish());
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
    EXPECT_EQ(writer->errorBound(), 0);
    EXPECT_EQ(writer->byteCount(), std::filesystem::file_size(path));

    auto reader = CacheReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_TRUE(reader->isFinished());
    EXPECT_TRUE(reader->warnings().empty());
    EXPECT_EQ(reader->frameCount(), 1);
    EXPECT_EQ(reader->firstPoint(), each->firstPoint);
    EXPECT_EQ(reader->errorBound(), 0);
    const CacheHeader& header = reader->header();
    EXPECT_EQ(header.precision, CachePrecision::float32);
    EXPECT_EQ(header.up, UpAxis::z);
    EXPECT_EQ(header.diameter, 0.1f);
    EXPECT_EQ(header.framesPerSecond, 23.976);
    EXPECT_EQ(header.metresPerUnit, 0.00254);
    std::vector<Vec3f> points;
    ASSERT_TRUE(reader->readFrame(1, points));
    EXPECT_TRUE(hasSameBits(points, each->points));
  }
}

TEST(Cache, AnyFrameInAnyOrder) {
  for (CachePrecision precision : kBothPrecisions) {
    const auto path = scratchFolder("cache_seek") / "hair.rgc";
    const Groom groom = curls(50);
    writeFrames(path, groom, 30, precision);
    auto reader = CacheReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_EQ(reader->frameCount(), 30);
    std::vector<Vec3f> points;
    for (int frame : {30, 1, 17, 17, 2, 29}) {
      ASSERT_TRUE(reader->readFrame(frame, points));
      const double most = reader->errorBound(frame) / reader->header().metresPerUnit;
      EXPECT_LE(farthestApart(points, frameOf(groom, frame)), most) << "frame " << frame;
      EXPECT_LT(most, 0.01) << "another frame is farther";
    }
  }
}

// A point is off by half a step along every axis at most, and a step is the longest side of a strand's box
// over 65,535.
TEST(Cache, SixteenBitsStayWithinTheStatedBound) {
  const auto path = scratchFolder("cache_bound") / "hair.rgc";
  const Groom groom = curls(500, 64);
  writeFrames(path, groom, 5, CachePrecision::bits16);
  auto reader = CacheReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= 5; ++frame) {
    const auto written = frameOf(groom, frame);
    ASSERT_TRUE(reader->readFrame(frame, points));
    const double bound = reader->errorBound(frame), unit = reader->header().metresPerUnit;
    const double apart = farthestApart(points, written) * unit;
    EXPECT_LE(apart, bound);
    EXPECT_GT(apart, 0.5 * bound) << "the bound is near what happens";
    EXPECT_LT(bound, unit * longestSide(groom, written) / 65535);
    EXPECT_GE(reader->errorBound(), bound);
  }
}

// Boxes from nothing to all that floats hold, points far from the origin, hair of one point.
TEST(Cache, SixteenBitsHoldForAnyFiniteNumbers) {
  const auto path = scratchFolder("cache_extremes") / "hair.rgc";
  std::vector<Groom> grooms{test::awkwardGroom(), test::randomGroom(8, 100)};
  for (float scale : {0.f, 1e-45f, 1e-38f, 1e-6f, 1.f, 1e30f}) {
    for (float away : {0.f, 1000.f, 1e9f}) {
      Groom groom;
      groom.addStrand(std::vector<Vec3f>{{away, 0, -away}});
      groom.addStrand(
          std::vector<Vec3f>{{away, 0, 3 * scale}, {away + scale, 7 * scale, 0}, {away, scale, 0}});
      grooms.push_back(groom);
    }
  }
  for (const Groom& groom : grooms) {
    auto writer = CacheWriter::create(path, groom, {.precision = CachePrecision::bits16, .metresPerUnit = 1});
    ASSERT_TRUE(writer && writer->addFrame(groom.points) && writer->finish());
    auto reader = CacheReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    std::vector<Vec3f> points;
    const Status read = reader->readFrame(1, points);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_LE(farthestApart(points, groom.points), reader->errorBound(1));
    EXPECT_EQ(reader->errorBound(), writer->errorBound());
  }
}

// A hostile file cannot make a reader take much memory, so what zstd makes tiny is stored as it is.
TEST(Cache, HairInOnePlaceIsStoredAndRead) {
  for (CachePrecision precision : kBothPrecisions) {
    const auto path = scratchFolder("cache_one_place") / "hair.rgc";
    Groom groom;
    groom.addStrand(std::vector<Vec3f>(100'000, Vec3f{}));
    auto writer = CacheWriter::create(path, groom, {.precision = precision});
    ASSERT_TRUE(writer && writer->addFrame(groom.points) && writer->finish());
    auto reader = CacheReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    std::vector<Vec3f> points;
    ASSERT_TRUE(reader->readFrame(1, points));
    EXPECT_TRUE(hasSameBits(points, groom.points));
  }
}

TEST(Cache, LeavesNothingWithoutAFrame) {
  const auto folder = scratchFolder("cache_none");
  { ASSERT_TRUE(CacheWriter::create(folder / "hair.rgc", curls(3), {})); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Cache, IsReadableAfterEveryFrame) {
  const auto path = scratchFolder("cache_partial") / "hair.rgc";
  const std::filesystem::path partial = path.string() + ".partial";
  const Groom groom = curls(20);
  {
    auto writer = CacheWriter::create(path, groom, {});
    ASSERT_TRUE(writer);
    for (int frame = 0; frame <= 4; ++frame) {
      if (frame > 0) {
        ASSERT_TRUE(writer->addFrame(frameOf(groom, frame)));
      }
      auto reader = CacheReader::open(partial);
      ASSERT_TRUE(reader) << reader.error().message;
      EXPECT_EQ(reader->frameCount(), frame);
      EXPECT_FALSE(reader->isFinished());
      EXPECT_TRUE(reader->warnings().empty()) << "nothing was lost";
    }
  }
  EXPECT_TRUE(std::filesystem::exists(partial)) << "frames that were finished are kept";
}

TEST(Cache, AKilledProgramLeavesItsFrames) {
  const auto path = scratchFolder("cache_killed") / "hair.rgc";
  const Groom groom = curls(20);
  const pid_t child = fork();
  if (child == 0) {
    auto writer = CacheWriter::create(path, groom, {});
    for (int frame = 1; frame <= 7; ++frame) {
      if (!writer || !writer->addFrame(frameOf(groom, frame))) _exit(1);
    }
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  auto reader = CacheReader::open(path.string() + ".partial");
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ(reader->frameCount(), 7);
  std::vector<Vec3f> points;
  ASSERT_TRUE(reader->readFrame(7, points));
  EXPECT_TRUE(hasSameBits(points, frameOf(groom, 7)));
}

// Cut at every byte: the frames before the cut are there, bit for bit, and what is lost is said.
TEST(Cache, ATornEndCostsOnlyItsFrame) {
  const auto folder = scratchFolder("cache_torn");
  const Groom groom = curls(4, 6);
  std::vector<std::uint64_t> ends;
  {
    auto writer = CacheWriter::create(folder / "hair.rgc", groom, {});
    ASSERT_TRUE(writer);
    ends.push_back(writer->byteCount());
    for (int frame = 1; frame <= 3; ++frame) {
      ASSERT_TRUE(writer->addFrame(frameOf(groom, frame)));
      ends.push_back(writer->byteCount());
    }
    ASSERT_TRUE(writer->finish());
  }
  const std::string whole = readText(folder / "hair.rgc");
  MemoryFile cut;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_TRUE(cut.hold(whole.substr(0, size)));
    auto reader = CacheReader::open(cut.path());
    if (size < ends[0]) {
      ASSERT_FALSE(reader) << size;
      continue;
    }
    ASSERT_TRUE(reader) << size << ": " << reader.error().message;
    const int expected =
        static_cast<int>(std::ranges::count_if(ends, [&](auto end) { return end <= size; })) - 1;
    ASSERT_EQ(reader->frameCount(), expected) << size;
    EXPECT_FALSE(reader->isFinished()) << size;
    EXPECT_EQ(reader->warnings().empty(), std::ranges::find(ends, size) != ends.end()) << size;
    std::vector<Vec3f> points;
    for (int frame = 1; frame <= expected; ++frame) {
      ASSERT_TRUE(reader->readFrame(frame, points));
      EXPECT_TRUE(hasSameBits(points, frameOf(groom, frame)));
    }
  }
  ASSERT_TRUE(cut.hold(whole.substr(0, ends[2] + 5)));
  auto reader = CacheReader::open(cut.path());
  ASSERT_TRUE(reader);
  EXPECT_TRUE(contains(reader->warnings().at(0), "dropped the last 5 bytes, 2 frames are whole"))
      << reader->warnings().at(0);
}

// As after a power cut, where the file's size is on the disk before its bytes.
TEST(Cache, ATornEndMayBeZeros) {
  const auto folder = scratchFolder("cache_zeros");
  const Groom groom = curls(10);
  writeFrames(folder / "hair.rgc", groom, 4, CachePrecision::float32, false);
  std::string bytes = readText(folder / "hair.rgc.partial");
  std::fill(bytes.end() - 100, bytes.end(), '\0');
  writeText(folder / "zeros.rgc", bytes);
  auto reader = CacheReader::open(folder / "zeros.rgc");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), 3);
  EXPECT_EQ(reader->warnings().size(), 1u);
}

TEST(Cache, ADamagedFrameLeavesTheOthers) {
  const auto folder = scratchFolder("cache_damaged");
  const Groom groom = curls(10);
  writeFrames(folder / "hair.rgc", groom, 4, CachePrecision::float32);
  std::string bytes = readText(folder / "hair.rgc");
  bytes[bytes.size() / 2] ^= 1;
  writeText(folder / "hair.rgc", bytes);
  auto reader = CacheReader::open(folder / "hair.rgc");
  ASSERT_TRUE(reader) << reader.error().message;
  ASSERT_EQ(reader->frameCount(), 4);
  int readable = 0;
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= 4; ++frame) {
    const Status read = reader->readFrame(frame, points);
    readable += read ? 1 : 0;
    if (!read) {
      EXPECT_TRUE(contains(read.error().message, "is damaged")) << read.error().message;
    }
  }
  EXPECT_EQ(readable, 3);
}

// One bit changed in any byte of a frame is found, also where unpacking does not notice it: each chunk has a
// checksum.
TEST(Cache, EveryDamagedByteOfAFrameIsFound) {
  const auto folder = scratchFolder("cache_every_byte");
  const Groom groom = curls(10, 12);
  for (CachePrecision precision : kBothPrecisions) {
    auto writer = CacheWriter::create(folder / "hair.rgc", groom, {.precision = precision});
    ASSERT_TRUE(writer && writer->addFrame(frameOf(groom, 1)));
    const std::uint64_t begin = writer->byteCount();
    ASSERT_TRUE(writer->addFrame(frameOf(groom, 2)));
    const std::uint64_t end = writer->byteCount();
    ASSERT_TRUE(writer->addFrame(frameOf(groom, 3)) && writer->finish());
    const std::string whole = readText(folder / "hair.rgc");
    MemoryFile damaged;
    for (std::uint64_t at = begin; at < end; ++at) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << at % 8));
      ASSERT_TRUE(damaged.hold(bytes));
      auto reader = CacheReader::open(damaged.path());
      ASSERT_TRUE(reader) << reader.error().message;
      std::vector<Vec3f> points;
      const Status read = reader->readFrame(2, points);
      ASSERT_FALSE(read) << "byte " << at - begin << " of " << end - begin;
      EXPECT_TRUE(contains(read.error().message, "is damaged")) << read.error().message;
      EXPECT_TRUE(reader->readFrame(1, points) && reader->readFrame(3, points));
    }
  }
}

TEST(Cache, ADamagedIndexIsMadeAnew) {
  const auto folder = scratchFolder("cache_index");
  const Groom groom = curls(10);
  writeFrames(folder / "hair.rgc", groom, 4, CachePrecision::bits16);
  std::string bytes = readText(folder / "hair.rgc");
  bytes[bytes.size() - 20] ^= 1;
  writeText(folder / "hair.rgc", bytes);
  auto reader = CacheReader::open(folder / "hair.rgc");
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), 4);
  EXPECT_FALSE(reader->isFinished());
  ASSERT_EQ(reader->warnings().size(), 1u);
  EXPECT_TRUE(contains(reader->warnings()[0], "index is damaged; its 4 frames were found"))
      << reader->warnings()[0];
}

TEST(Cache, KeepsFinishedFramesWhenTheDiskIsFull) {
  const auto path = scratchFolder("cache_full") / "hair.rgc";
  const Groom groom = test::randomGroom(4, 1000);

  // A limit on the size of a file stands in for the full disk; without the handler it would end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 300'000;
  setrlimit(RLIMIT_FSIZE, &small);
  int kept = 0;
  std::string message;
  {
    auto writer = CacheWriter::create(path, groom, {});
    for (; writer && kept < 10; ++kept) {
      if (Status added = writer->addFrame(groom.points); !added) {
        message = added.error().message;
        break;
      }
    }
  }
  setrlimit(RLIMIT_FSIZE, &before);

  ASSERT_GT(kept, 0);
  ASSERT_LT(kept, 10);
  const std::string partial = path.string() + ".partial";
  EXPECT_TRUE(contains(message, "the first " + std::to_string(kept) + " frames are kept in " + partial))
      << message;
  auto reader = CacheReader::open(partial);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->frameCount(), kept);
  EXPECT_TRUE(reader->warnings().empty()) << "the torn frame was cut off";
}

TEST(Cache, SaysWhichFileAndWhy) {
  const auto folder = scratchFolder("cache_wrong");
  auto missing = CacheWriter::create(folder / "no" / "hair.rgc", curls(3), {});
  ASSERT_FALSE(missing);
  EXPECT_TRUE(contains(missing.error().message, "No such file")) << missing.error().message;

  writeFrames(folder / "good.rgc", curls(3), 1, CachePrecision::float32);
  const std::string good = readText(folder / "good.rgc");
  std::string newer = good, changed = good;
  newer[8] = 9;
  changed[30] ^= 1;
  struct Case {
    std::string name, bytes, message;
  };
  for (const Case& c : {Case{"empty.rgc", "", "has 0 bytes"},
                        Case{"text.rgc", "#usda 1.0\n(\n    defaultPrim = \"Hair\"\n    endTimeCode = 1\n",
                             "does not begin as"},
                        Case{"newer.rgc", newer, "version"}, Case{"changed.rgc", changed, "damaged header"},
                        Case{"cut.rgc", good.substr(0, 60), "ends before its strands"}}) {
    writeText(folder / c.name, c.bytes);
    auto reader = CacheReader::open(folder / c.name);
    ASSERT_FALSE(reader) << c.name;
    EXPECT_TRUE(contains(reader.error().message, c.name)) << reader.error().message;
    EXPECT_TRUE(contains(reader.error().message, c.message)) << reader.error().message;
  }
  EXPECT_TRUE(contains(CacheReader::open(folder).error().message, "is a folder"));
  EXPECT_TRUE(contains(CacheReader::open(folder / "none.rgc").error().message, "No such file"));
}

// Makes checksums right again, so that spoilt numbers get past them: of the header, and of chunk by chunk as
// far as the chunks lead.
void mend(std::string& bytes) {
  const auto put = [&](std::size_t at, std::size_t begin, std::size_t end) {
    const auto sum = static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()) + begin, end - begin));
    std::memcpy(bytes.data() + at, &sum, 4);
  };
  if (bytes.size() < 48) return;
  put(44, 0, 44);
  for (std::size_t at = 48; bytes.size() - at >= 32;) {
    std::uint64_t stored = 0;
    std::memcpy(&stored, bytes.data() + at + 16, 8);
    if (stored > bytes.size() - at - 32) return;
    put(at, at + 4, at + 32 + stored);
    at += 32 + stored;
  }
}

// Thousands of spoilt files, half of them with right checksums: finite frames, or an error. Run it with
// sanitizers too.
TEST(Cache, SpoiltFilesNeitherCrashNorTakeMemory) {
  const auto folder = scratchFolder("cache_spoilt");
  const Groom groom = curls(6, 5);
  MemoryFile bad;
  int readable = 0, refused = 0;
  for (CachePrecision precision : kBothPrecisions) {
    writeFrames(folder / "good.rgc", groom, 3, precision);
    const std::string good = readText(folder / "good.rgc");
    std::mt19937 random(20240602);
    const auto below = [&](std::size_t count) { return random() % count; };
    for (int i = 0; i < 6000; ++i) {
      std::string bytes = good;
      for (std::size_t change = 1 + below(4); change > 0 && !bytes.empty(); --change) {
        const std::size_t at = below(bytes.size()),
                          count = below(std::min<std::size_t>(bytes.size() - at, 40));
        switch (below(6)) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
            break;
          case 2:  // a count, a size or an offset, made huge
            for (std::size_t k = at; k < std::min(at + 8, bytes.size()); ++k)
              bytes[k] = "\0\x7f\xff\x01"[below(4)];
            break;
          case 3:
            bytes.erase(at, count);
            break;
          case 4:
            bytes.insert(at, bytes.substr(below(bytes.size()), count));
            break;
          case 5:
            if (below(4) == 0) bytes.resize(at);
            break;
        }
      }
      if (i % 2 == 0) mend(bytes);
      ASSERT_TRUE(bad.hold(bytes));
      auto reader = CacheReader::open(bad.path());
      if (!reader) {
        ASSERT_GT(reader.error().message.size(), 10u) << "file " << i;
        ++refused;
        continue;
      }
      std::vector<Vec3f> points;
      for (int frame = 1; frame <= std::min(reader->frameCount(), 10); ++frame) {
        ASSERT_TRUE(std::isfinite(reader->errorBound(frame)));
        if (!reader->readFrame(frame, points)) continue;
        ++readable;
        ASSERT_EQ(points.size(), reader->particleCount());
        for (Vec3f p : points) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      }
    }
  }
  EXPECT_GT(readable, 1000);
  EXPECT_GT(refused, 1000);
}

// A few kilobytes that say they are four thousand million strands, or one strand of as many particles.
TEST(Cache, HostileCountsTakeNoMemory) {
  const auto folder = scratchFolder("cache_hostile");
  writeFrames(folder / "good.rgc", curls(3), 1, CachePrecision::float32);
  const std::string good = readText(folder / "good.rgc");
  for (const auto& [at, value] :
       {std::pair{48 + 8, 0xffffffffu}, {48 + 32, 0xfffffff0u}, {48 + 16, 0xffffffffu}}) {
    std::string bytes = good;
    std::memcpy(bytes.data() + at, &value, 4);
    mend(bytes);
    writeText(folder / "bad.rgc", bytes);
    const test::MemoryLimit limit(512u << 20);
    auto reader = CacheReader::open(folder / "bad.rgc");
    std::vector<Vec3f> points;
    const bool hasRead = reader && reader->frameCount() > 0 && reader->readFrame(1, points);
    EXPECT_FALSE(hasRead) << at;
  }
}

}  // namespace
}  // namespace ringlet::cache_test
