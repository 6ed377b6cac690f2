// groom/groom_file.h: the choice by extension, files that are not there or cannot be written, and nothing
// half-written.
#include "ringlet/groom/groom_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <string>

#include "ringlet/groom/generate.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::groom_file_test {
namespace {

using test::contains;

void expectReadError(const std::filesystem::path& path, const std::string& part) {
  const Result<LoadedGroom> loaded = readGroom(path);
  ASSERT_FALSE(loaded) << path;
  EXPECT_TRUE(contains(loaded.error().message, part)) << loaded.error().message;
  EXPECT_TRUE(contains(loaded.error().message, path.string())) << loaded.error().message;
}

void expectWriteError(const std::filesystem::path& path, const Groom& groom, const std::string& part) {
  const Status status = writeGroom(path, groom);
  ASSERT_FALSE(status) << path;
  EXPECT_TRUE(contains(status.error().message, part)) << status.error().message;
  EXPECT_TRUE(contains(status.error().message, path.string())) << status.error().message;
}

TEST(GroomFile, ChoosesByExtensionInAnyCase) {
  const auto folder = test::scratchFolder("groom_file");
  for (const char* name : {"a.hair", "b.HAIR", "c.obj", "d.Obj", "e.f.obj", "g.ply", "h.abc", "i.ABC"}) {
    ASSERT_TRUE(writeGroom(folder / name, test::awkwardGroom())) << name;
    const Result<LoadedGroom> loaded = readGroom(folder / name);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(test::hasSameBits(loaded->groom, test::awkwardGroom())) << name;
  }
  EXPECT_EQ(test::readText(folder / "b.HAIR").substr(0, 4), "HAIR");
  EXPECT_EQ(test::readText(folder / "d.Obj").substr(0, 1), "#");
}

TEST(GroomFile, SaysWhatIsSupported) {
  for (const char* name : {"a.xyz", "a", ".hair", ".tfx", "a.hair.gz", ""}) {
    expectReadError(name,
                    "supported are .hair, .obj, .usda, .usdc, .usd, .usdz, .abc, .tfx, .ply, .data and .bin");
    EXPECT_FALSE(isGroomFile(name));
    expectWriteError(name, test::awkwardGroom(), "supported are .hair, .obj, .ply and .abc");
  }
}

TEST(GroomFile, RefusesWhatIsNoFile) {
  const auto folder = test::scratchFolder("groom_no_file");
  for (const char* extension :
       {".hair", ".obj", ".tfx", ".usda", ".usdc", ".usd", ".usdz", ".abc", ".ply", ".data", ".bin"}) {
    expectReadError(folder / ("missing" + std::string(extension)), "No such file");
    expectReadError(folder / "nowhere" / ("a" + std::string(extension)), "No such file");
    const auto inner = folder / ("folder" + std::string(extension));
    std::filesystem::create_directory(inner);
    expectReadError(inner, "is a folder");
    const auto empty = folder / ("empty" + std::string(extension));
    test::writeText(empty, "");
    expectReadError(empty, "expected");
    std::filesystem::create_symlink("/dev/zero", folder / ("device" + std::string(extension)));
    expectReadError(folder / ("device" + std::string(extension)), "not a regular file");
  }
}

TEST(GroomFile, RefusesAHugeFileWithoutReadingIt) {
  // 4 TiB of nothing, which takes no room on the disk.
  const auto path = test::scratchFolder("groom_huge") / "a.hair";
  test::writeText(path, "HAIR");
  std::error_code code;
  std::filesystem::resize_file(path, 1ull << 42, code);
  if (code) GTEST_SKIP() << "SKIPPED: no such large files here: " << code.message();
  expectReadError(path, "has 4398046511104 bytes; at most 68719476736 can be read");
  std::filesystem::remove(path);  // lest something copies it
}

TEST(GroomFile, RefusesToWriteWhatCannotBeReadBack) {
  const auto folder = test::scratchFolder("groom_bad");
  for (const char* name : {"a.hair", "a.obj", "a.ply", "a.abc"}) {
    expectWriteError(folder / name, Groom{}, "no strands");
    Groom point = test::awkwardGroom();
    point.addStrand(std::vector<Vec3f>{{1, 2, 3}});
    expectWriteError(folder / name, point, "strand 3 has 1 particles");
    Groom nothing = test::awkwardGroom();
    nothing.addStrand({});
    expectWriteError(folder / name, nothing, "strand 3 has 0 particles");
    Groom infinite = test::awkwardGroom();
    infinite.points[4].z = std::numeric_limits<float>::infinity();
    expectWriteError(folder / name, infinite, "strand 1, particle 2");
  }
  EXPECT_EQ(test::fileCount(folder), 0);
}

TEST(GroomFile, ReportsWhereItCannotWrite) {
  const auto folder = test::scratchFolder("groom_unwritable");
  expectWriteError(folder / "nowhere" / "a.obj", test::awkwardGroom(), "No such file");
  std::filesystem::create_directory(folder / "folder.obj");
  test::writeText(folder / "folder.obj" / "inside", "x");
  expectWriteError(folder / "folder.obj", test::awkwardGroom(), "is a folder");
  EXPECT_EQ(test::fileCount(folder), 1);  // no temporary is left
}

TEST(GroomFile, AFullDiskIsReportedAndLeavesTheOldFile) {
  // A limit on file sizes stands in for a full disk: writing fails in the middle.
  const auto folder = test::scratchFolder("groom_full");
  const Result<Groom> groom = makeSwatch({.columnCount = 20, .rowCount = 20});
  ASSERT_TRUE(groom);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : {"a.hair", "a.obj", "a.ply", "a.abc"}) {
    const auto path = folder / name;
    ASSERT_TRUE(writeGroom(path, test::awkwardGroom()));
    const std::string old = test::readText(path);
    const rlimit small{10000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status = writeGroom(path, *groom);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(status);
    EXPECT_TRUE(contains(status.error().message, "cannot write its")) << status.error().message;
    EXPECT_TRUE(contains(status.error().message, "File too large")) << status.error().message;
    EXPECT_EQ(test::readText(path), old);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(test::fileCount(folder), 4);
}

}  // namespace
}  // namespace ringlet::groom_file_test
