// groom/groom_file.h: the choice by extension, and files that are not there.
#include "ringlet/groom/groom_file.h"

#include <gtest/gtest.h>

#include <string>

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

TEST(GroomFile, SaysWhatIsSupported) {
  for (const char* name : {"a.xyz", "a", ".hair", ".tfx", "a.hair.gz", ""}) {
    expectReadError(name,
                    "supported are .hair, .obj, .usda, .usdc, .usd, .usdz, .abc, .tfx, .ply, .data and .bin");
    EXPECT_FALSE(isGroomFile(name));
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

}  // namespace
}  // namespace ringlet::groom_file_test
