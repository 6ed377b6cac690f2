// Thousands of spoilt files: a reader returns a usable groom or an error, and never crashes, hangs or takes
// memory it cannot account for. Run it with sanitizers too.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "ringlet/groom/alembic/abc_groom.h"
#include "ringlet/groom/hair_file.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/groom/ply_file.h"
#include "ringlet/groom/strand_list_file.h"
#include "ringlet/groom/tfx_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/ply_samples.h"
#include "tests/groom/strand_list_bytes.h"
#include "tests/groom/tfx_bytes.h"
#include "tests/groom/usda_samples.h"
#include "tests/groom/zip_bytes.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::broken_files_test {
namespace {

// Files here have some hundred bytes. A reader that believes a false count asks for gigabytes.
constexpr std::size_t kMostMemory = 256u << 20;

using Reader = std::function<Result<LoadedGroom>(const std::string&)>;

// Some bytes changed, a piece cut out, doubled or moved: what disks, editors and networks do.
std::string spoilt(std::string bytes, std::mt19937& random, const std::string& alphabet) {
  auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
  for (std::size_t change = 1 + below(4); change > 0; --change) {
    const std::size_t at = below(bytes.size()), count = below(std::min<std::size_t>(bytes.size() - at, 12));
    switch (below(6)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        if (!bytes.empty()) bytes[at] = alphabet[below(alphabet.size())];
        break;
      case 3:
        bytes.erase(at, count);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size()), count));
        break;
      case 5:
        bytes.resize(below(8) == 0 ? at : bytes.size());
        break;
    }
  }
  return bytes;
}

void spoilAndRead(const std::string& valid, const std::string& alphabet, int count, const Reader& read) {
  const Result<LoadedGroom> whole = read(valid);
  ASSERT_TRUE(whole) << whole.error().message;
  const test::MemoryLimit limit(kMostMemory);
  std::mt19937 random(20240601);
  int accepted = 0;
  for (int i = 0; i < count; ++i) {
    const Result<LoadedGroom> loaded = read(spoilt(valid, random, alphabet));
    if (!loaded) {
      ASSERT_GT(loaded.error().message.size(), 10u) << "file " << i;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(test::isUsable(loaded->groom)) << "file " << i;
  }
  // Both ways must really be taken.
  EXPECT_GT(accepted, count / 100);
  EXPECT_LT(accepted, count * 99 / 100);
}

TEST(BrokenFiles, Hair) {
  const auto folder = test::scratchFolder("broken_hair");
  ASSERT_TRUE(writeHair(folder / "a.hair", test::awkwardGroom()));
  const Reader read = [](const std::string& bytes) { return readHair(test::bytesOf(bytes), "a.hair"); };
  spoilAndRead(test::readText(folder / "a.hair"), std::string("\0\1\2\xff\x7f\x80", 6), 20000, read);
}

// Mutations of the header alone: there are the counts that could make a reader take memory or run past the
// end.
TEST(BrokenFiles, HairHeader) {
  const auto folder = test::scratchFolder("broken_hair_header");
  ASSERT_TRUE(writeHair(folder / "a.hair", test::awkwardGroom()));
  const std::string valid = test::readText(folder / "a.hair");
  const test::MemoryLimit limit(kMostMemory);
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = valid;
    for (std::size_t change = 1 + random() % 3; change > 0; --change) {
      bytes[4 + random() % 16] = std::string("\0\1\2\3\4\x7f\x80\xff", 8)[random() % 8];
    }
    const Result<LoadedGroom> loaded = readHair(test::bytesOf(bytes), "a.hair");
    if (loaded) {
      ASSERT_TRUE(test::isUsable(loaded->groom)) << "file " << i;
    }
  }
}

TEST(BrokenFiles, Tfx) {
  const Reader read = [](const std::string& bytes) { return readTfx(test::bytesOf(bytes), "a.tfx"); };
  spoilAndRead(test::TfxBytes{}.bytes(), std::string("\0\1\2\xff\x7f\x80", 6), 20000, read);
}

TEST(BrokenFiles, TfxHeader) {
  const std::string valid = test::TfxBytes{}.bytes();
  const test::MemoryLimit limit(kMostMemory);
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = valid;
    for (std::size_t change = 1 + random() % 3; change > 0; --change) {
      bytes[4 + random() % 16] = std::string("\0\1\2\3\4\x7f\x80\xff", 8)[random() % 8];
    }
    const Result<LoadedGroom> loaded = readTfx(test::bytesOf(bytes), "a.tfx");
    if (loaded) {
      ASSERT_TRUE(test::isUsable(loaded->groom)) << "file " << i;
    }
  }
}

TEST(BrokenFiles, Obj) {
  const std::string valid =
      "# hair\nv 1 2 3\nv 1.5 -2e-3 3\nv 2 2 2 1.0\nv 3 3 3\r\nv 4 4 4\nvt 0 0\nl 1/1 2/1 3/1\nl -2 -1\nl 4 "
      "\\\n3 2\nl 5 1\n";
  const Reader read = [](const std::string& bytes) { return readObj(test::bytesOf(bytes), "a.obj"); };
  spoilAndRead(valid, "0123456789-+./\\ \n\r\tvlf#eE", 40000, read);
}

TEST(BrokenFiles, Usd) {
  const Reader read = [](const std::string& bytes) { return readUsd(test::bytesOf(bytes), "a.usd"); };
  const std::string text = test::curves(test::kTwoStrands, "( upAxis = \"Z\" metersPerUnit = 1 )");
  const std::string numbers("\0\1\2\xff\x7f\x80", 6);
  spoilAndRead(text, "0123456789-+.,;()[]{}\"'#=@<>e \n", 20000, read);
  spoilAndRead(test::CrateBytes::small().bytes(), numbers, 20000, read);
  spoilAndRead(test::ZipBytes{.content = text}.bytes(), numbers, 20000, read);
}

TEST(BrokenFiles, Alembic) {
  const Reader read = [](const std::string& bytes) {
    return readAbcGroom(test::bytesOf(bytes), "a.abc", {.keepsPrims = true});
  };
  const std::vector<std::int32_t> counts{4, 5};
  const std::vector<Vec3d> points = test::abcCurl(counts);
  test::AbcCurveForm form{.type = test::kAbcCubic, .basis = 2};
  form.params = {
      test::abcArray("id", test::AbcBytes::i32, test::abcNumbers<std::int32_t>({1, 2}), 1, "geoScope=uni"),
      test::abcArray("name", test::AbcBytes::text, std::string("a\0b\0", 4), 1, "geoScope=uni")};
  const std::string file = test::abcFile(
      {test::abcXform("up", {0x10}, {{1, 2, 3}}, 0, {test::abcCurves("a", counts, points, form)}),
       test::abcMovingCurves("b", {{2}, {2}}, {test::abcCurl({2}), test::abcCurl({2})}, {.sampling = 1})});
  spoilAndRead(file, std::string("\0\1\2\xff\x7f\x80", 6), 20000, read);
}

TEST(BrokenFiles, PlyAndLists) {
  const Reader ply = [](const std::string& bytes) { return readPly(test::bytesOf(bytes), "a.ply"); };
  spoilAndRead(test::plyText(), "0123456789-+. \n", 20000, ply);
  spoilAndRead(test::plyBinary(), std::string("\0\1\2\xff\x7f\x80", 6), 20000, ply);
  const Reader list = [](const std::string& bytes) { return readStrandData(test::bytesOf(bytes), "a.data"); };
  spoilAndRead(test::strandList({3, 1, 4}, 3), std::string("\0\1\2\xff\x7f\x80", 6), 20000, list);
}

TEST(BrokenFiles, Noise) {
  std::mt19937 random(11);
  for (int i = 0; i < 5000; ++i) {
    std::string bytes(random() % 300, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_FALSE(readHair(test::bytesOf(bytes), "a.hair")) << "file " << i;
    EXPECT_FALSE(readTfx(test::bytesOf(bytes), "a.tfx")) << "file " << i;
    const Result<LoadedGroom> obj = readObj(test::bytesOf(bytes), "a.obj");
    if (obj) {
      ASSERT_TRUE(test::isUsable(obj->groom)) << "file " << i;
    }
  }
}

}  // namespace
}  // namespace ringlet::broken_files_test
