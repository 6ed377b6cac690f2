// groom/usd/usdc_file.h: a crate's values come out as they stand in it, whatever its version and coding;
// every broken file is refused, and none takes more memory than its size allows.
#include "ringlet/groom/usd/usdc_file.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/lz4_block.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usdc_codec.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::usdc_file_test {
namespace {

using test::contains;
using test::CrateBytes;

constexpr std::size_t kMostMemory = 256u << 20;

Result<LoadedGroom> read(const std::string& bytes) { return readUsd(test::bytesOf(bytes), "test.usdc"); }

void expectError(const std::string& bytes, const std::string& part) {
  const auto loaded = read(bytes);
  ASSERT_FALSE(loaded) << "expected an error with '" << part << "'";
  EXPECT_TRUE(contains(loaded.error().message, "test.usdc")) << loaded.error().message;
  EXPECT_TRUE(contains(loaded.error().message, part)) << part << " in\n" << loaded.error().message;
}

// One prim of two strands, whose attributes a test chooses.
CrateBytes hair(const std::function<void(CrateBytes&)>& addAttributes) {
  CrateBytes crate;
  for (const char* name : {"points", "curveVertexCounts", "type", "Hair", "xformOpOrder", "basis", "wrap"})
    crate.name(name);
  crate.addRoot({"Hair"});
  crate.addPrim("/Hair", "BasisCurves");
  addAttributes(crate);
  return crate;
}

TEST(UsdcFile, ReadsASmallFile) {
  // Moved by (1, 2, 3), then turned from Z up: (x, y, z) becomes (x, z, -y).
  const auto loaded = read(CrateBytes::small().bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(loaded->groom.points,
            (std::vector<Vec3f>{{1, 3, -2}, {1, 2, -2}, {1, 1, -2}, {2, 3, -2}, {2, 2, -2.5f}}));
  EXPECT_EQ(loaded->groom.metresPerUnit, 1);
  EXPECT_TRUE(loaded->statesUnit);
  EXPECT_TRUE(loaded->statesUp);
}

TEST(UsdcFile, ReadsEveryVersionsArrays) {
  for (const int minor : {4, 5, 6, 7, 8, 9, 10, 11, 12, 13}) {
    CrateBytes other;
    other.minorVersion = static_cast<std::uint8_t>(minor);
    for (const char* name : {"points", "curveVertexCounts", "type", "Hair"}) other.name(name);
    other.addRoot({"Hair"});
    other.addPrim("/Hair", "BasisCurves");
    other.addAttribute("/Hair.type", other.token("linear"));
    other.addAttribute("/Hair.points", other.points({{0, 0, 0}, {0, 1, 0}, {0, 2, 0.5f}}));
    other.addAttribute("/Hair.curveVertexCounts", other.integers({3}));
    const auto loaded = read(other.bytes());
    ASSERT_TRUE(loaded) << minor << ": " << loaded.error().message;
    EXPECT_EQ(loaded->groom.points, (std::vector<Vec3f>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0.5f}})) << minor;
  }
  for (const int minor : {0, 1, 2, 3, 14, 200}) {
    CrateBytes crate = CrateBytes::small();
    crate.minorVersion = static_cast<std::uint8_t>(minor);
    expectError(crate.bytes(), "found version 0." + std::to_string(minor) + ".0; expected 0.4.0 to 0.13.0");
  }
}

TEST(UsdcFile, ReadsPointsOfEveryPrecision) {
  // 1.5 and -2 as halves: sign, exponent 15 + e, ten digits.
  const std::vector<std::uint16_t> halves{0, 0, 0, 0x3e00, 0xc000, 0x0001};
  const auto asHalf = hair([&](CrateBytes& crate) {
    crate.addAttribute("/Hair.points", crate.array(25, halves, 3));
    crate.addAttribute("/Hair.curveVertexCounts", crate.integers({2}));
    crate.addAttribute("/Hair.type", crate.token("linear"));
  });
  const auto loaded = read(asHalf.bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.points[1], (Vec3f{1.5f, -2, std::ldexp(1.f, -24)}));
  const auto asDouble = hair([&](CrateBytes& crate) {
    crate.addAttribute("/Hair.points", crate.array<double>(23, {0, 0, 0, 0.1, 1e-3, 7}, 3));
    crate.addAttribute("/Hair.curveVertexCounts", crate.integers({2}));
    crate.addAttribute("/Hair.type", crate.token("linear"));
  });
  const auto wide = read(asDouble.bytes());
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_EQ(wide->groom.points[1], (Vec3f{0.1f, 1e-3f, 7}));
}

TEST(UsdcFile, ReadsPackedIntegers) {
  // Twenty strands of two: more than the fewest that are packed.
  std::vector<Vec3f> points;
  for (int i = 0; i < 40; ++i) points.push_back({float(i / 2), float(i % 2), 0});
  const std::vector<std::int32_t> counts(20, 2);
  const auto crate = hair([&](CrateBytes& c) {
    c.addAttribute("/Hair.points", c.points(points));
    c.addAttribute("/Hair.curveVertexCounts", c.packedIntegers(counts, counts.size()));
    c.addAttribute("/Hair.type", c.token("linear"));
  });
  const auto loaded = read(crate.bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 20u);
  EXPECT_EQ(loaded->groom.points, points);
}

TEST(UsdcFile, UnpacksTheFormatsOwnExample) {
  // 123 124 125 100125 100125 100126 100126, from the format's description.
  const std::string packed("\x00\xd0\x01\x00\x00\x00\xc1\x11\x7b\xa0\x86\x01\x00\x00\x00", 15);
  const auto values = unpackUsdcIntegers(test::bytesOf(packed), 7);
  ASSERT_TRUE(values);
  EXPECT_EQ(*values, (std::vector<std::int32_t>{123, 124, 125, 100125, 100125, 100126, 100126}));
  EXPECT_FALSE(unpackUsdcIntegers(test::bytesOf(packed), 9));  // its last code is not there
  EXPECT_FALSE(unpackUsdcIntegers(test::bytesOf(packed), 4000000));
  for (std::size_t size = 0; size < packed.size(); ++size)
    EXPECT_FALSE(unpackUsdcIntegers(test::bytesOf(packed.substr(0, size)), 7)) << size;
  // Differences of 8 and 16 bits, negative: 5, 4 (-1), -296 (-300), -296 + 7 (common).
  const std::string small("\x00\xb0\x07\x00\x00\x00\x25\x05\xff\xd4\xfe\x00\x00", 13);
  const auto negative = unpackUsdcIntegers(test::bytesOf(small.substr(0, 11)), 4);
  EXPECT_FALSE(negative);  // the token claims eleven literals, and nine are there
  const std::string whole("\x00\x90\x07\x00\x00\x00\x25\x05\xff\xd4\xfe", 11);
  const auto four = unpackUsdcIntegers(test::bytesOf(whole), 4);
  ASSERT_TRUE(four);
  EXPECT_EQ(*four, (std::vector<std::int32_t>{5, 4, -296, -289}));
}

TEST(UsdcFile, UnpacksLz4) {
  const auto unpacked = [](const std::string& block, std::size_t most) -> std::optional<std::string> {
    std::vector<std::byte> out;
    if (!appendLz4Block(test::bytesOf(block), most, out)) return std::nullopt;
    return std::string(reinterpret_cast<const char*>(out.data()), out.size());
  };
  // "abc", then 4 + 5 bytes from 3 back, which run into themselves, then "xyz".
  const std::string block(
      "\x35"
      "abc"
      "\x03\x00"
      "\x30"
      "xyz",
      10);
  EXPECT_EQ(unpacked(block, 100), "abcabcabcabcxyz");
  EXPECT_EQ(unpacked(block, 15), "abcabcabcabcxyz");
  EXPECT_FALSE(unpacked(block, 14));
  EXPECT_FALSE(unpacked(std::string("\x35"
                                    "abc"
                                    "\x04\x00"
                                    "\x30"
                                    "xyz",
                                    10),
                        100));  // before the beginning
  EXPECT_FALSE(unpacked(std::string("\x35"
                                    "abc"
                                    "\x00\x00"
                                    "\x30"
                                    "xyz",
                                    10),
                        100));  // from nowhere
  EXPECT_EQ(unpacked(CrateBytes::literals(std::string(1000, 'q')), 1000), std::string(1000, 'q'));
  EXPECT_FALSE(unpacked(std::string("\xf0\xff\xff\xff\xff", 5), 1u << 30));  // a length without its end
  EXPECT_FALSE(unpacked("", 10));
  for (std::size_t size = 0; size < block.size(); ++size) {
    if (size == 4) continue;  // ends as a block of literals may
    EXPECT_FALSE(unpacked(block.substr(0, size), 100)) << size;
  }
}

TEST(UsdcFile, ReadsTheFirstSample) {
  const auto crate = hair([&](CrateBytes& c) {
    const auto now = c.points({{0, 0, 0}, {0, 1, 0}}), then = c.points({{5, 0, 0}, {5, 1, 0}});
    c.add("/Hair.points", CrateBytes::kAttribute,
          {{"default", c.points({{9, 9, 9}, {8, 8, 8}})}, {"timeSamples", c.samples({3, 4}, {now, then})}});
    c.addAttribute("/Hair.curveVertexCounts", c.integers({2}));
    c.addAttribute("/Hair.type", c.token("linear"));
  });
  const auto loaded = read(crate.bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.points.front(), (Vec3f{0, 0, 0}));
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(contains(loaded->warnings[0], "at time 3")) << loaded->warnings[0];
  const auto falling = hair([&](CrateBytes& c) {
    c.add("/Hair.points", CrateBytes::kAttribute,
          {{"timeSamples", c.samples({4, 3}, {c.points({{0, 0, 0}, {0, 1, 0}}), c.points({})})}});
    c.addAttribute("/Hair.curveVertexCounts", c.integers({2}));
  });
  expectError(falling.bytes(), "times that do not rise");
}

TEST(UsdcFile, ReadsTransformsOfEveryCoding) {
  // A matrix in its own 32 bits: the diagonal (2, 3, 4, 1).
  CrateBytes crate = hair([&](CrateBytes& c) {
    for (const char* name : {"xformOp:transform", "xformOp:orient", "xformOp:scale"}) c.name(name);
    c.addAttribute("/Hair.points", c.points({{0, 0, 0}, {1, 1, 1}}));
    c.addAttribute("/Hair.curveVertexCounts", c.integers({2}));
    c.addAttribute("/Hair.type", c.token("linear"));
    c.addAttribute("/Hair.xformOpOrder", c.tokens({"xformOp:orient", "xformOp:scale", "xformOp:transform"}));
    c.addAttribute("/Hair.xformOp:transform", CrateBytes::inlined(15, 0x01040302));
    c.addAttribute("/Hair.xformOp:scale", CrateBytes::inlined(24, 0x0001ff02));  // (2, -1, 1)
    // A quarter about Z, stored i, j, k, r.
    c.addAttribute("/Hair.xformOp:orient", c.scalar<float>(17, {0, 0, std::sqrt(0.5f), std::sqrt(0.5f)}));
  });
  const auto loaded = read(crate.bytes());
  ASSERT_TRUE(loaded) << loaded.error().message;
  // (1, 1, 1), by the matrix (2, 3, 4), scaled (4, -3, 4), turned (3, 4, 4).
  EXPECT_LT(length(loaded->groom.points[1] - Vec3f{3, 4, 4}), 1e-5f);
}

TEST(UsdcFile, RefusesWhatOtherFilesBringIn) {
  struct Case {
    const char* field;
    std::uint32_t type;
  };
  for (const Case& c : {Case{"references", 35},
                        {"payload", 55},
                        {"inheritPaths", 34},
                        {"specializes", 34},
                        {"variantSetNames", 33}}) {
    for (const bool isFilled : {true, false}) {
      CrateBytes crate;
      for (const char* name : {"points", "curveVertexCounts", "type", "Head", "Hair"}) crate.name(name);
      crate.addRoot({"Head"});
      crate.addPrim("/Head", "Xform", {"Hair"}, {{c.field, crate.listEdit(c.type, isFilled)}});
      crate.addPrim("/Head/Hair", "BasisCurves");
      crate.addAttribute("/Head/Hair.type", crate.token("linear"));
      crate.addAttribute("/Head/Hair.points", crate.points({{0, 0, 0}, {0, 1, 0}}));
      crate.addAttribute("/Head/Hair.curveVertexCounts", crate.integers({2}));
      if (isFilled) {
        expectError(crate.bytes(), std::string("/Head: has ") + c.field);
        expectError(crate.bytes(), "usdcat --flatten");
      } else {
        EXPECT_TRUE(read(crate.bytes())) << c.field;
      }
    }
  }
  const auto connected = hair([&](CrateBytes& c) {
    c.add("/Hair.points", CrateBytes::kAttribute,
          {{"default", c.points({{0, 0, 0}, {0, 1, 0}})}, {"connectionPaths", c.listEdit(34, 1)}});
    c.addAttribute("/Hair.curveVertexCounts", c.integers({2}));
  });
  expectError(connected.bytes(), "its points are given by a connection");
  const auto spline = hair([&](CrateBytes& c) {
    c.addAttribute("/Hair.points", c.points({{0, 0, 0}, {0, 1, 0}}));
    c.add("/Hair.curveVertexCounts", CrateBytes::kAttribute, {{"spline", c.token("x")}});
  });
  expectError(spline.bytes(), "its curveVertexCounts are given by a spline");
  const auto edited = hair([&](CrateBytes& c) {
    c.addAttribute("/Hair.points", c.points({{0, 0, 0}, {0, 1, 0}}) | CrateBytes::Rep{1} << 60);
  });
  expectError(edited.bytes(), "a value that edits an array");
}

TEST(UsdcFile, RefusesEveryTruncation) {
  const std::string whole = CrateBytes::small().bytes();
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto loaded = read(whole.substr(0, size));
    ASSERT_FALSE(loaded) << size;
    ASSERT_GT(loaded.error().message.size(), 20u);
  }
}

TEST(UsdcFile, RefusesIndicesOnePastTheEnd) {
  using Index = CrateBytes::Index;
  for (const auto& [table, said] : {std::pair{Index::tokenOfField, "expected one of "},
                                    {Index::fieldOfSet, "expected one of "},
                                    {Index::setOfSpec, "expected where a set begins"},
                                    {Index::pathOfSpec, "expected a path, each once"}}) {
    CrateBytes crate = CrateBytes::small();
    crate.pastTheEnd = table;
    expectError(crate.bytes(), said);
  }
}

TEST(UsdcFile, SurvivesEveryByteAndEveryCount) {
  const std::string whole = CrateBytes::small().bytes();
  const test::MemoryLimit limit(kMostMemory);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {0x01, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const auto loaded = read(bytes);
      if (loaded) {
        ASSERT_TRUE(test::isUsable(loaded->groom)) << at;
      }
    }
  }
  // Every eight bytes as a count or a place that lies.
  for (std::size_t at = 0; at + 8 <= whole.size(); ++at) {
    for (const std::uint64_t lie :
         {std::uint64_t{0}, std::uint64_t{1} << 31, std::uint64_t{0xffffffff}, std::uint64_t{1} << 48,
          (std::uint64_t{1} << 63) - 1, ~std::uint64_t{0}}) {
      std::string bytes = whole;
      std::memcpy(bytes.data() + at, &lie, 8);
      const auto loaded = read(bytes);
      if (loaded) {
        ASSERT_TRUE(test::isUsable(loaded->groom)) << at;
      }
    }
  }
}

TEST(UsdcFile, RefusesBombs) {
  const test::MemoryLimit limit(kMostMemory);
  // A gigabyte in four megabytes, of which a thousand bytes are wanted.
  std::vector<std::byte> out;
  const std::string bomb =
      std::string("\x1f\x00\x01\x00", 4) + std::string(4 << 20, '\xff') + std::string(2, '\0');
  EXPECT_FALSE(appendLz4Block(test::bytesOf(bomb), 1000, out));

  // Four million counts in some kilobytes: 2 bits each, all 0, which LZ4 makes a 255th of.
  std::string zeros("\x00\x1f\x00\x01\x00", 5);
  zeros += std::string(4000, '\xff');
  zeros += std::string("\x00\x00", 2);
  const auto many = hair([&](CrateBytes& c) {
    c.addAttribute("/Hair.points", c.points({{0, 0, 0}, {0, 1, 0}}));
    c.addAttribute("/Hair.curveVertexCounts", c.packedBytes(zeros, 4000000));
  });
  expectError(many.bytes(), "found 4000000 elements; expected at most 6");

  // An array that many prims share: each would be read anew.
  CrateBytes shared;
  std::vector<std::string> children;
  for (int i = 0; i < 2000; ++i) children.push_back("H" + std::to_string(i));
  for (const char* name : {"points", "curveVertexCounts", "type"}) shared.name(name);
  shared.addRoot(children);
  const auto points = shared.points(std::vector<Vec3f>(4000, Vec3f{1, 2, 3}));
  for (const std::string& child : children) {
    shared.addPrim("/" + child, "BasisCurves");
    shared.addAttribute("/" + child + ".points", points);
  }
  expectError(shared.bytes(), "numbers in so small a file");

  // Fewer of them, cubic and as bent as can be: 29 particles of four points.
  CrateBytes bent;
  children.resize(700);
  for (const char* name : {"points", "curveVertexCounts"}) bent.name(name);
  bent.addRoot(children);
  std::vector<Vec3f> zigzag;
  for (int i = 0; i < 200; ++i) zigzag.push_back({float(i % 2), 0, 0});
  const auto few = bent.points(zigzag), counts = bent.integers(std::vector<std::int32_t>(50, 4));
  for (const std::string& child : children) {
    bent.addPrim("/" + child, "BasisCurves");
    bent.addAttribute("/" + child + ".points", few);
    bent.addAttribute("/" + child + ".curveVertexCounts", counts);
  }
  expectError(bent.bytes(), "too many for its");
}

TEST(UsdcFile, RefusesTreesThatAreNone) {
  // A child that is not there, and a prim that is its own child.
  CrateBytes missing;
  missing.name("Hair");
  missing.addRoot({"Hair", "Nobody"});
  missing.addPrim("/Hair", "Xform");
  expectError(missing.bytes(), "expected one that is there, once");
  CrateBytes twice;
  twice.name("Hair");
  twice.addRoot({"Hair", "Hair"});
  twice.addPrim("/Hair", "Xform");
  expectError(twice.bytes(), "expected one that is there, once");

  // As deep as one likes, and deeper than that.
  for (const std::size_t depth : {256u, 257u}) {
    CrateBytes deep;
    deep.name("p");
    deep.addRoot({"p"});
    std::string path;
    for (std::size_t i = 0; i < depth; ++i) {
      path += "/p";
      deep.addPrim(path, "Xform", i + 1 < depth ? std::vector<std::string>{"p"} : std::vector<std::string>{});
    }
    expectError(deep.bytes(), depth == 256 ? "found no BasisCurves" : "more than 256 prims in each other");
  }
}

// Counts and places as ../shared/tools' reader of crates, written independently, prints them.
TEST(UsdcFile, ReadsWhatBlenderWrote) {
  struct Case {
    const char* file;
    std::size_t strands;
    std::vector<Vec3d> first;  // control points 0 to 3 of the first curve, before its prim's move
    double moved;              // along Z
  };
  for (const Case& c : {Case{"usd/hair",
                             10,
                             {{0.08251529932022095, -0.7126688957214355, 0.0},
                              {0.08251529932022095, -0.7126688957214355, 0.41532692313194275},
                              {0.08251529932022095, -0.7126688957214355, 0.9953974485397339},
                              {0.08251529932022095, -0.7126688957214355, 1.4209022521972656}},
                             0},
                        Case{"usd/curves",
                             72,
                             {{-0.24708443880081177, -0.6606959700584412, -0.8038793206214905},
                              {-0.042344510555267334, -0.5560877126, -0.438104510307312},
                              {0.3175045847892761, -0.37004876136779785, 0.02984797954559326},
                              {0.6327276825904846, -0.20512521266937256, 0.33303102850914}},
                             -0.8038793206214905}}) {
    RINGLET_NEEDS_DATA(binary, std::string(c.file) + ".usdc");
    RINGLET_NEEDS_DATA(text, std::string(c.file) + ".usda");
    const auto crate = readGroom(binary, {.upIsZ = true}), usda = readGroom(text, {.upIsZ = true});
    ASSERT_TRUE(crate) << crate.error().message;
    ASSERT_TRUE(usda) << usda.error().message;
    EXPECT_EQ(crate->groom.strandCount(), c.strands);
    EXPECT_EQ(crate->groom.metresPerUnit, 1);
    // A B-spline begins at (p + 4 q + r) / 6.
    const Vec3d root = (c.first[0] + c.first[1] * 4 + c.first[2]) / 6 + Vec3d{0, 0, c.moved};
    EXPECT_LT(length(Vec3d(crate->groom.points.front()) - root), 1e-6);
    ASSERT_EQ(usda->groom.firstPoint, crate->groom.firstPoint);
    EXPECT_LT(test::farthestApart(crate->groom.points, usda->groom.points), 1e-6);
  }
}

}  // namespace
}  // namespace ringlet::usdc_file_test
