// Animations whose writer was killed, at every byte: USD text is whole all the time, every whole frame is
// read back from whatever a file was cut to, and a writer goes on with it to the bytes of a file written in
// one go.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/groom/usd/usdc_format.h"
#include "ringlet/output/alembic/abc_reader.h"
#include "ringlet/output/alembic/abc_writer.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/cache_writer.h"
#include "ringlet/output/usd/usd_reader.h"
#include "ringlet/output/usd/usd_writer.h"
#include "ringlet/output/usd/usdc_reader.h"
#include "ringlet/output/usd/usdc_writer.h"
#include "tests/support/strict_usd.h"
#include "tests/support/test_support.h"

namespace {
int writesLeft = -1;  // after so many the process ends; -1: it does not
}

// In place of the C library's.
extern "C" ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset) {
  if (writesLeft == 0) _exit(0);
  writesLeft -= writesLeft > 0;
  return syscall(SYS_pwrite64, file, bytes, count, offset);
}

namespace ringlet::torn_files_test {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::readUsd;
using test::scratchFolder;

constexpr int kFrames = 4;

void putText(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

Groom groomOf(int frame, int pointCount = 3) {
  Groom groom;
  for (int s = 0; s < 2; ++s) {
    std::vector<Vec3f> strand;
    for (int i = 0; i < pointCount; ++i)
      strand.push_back({0.1f * static_cast<float>(i + s), -1.5f * static_cast<float>(i),
                        0.37f * static_cast<float>(frame)});
    groom.addStrand(strand);
  }
  return groom;
}

AnimationOptions options(int frames) { return {.diameter = 0.05f, .frameCount = frames}; }

// Bytes [begin, end) that differ between two states of a file, within the shorter; places closer than `gap`
// are one.
struct Change {
  std::size_t begin, end;
};
std::vector<Change> changesOf(const std::string& before, const std::string& after, std::size_t gap = 64) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    if (before[i] == after[i]) continue;
    if (changes.empty() || i > changes.back().end + gap) changes.push_back({i, i});
    changes.back().end = i + 1;
  }
  return changes;
}

// Every frame changes three places of what was there, the last of them with the first byte that is appended;
// each place is within a page of the file, so that a kill leaves it as it was or as it is.
TEST(TornFiles, WhatIsPatchedIsWithinAPage) {
  const fs::path path = scratchFolder("torn_pages") / "hair.usda";
  constexpr int kMany = 3000;
  auto writer = UsdWriter::create(path, groomOf(0), options(kMany));
  ASSERT_TRUE(writer);
  int moved = 0;
  for (int frame = 1; frame <= kMany; ++frame) {
    const std::string before = frame % 100 == 1 ? readText(path.string() + ".partial") : "";
    const std::uint64_t end =
        writer->byteCount();  // of "};}", its line break; then the next line's first byte
    EXPECT_EQ((end - 4) / ByteFile::kPage, end / ByteFile::kPage) << "frame " << frame;
    moved += (end - 4) % ByteFile::kPage == 0;
    ASSERT_TRUE(writer->addFrame(groomOf(frame).points));
    if (before.empty()) continue;
    ASSERT_EQ(before.size(), end);
    const auto changes = changesOf(before, readText(path.string() + ".partial"));
    ASSERT_EQ(changes.size(), 3u) << "time code, extent, end";
    EXPECT_EQ(changes[0].begin / ByteFile::kPage, (changes[0].end - 1) / ByteFile::kPage);
    EXPECT_EQ(changes[1].begin / ByteFile::kPage, (changes[1].end - 1) / ByteFile::kPage);
    EXPECT_GE(changes[2].begin, end - 4);
  }
  EXPECT_GT(moved, 0) << "no end came near a page's, and nothing was tested";
}

// The states a file goes through while frame 2 is added, but for those within one small write.
TEST(TornFiles, UsdTextIsWholeAllTheTime) {
  const fs::path path = scratchFolder("torn_usd") / "hair.usda", partial = path.string() + ".partial";
  auto writer = UsdWriter::create(path, groomOf(0), options(kFrames));
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->addFrame(groomOf(1).points));
  const std::string before = readText(partial);
  ASSERT_TRUE(writer->addFrame(groomOf(2).points));
  const std::string after = readText(partial);
  const auto changes = changesOf(before, after);
  ASSERT_EQ(changes.size(), 3u);
  const fs::path state = path.parent_path() / "state.usda.partial";
  const auto expectFrames = [&](const std::string& text, std::size_t frames, const std::string& where) {
    putText(state, text);
    try {
      EXPECT_EQ(readUsd(state).points.size(), frames) << where;
    } catch (const std::exception& fault) {
      ADD_FAILURE() << where << ": " << fault.what();
    }
    const auto reader = UsdReader::open(state);
    ASSERT_TRUE(reader) << where << ": " << reader.error().message;
    EXPECT_EQ(reader->frameCount(), static_cast<int>(frames)) << where;
    EXPECT_TRUE(reader->warnings().empty()) << where;
  };

  // The line grows behind the end.
  std::string line = after.substr(before.size());
  line[0] = '#';
  for (std::size_t size = 0; size <= line.size(); ++size)
    expectFrames(before + line.substr(0, size), 1, std::to_string(size) + " bytes of the line");
  // Then the patches: extent, end, time code.
  std::string text = before + line;
  const auto patch = [&](const Change& change) {
    text.replace(change.begin, change.end - change.begin, after, change.begin, change.end - change.begin);
  };
  patch(changes[1]);
  expectFrames(text, 1, "with its extent");
  patch(changes[2]);
  text[before.size()] = after[before.size()];
  expectFrames(text, 2, "made to hold");
  patch(changes[0]);
  expectFrames(text, 2, "with its time code");
  EXPECT_EQ(text, after);
}

// The same from outside: the system ends the writer at every byte that a file may not grow beyond.
TEST(TornFiles, AWriterMayBeKilledAtEveryByte) {
  const fs::path path = scratchFolder("torn_kill") / "hair.usda", partial = path.string() + ".partial";
  const auto write = [&](int frames) {
    auto writer = UsdWriter::create(path, groomOf(0), options(kFrames));
    for (int frame = 1; frame <= frames; ++frame) (void)writer->addFrame(groomOf(frame).points);
    return fs::file_size(partial);
  };
  const auto one = write(1), two = write(2);
  for (auto limit = one; limit <= two; ++limit) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_DFL);
      const struct rlimit most { limit, limit };
      const struct rlimit noCore { 0, 0 };
      setrlimit(RLIMIT_CORE, &noCore);
      setrlimit(RLIMIT_FSIZE, &most);
      write(2);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_EQ(WIFSIGNALED(status), limit < two) << limit;
    ASSERT_EQ(fs::file_size(partial), limit);
    const std::size_t expected = limit < two ? 1 : 2;
    EXPECT_EQ(readUsd(partial).points.size(), expected) << limit;
    const auto reader = UsdReader::open(partial);
    ASSERT_TRUE(reader) << limit << ": " << reader.error().message;
    EXPECT_EQ(reader->frameCount(), static_cast<int>(expected)) << limit;
  }
}

// A format with what tests need of it.
struct Format {
  const char* name;
  std::function<void(const fs::path&, int frames, bool finishes)> write;  // from the beginning
  std::function<Status(const fs::path&, int from, int to)> resume;        // and finish
  std::function<int(const fs::path&, std::string& warning)> wholeFrames;  // read back, each checked
};

template <class Writer, class Header>
Format formatOf(const char* name, const Header& header,
                std::function<int(const fs::path&, std::string&)> wholeFrames) {
  const auto add = [](Writer& writer, int frame) { return writer.addFrame(groomOf(frame).points); };
  return {name,
          [=](const fs::path& path, int frames, bool finishes) {
            auto writer = Writer::create(path, groomOf(0), header);
            for (int frame = 1; frame <= frames; ++frame) EXPECT_TRUE(add(*writer, frame));
            if (finishes) {
              EXPECT_TRUE(writer->finish());
            }
          },
          [=](const fs::path& path, int from, int to) -> Status {
            auto writer = Writer::resume(path, groomOf(0), header, from);
            if (!writer) return writer.error();
            for (int frame = from + 1; frame <= to; ++frame) EXPECT_TRUE(add(*writer, frame));
            return writer->finish();
          },
          std::move(wholeFrames)};
}

std::vector<Format> formats() {
  const auto usdFrames = [](const fs::path& path, std::string& warning) {
    auto reader = UsdReader::open(path);
    if (!reader) return -1;
    std::vector<Vec3f> points;
    int frames = 0;
    for (auto more = reader->readFrame(points); more && *more; more = reader->readFrame(points))
      EXPECT_EQ(points, groomOf(++frames).points);
    EXPECT_EQ(frames, reader->frameCount());
    if (!reader->warnings().empty()) warning = reader->warnings().front();
    return frames;
  };
  const auto framesOf = [](auto reader, std::string& warning) {
    if (!reader) return -1;
    std::vector<Vec3f> points;
    for (int frame = 1; frame <= reader->frameCount(); ++frame) {
      EXPECT_TRUE(reader->readFrame(frame, points));
      EXPECT_EQ(points, groomOf(frame).points);
    }
    if (!reader->warnings().empty()) warning = reader->warnings().front();
    return reader->frameCount();
  };
  const auto cacheFrames = [&](const fs::path& path, std::string& warning) {
    return framesOf(CacheReader::open(path), warning);
  };
  const auto crateFrames = [&](const fs::path& path, std::string& warning) {
    return framesOf(UsdcReader::open(path), warning);
  };
  const auto archiveFrames = [&](const fs::path& path, std::string& warning) {
    return framesOf(AbcReader::open(path), warning);
  };
  AnimationOptions more = options(kFrames);  // with a head that rests, so that its transform changes no bit
  more.usd = {
      .tipDiameter = 0.01f, .ids = true, .rest = true, .velocities = true, .head = UsdHead::transform};
  return {formatOf<UsdWriter>("hair.usda", options(kFrames), usdFrames),
          formatOf<UsdWriter>("more.usda", more, usdFrames),
          formatOf<UsdcWriter>("hair.usdc", options(kFrames), crateFrames),
          formatOf<UsdcWriter>("more.usdc", more, crateFrames),
          formatOf<AbcWriter>("hair.abc", options(kFrames), archiveFrames),
          formatOf<AbcWriter>("more.abc", more, archiveFrames),
          formatOf<CacheWriter>("hair.rgc", CacheHeader{}, cacheFrames)};
}

TEST(TornFiles, EveryWholeFrameIsReadAndGoneOnWith) {
  for (const Format& format : formats()) {
    SCOPED_TRACE(format.name);
    const fs::path folder = scratchFolder(std::string("torn_") + format.name);
    const fs::path path = folder / format.name, partial = path.string() + ".partial";
    format.write(path, kFrames, true);
    const std::string finished = readText(path);
    fs::remove(path);
    format.write(path, 2, false);
    const std::size_t two = fs::file_size(partial);
    format.write(path, kFrames, false);
    const std::string whole = readText(partial);
    ASSERT_GT(whole.size(), two + 100);

    int most = 0;
    for (std::size_t size = two; size <= whole.size(); ++size) {
      putText(partial, std::string_view(whole).substr(0, size));
      std::string warning;
      const int frames = format.wholeFrames(partial, warning);
      EXPECT_GE(frames, 2) << size;
      EXPECT_GE(frames, most) << size << ": more bytes and fewer frames";
      most = std::max(most, frames);
      if (size == whole.size()) {
        EXPECT_EQ(warning, "");
      }
      const Status resumed = format.resume(path, 2, kFrames);
      ASSERT_TRUE(resumed) << size << ": " << resumed.error().message;
      EXPECT_TRUE(readText(path) == finished) << size;
      fs::remove(path);
    }
    EXPECT_EQ(most, kFrames);

    // From every frame on, also from none; and where the run was ended while it gave files their names.
    for (int from = 0; from <= kFrames; ++from) {
      putText(partial, whole);
      ASSERT_TRUE(format.resume(path, from, kFrames)) << from;
      EXPECT_TRUE(readText(path) == finished) << from;
      ASSERT_TRUE(format.resume(path, std::max(from, 1), kFrames)) << "of a finished file, from " << from;
      EXPECT_TRUE(readText(path) == finished) << from;
      fs::remove(path);
    }
    // And no further: nothing of what came after is left.
    format.write(path, 2, true);
    const std::string shorter = readText(path);
    fs::remove(path);
    putText(partial, whole);
    ASSERT_TRUE(format.resume(path, 2, 2));
    EXPECT_TRUE(readText(path) == shorter);
    fs::remove(path);
    // Not from fewer, nor from another animation's.
    putText(partial, std::string_view(whole).substr(0, two));
    const Status fewer = format.resume(path, 3, kFrames);
    ASSERT_FALSE(fewer);
    EXPECT_NE(fewer.error().message.find("cannot go on with"), std::string::npos) << fewer.error().message;
    EXPECT_TRUE(readText(partial) == whole.substr(0, two)) << "what was refused was changed";
    std::string other = whole;
    other[40] ^= 1;
    putText(partial, other);
    EXPECT_FALSE(format.resume(path, 2, kFrames));
    EXPECT_TRUE(readText(partial) == other);
  }
}

// Of a frame that has points a crate has all else that is of the frame; velocities come with the next.
void expectWholeFrames(const fs::path& path, const std::string& where) {
  const std::string text = readText(path);
  const auto bytes = std::as_bytes(std::span(text));
  const auto layer =
      readUsdc(std::vector<std::byte>(bytes.begin(), bytes.end()), path.string(), {.keepsPlaces = true});
  ASSERT_TRUE(layer) << where << ": " << layer.error().message;
  const auto hasValue = [&](const std::string& name, std::size_t frame) {
    for (const UsdAttribute& attribute : layer->prims.front().attributes)
      if (attribute.name == name && !attribute.places.empty())
        return usdc::Rep{attribute.places.at(frame).rep}.type() != usdc::kBlockType;
    return true;  // it does not move
  };
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    if (!hasValue("points", frame)) continue;
    for (const char* name : {"extent", "xformOp:transform"})
      EXPECT_TRUE(hasValue(name, frame)) << where << ": frame " << frame + 1 << " has points and no " << name;
  }
}

// Of an archive everything that it counts is there, and all that moves is counted alike; velocities come with
// the next frame.
void expectWholeArchive(const fs::path& path, int frames, const std::string& where) {
  const std::string text = readText(path);
  const auto archive = AbcArchive::of(std::as_bytes(std::span(text)), path.string());
  ASSERT_TRUE(archive) << where << ": " << archive.error().message;
  ASSERT_EQ(archive->objects().size(), 3u) << where;
  const std::function<void(const Result<std::vector<AbcProperty>>&)> expectAll =
      [&](const Result<std::vector<AbcProperty>>& properties) {
        ASSERT_TRUE(properties) << where << ": " << properties.error().message;
        for (const AbcProperty& property : *properties) {
          if (property.kind == AbcKind::compound) {
            expectAll(archive->propertiesOf(property));
            continue;
          }
          for (std::uint32_t k = 0; k < property.storedCount(); ++k) {
            const auto sample = archive->stored(property, k);
            EXPECT_TRUE(sample) << where << ": " << sample.error().message;
            EXPECT_TRUE(sample && !sample->bytes().empty()) << where << ": " << property.path();
          }
          if (property.sampling == 0) continue;
          const bool isLater = property.name == ".velocities";
          EXPECT_TRUE(static_cast<int>(property.sampleCount) == frames ||
                      (isLater && static_cast<int>(property.sampleCount) == std::max(frames - 1, 0)))
              << where << ": " << property.path() << " has " << property.sampleCount << " samples of "
              << frames;
        }
      };
  for (std::uint32_t object = 0; object < archive->objects().size(); ++object)
    expectAll(archive->propertiesOf(object));
}

// By the order of what is patched: a frame is there once all of it is.
TEST(TornFiles, AWriterMayBeKilledBetweenAnyTwoWrites) {
  for (const Format& format : formats()) {
    SCOPED_TRACE(format.name);
    const fs::path path = scratchFolder(std::string("torn_writes_") + format.name) / format.name,
                   partial = path.string() + ".partial";
    int most = -1, killed = 0;  // -1: it is no file of the format yet
    for (;; ++killed) {
      const pid_t child = fork();
      if (child == 0) {
        writesLeft = killed;
        format.write(path, kFrames, true);
        _exit(1);
      }
      int status = 0;
      waitpid(child, &status, 0);
      ASSERT_TRUE(WIFEXITED(status));
      std::string warning;
      if (WEXITSTATUS(status) == 1) {
        most = std::max(most, format.wholeFrames(path, warning));  // the last write may be that of a frame
        break;
      }
      if (!fs::exists(partial)) continue;
      const int frames = format.wholeFrames(partial, warning);
      const std::string where = "after " + std::to_string(killed) + " writes";
      EXPECT_GE(frames, most) << where;
      EXPECT_TRUE(warning.empty() || frames == kFrames) << where << ": " << warning;
      most = std::max(most, frames);
      if (std::string_view(format.name).ends_with(".usdc") && frames >= 0) expectWholeFrames(partial, where);
      if (std::string_view(format.name).ends_with(".abc") && frames >= 0)
        expectWholeArchive(partial, frames, where);
    }
    EXPECT_EQ(most, kFrames);
    EXPECT_GE(killed, kFrames);
  }
}

// So may one that goes on with a file, or with a finished one: the frames up to there are never lost, and the
// next writer comes to the same bytes.
TEST(TornFiles, AWriterThatGoesOnMayBeKilledBetweenAnyTwoWrites) {
  for (const Format& format : formats()) {
    if (!std::string_view(format.name).ends_with(".abc")) continue;
    for (const bool wasFinished : {false, true}) {
      for (const int from : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message()
                     << format.name << " from " << from << (wasFinished ? ", finished" : ""));
        const fs::path path = scratchFolder(std::string("torn_again_") + format.name) / format.name,
                       partial = path.string() + ".partial";
        format.write(path, kFrames, true);
        const std::string finished = readText(path);
        int killed = 0;
        for (;; ++killed) {
          fs::remove(path);
          fs::remove(partial);
          format.write(path, 3, wasFinished);
          const pid_t child = fork();
          if (child == 0) {
            writesLeft = killed;
            (void)format.resume(path, from, kFrames);
            _exit(1);
          }
          int status = 0;
          waitpid(child, &status, 0);
          ASSERT_TRUE(WIFEXITED(status));
          if (WEXITSTATUS(status) == 1) break;
          const std::string where = "after " + std::to_string(killed) + " writes";
          const fs::path left = fs::exists(partial) ? partial : path;
          std::string warning;
          const int frames = format.wholeFrames(left, warning);
          EXPECT_GE(frames, from) << where;
          EXPECT_TRUE(warning.empty()) << where << ": " << warning;
          expectWholeArchive(left, frames, where);
          ASSERT_TRUE(format.resume(path, from, kFrames)) << where;
          EXPECT_TRUE(readText(path) == finished) << where;
        }
        EXPECT_GE(killed, 10);
      }
    }
  }
}

TEST(TornFiles, AFileHasOneWriter) {
  const fs::path path = scratchFolder("torn_two") / "hair.usda";
  const auto first = UsdWriter::create(path, groomOf(0), options(2));
  ASSERT_TRUE(first);
  const std::string before = readText(path.string() + ".partial");
  const auto second = UsdWriter::create(path, groomOf(0, 5), options(7));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().fault, Fault::busy);
  EXPECT_EQ(readText(path.string() + ".partial"), before);
}

}  // namespace
}  // namespace ringlet::torn_files_test
