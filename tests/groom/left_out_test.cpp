// What cannot be read beside what can, in every format: the good strands are read, the others left out with a
// count and the place of the first.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/groom/crate_bytes.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/strand_list_bytes.h"
#include "tests/groom/tfx_bytes.h"
#include "tests/groom/zip_bytes.h"
#include "tests/support/test_support.h"

namespace ringlet::left_out_test {
namespace {

using test::contains;
using test::CrateBytes;

std::filesystem::path folder() {
  static const std::filesystem::path made = test::scratchFolder("left_out");
  return made;
}

Result<LoadedGroom> read(const std::string& name, const std::string& bytes,
                         const GroomReading& reading = {}) {
  test::writeText(folder() / name, bytes);
  return readGroom(folder() / name, reading);
}

std::vector<Vec3f> strandOf(const Groom& groom, std::size_t s) {
  const auto strand = groom.strand(s);
  return {strand.begin(), strand.end()};
}

// The warning that names what was left out; there is one.
std::string leftOut(const LoadedGroom& loaded) {
  std::string found;
  for (const std::string& warning : loaded.warnings) {
    if (!contains(warning, "left out")) continue;
    EXPECT_EQ(found, "") << warning;
    found = warning;
  }
  EXPECT_NE(found, "");
  return found;
}

// --- A number that is none, of the second of three strands.

constexpr float kSpoiled = 7.25f;  // occurs once

Groom threeStrands() {
  Groom groom;
  for (const float x : {1.f, 2.f, 3.f})
    groom.addStrand(std::vector<Vec3f>{{x, 0, 0}, {x, -1, x == 2 ? kSpoiled : 0.5f}, {x, -2, 0.5f}});
  return groom;
}

std::string written(const char* name) {
  EXPECT_TRUE(writeGroom(folder() / name, threeStrands()));
  std::ifstream file(folder() / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string asUsda() {
  return "#usda 1.0\ndef BasisCurves \"Hair\" {\nuniform token type = \"linear\"\n"
         "int[] curveVertexCounts = [3, 3, 3]\npoint3f[] points = [(1, 0, 0), (1, -1, 0.5), (1, -2, 0.5), "
         "(2, 0, 0), (2, -1, 7.25), (2, -2, 0.5), (3, 0, 0), (3, -1, 0.5), (3, -2, 0.5)]\n}\n";
}

std::string asUsdc() {
  CrateBytes crate;
  for (const char* name : {"points", "curveVertexCounts", "type", "Hair"}) crate.name(name);
  crate.addRoot({"Hair"});
  crate.addPrim("/Hair", "BasisCurves");
  crate.addAttribute("/Hair.type", crate.token("linear"));
  crate.addAttribute("/Hair.points", crate.points(threeStrands().points));
  crate.addAttribute("/Hair.curveVertexCounts", crate.integers({3, 3, 3}));
  return crate.bytes();
}

std::string asAbc() {
  std::vector<Vec3d> points;
  for (const Vec3f p : threeStrands().points) points.push_back(Vec3d(p));
  return test::abcFile({test::abcCurves("Hair", {3, 3, 3}, points)});
}

std::string asTfx() {
  test::TfxBytes tfx{.strandCount = 3, .pointsPerStrand = 3, .positions = {}};
  for (const Vec3f p : threeStrands().points) tfx.positions.insert(tfx.positions.end(), {p.x, p.y, p.z, 0});
  return tfx.bytes();
}

std::string asList(int floats) {
  std::string bytes;
  test::appendBytes(bytes, std::int32_t{3});
  for (std::size_t i = 0; i < 9; ++i) {
    if (i % 3 == 0) test::appendBytes(bytes, std::int32_t{3});
    const Vec3f p = threeStrands().points[i];
    for (const float number : {p.x, p.y, p.z}) test::appendBytes(bytes, number);
    for (int more = 3; more < floats; ++more) test::appendBytes(bytes, 0.f);
  }
  return bytes;
}

std::string asPlyText(bool byEdge) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\n";
  text += byEdge ? "element edge 6\nproperty int vertex1\nproperty int vertex2\nend_header\n"
                 : "element strand 3\nproperty ushort nsegs\nend_header\n";
  for (const Vec3f p : threeStrands().points)
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  return text + (byEdge ? "0 1\n1 2\n3 4\n4 5\n6 7\n7 8\n" : "2\n2\n2\n");
}

std::string asObjEdges() {
  std::string text;
  for (const Vec3f p : threeStrands().points)
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  return text + "l 1 2\nl 2 3\nl 4 5\nl 5 6\nl 7 8\nl 8 9\n";
}

struct Sample {
  std::string name, bytes;
  bool isText;
  std::string place;  // in the warning
};

std::vector<Sample> samples() {
  return {
      {"a.hair", written("made.hair"), false, "strand 1, point 1"},
      {"a.obj", written("made.obj"), true, "line 6"},
      {"edges.obj", asObjEdges(), true, "line 5"},
      {"a.ply", written("made.ply"), false, "vertex 4"},
      {"text.ply", asPlyText(false), true, "vertex 4"},
      {"edges.ply", asPlyText(true), true, "vertex 4"},
      {"a.tfx", asTfx(), false, "strand 1, point 1"},
      {"a.abc", asAbc(), false, "/Hair: found ("},
      {"a.data", asList(3), false, "strand 1, point 1"},
      {"a.bin", asList(7), false, "strand 1, point 1"},
      {"a.usda", asUsda(), true, "/Hair: found ("},
      {"a.usdc", asUsdc(), false, "/Hair: found ("},
      {"text.usdz", test::ZipBytes{.content = asUsda()}.bytes(), true, "/Hair: found ("},
      {"crate.usdz", test::ZipBytes{.name = "a.usdc", .content = asUsdc()}.bytes(), false, "/Hair: found ("}};
}

std::string spoiled(const Sample& sample, float bad) {
  std::string bytes = sample.bytes, from(4, '\0'), to(4, '\0');
  std::memcpy(from.data(), &kSpoiled, 4);
  std::memcpy(to.data(), &bad, 4);
  if (sample.isText) {
    from = contains(bytes, "7.250000") ? "7.250000" : "7.25";
    to = std::isnan(bad) ? "nan" : bad < 0 ? "-inf" : "inf";
    to.resize(from.size(), ' ');
  }
  const std::size_t at = bytes.find(from);
  EXPECT_NE(at, bytes.npos) << sample.name;
  EXPECT_EQ(bytes.find(from, at + 1), bytes.npos) << sample.name;
  return bytes.replace(at, from.size(), to);
}

TEST(LeftOut, AStrandWithANumberThatIsNoneBesideGoodOnesInEveryFormat) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const Sample& sample : samples()) {
    const auto whole = read(sample.name, sample.bytes);
    ASSERT_TRUE(whole) << sample.name << ": " << whole.error().message;
    ASSERT_EQ(whole->groom.strandCount(), 3u) << sample.name;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInf, -kInf}) {
      const auto loaded = read(sample.name, spoiled(sample, bad));
      ASSERT_TRUE(loaded) << sample.name << ": " << loaded.error().message;
      ASSERT_EQ(loaded->groom.strandCount(), 2u) << sample.name;
      EXPECT_EQ(strandOf(loaded->groom, 0), strandOf(whole->groom, 0)) << sample.name;
      EXPECT_EQ(strandOf(loaded->groom, 1), strandOf(whole->groom, 2)) << sample.name;
      const std::string warning = leftOut(*loaded);
      EXPECT_TRUE(contains(warning, "left out 1 ")) << warning;
      EXPECT_TRUE(contains(warning, sample.place)) << warning;
    }
  }
}

// --- What hangs together and is no strand.

std::string sixtyStrands() {
  std::string points, lines;
  for (int s = 0; s < 60; ++s) {
    for (int i = 0; i < 3; ++i) points += "v " + std::to_string(s) + " " + std::to_string(-i) + " 0\n";
    lines += "l " + std::to_string(3 * s + 1) + " " + std::to_string(3 * s + 2) + " " +
             std::to_string(3 * s + 3) + "\n";
  }
  return points + "v 0 0 9\nv 0 1 9\nv 1 1 9\nv 1 0 9\n" + lines;  // 244 lines; points 181 to 184 are free
}

TEST(LeftOut, LoopsAndBranchesBesideSixtyStrands) {
  const struct {
    const char *lines, *count, *place;
  } kCases[] = {
      {"l 181 182 183 181\n", "left out 1 of 61", "line 245: found a closed loop: point 181"},
      {"l 181 182\nl 182 183\nl 183 181\n", "left out 1 of 61", "line 245: found an edge of a closed"},
      {"l 181 182\nl 182 183\nl 182 184\n", "left out 1 of 61", "line 247: found a third edge"},
      {"l 181 182\nl 182 181\n", "left out 1 of 61", "line 245: found an edge of a closed loop"},
      {"l 181 181\n", "left out 1 of 61", "line 245: found an edge from point 181 to itself"},
      {"l 181 182 181\nl 183 184 183\n", "left out 2 of 62", "the first, at line 245"}};
  const auto whole = read("sixty.obj", sixtyStrands());
  ASSERT_TRUE(whole);
  for (const auto& one : kCases) {
    const auto loaded = read("sixty.obj", sixtyStrands() + one.lines);
    ASSERT_TRUE(loaded) << one.lines << loaded.error().message;
    EXPECT_TRUE(test::hasSameBits(loaded->groom, whole->groom)) << one.lines;
    const std::string warning = leftOut(*loaded);
    EXPECT_TRUE(contains(warning, one.count)) << warning;
    EXPECT_TRUE(contains(warning, one.place)) << warning;
  }
  // An edge more of a strand of edges takes all of it away, and nothing else.
  const auto branched = read("edges.obj", asObjEdges() + "l 5 9\n");
  ASSERT_TRUE(branched) << branched.error().message;
  EXPECT_EQ(branched->groom.strandCount(), 1u);
  // In PLY too.
  std::string ply = asPlyText(true);
  ply.replace(ply.find("edge 6"), 6, "edge 7");
  const auto loop = read("loop.ply", ply + "5 3\n");
  ASSERT_TRUE(loop) << loop.error().message;
  EXPECT_EQ(loop->groom.strandCount(), 2u);
  EXPECT_TRUE(contains(leftOut(*loop), "left out 1 of 3 strands; line 3: found an edge of a closed loop"))
      << leftOut(*loop);
}

TEST(LeftOut, LinesOfOnePointAreSaid) {
  const auto none = read("one.obj", "v 0 0 0\nv 0 1 0\nl 1\nl 2\n");
  ASSERT_FALSE(none);
  EXPECT_TRUE(contains(none.error().message, "found 2 points ('v') and 2 lines ('l') of one point each"))
      << none.error().message;
}

// --- Prims of USD files, as text, crate and package.

struct Curves {
  std::string name;
  std::vector<std::int32_t> counts;
  std::vector<Vec3f> points;
  std::string wrap = "nonperiodic";
};

const Curves kHair{"Hair", {3, 2}, {{0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {1, 0, 0}, {1, -1, 0}}};

std::string textOf(const std::vector<Curves>& prims) {
  std::string text = "#usda 1.0\n";
  for (const Curves& prim : prims) {
    text += "def BasisCurves \"" + prim.name +
            "\" { uniform token type = \"linear\" uniform token wrap = \"" + prim.wrap +
            "\" int[] curveVertexCounts = [";
    for (const std::int32_t count : prim.counts) text += std::to_string(count) + ", ";
    text += "] point3f[] points = [";
    for (const Vec3f p : prim.points) {
      text += "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " +
              (std::isnan(p.z) ? "nan" : std::to_string(p.z)) + "), ";
    }
    text += "] }\n";
  }
  return text;
}

std::string crateOf(const std::vector<Curves>& prims) {
  CrateBytes crate;
  for (const char* name : {"points", "curveVertexCounts", "type", "wrap"}) crate.name(name);
  std::vector<std::string> names;
  for (const Curves& prim : prims) {
    crate.name(prim.name);
    names.push_back(prim.name);
  }
  crate.addRoot(names);
  for (const Curves& prim : prims) {
    const std::string path = "/" + prim.name;
    crate.addPrim(path, "BasisCurves");
    crate.addAttribute(path + ".type", crate.token("linear"));
    crate.addAttribute(path + ".wrap", crate.token(prim.wrap));
    crate.addAttribute(path + ".points", crate.points(prim.points));
    crate.addAttribute(path + ".curveVertexCounts", crate.integers(prim.counts));
  }
  return crate.bytes();
}

// The same in every container.
void inEveryContainer(const std::string& text, const std::string& crate,
                      const std::function<void(const Result<LoadedGroom>&, const std::string&)>& look,
                      const GroomReading& reading = {}) {
  look(read("a.usda", text, reading), "usda");
  look(read("a.usdc", crate, reading), "usdc");
  look(read("a.usd", crate, reading), "usd");
  look(read("a.usdz", test::ZipBytes{.content = text}.bytes(), reading), "usdz of text");
  look(read("b.usdz", test::ZipBytes{.name = "a.usdc", .content = crate}.bytes(), reading),
       "usdz of a crate");
}

const std::vector<Vec3f> kFour{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};

TEST(LeftOut, PrimsOfUsdBesideAGoodOne) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const struct {
    std::vector<Curves> others;
    const char* says;
  } kCases[] = {
      {{{"Rig", {4}, kFour, "periodic"}}, "left out 1 BasisCurves prim, /Rig: its curves are closed loops"},
      {{{"Rig", {4}, kFour, "periodic"}, {"RigB", {4}, kFour, "periodic"}},
       "left out 2 BasisCurves prims, the first /Rig: its curves are closed loops"},
      {{{"Rig", {4}, kFour, "segmented"}}, "left out 1 BasisCurves prim, /Rig: found wrap 'segmented'"},
      {{{"Rig", {}, {}}}, "left out 1 BasisCurves prim without points, /Rig"},
      {{{"Rig", {3}, kFour}}, "left out 1 BasisCurves prim, /Rig: its curveVertexCounts add up to 3"},
      {{{"Rig", {-1, 5}, kFour}}, "left out 1 BasisCurves prim, /Rig: found -1 in curveVertexCounts"},
      {{{"Rig", {1}, {{0, 0, 0}}}}, "left out 1 curve, which have too few points, the first of /Rig"},
      {{{"Rig", {2}, {{0, 0, 0}, {0, 1, none}}}}, "left out 1 curve, the first of /Rig: found (0, 1, nan)"},
      {{{"Rig", {2}, {{0, 0, 0}, {0, 1, none}}}, {"RigB", {2}, {{0, 0, 0}, {0, 1, none}}}},
       "left out 2 curves, the first of /Rig: found (0, 1, nan)"}};
  Groom good;
  good.addStrand(std::span(kHair.points).subspan(0, 3));
  good.addStrand(std::span(kHair.points).subspan(3));
  for (const auto& one : kCases) {
    for (const bool isFirst : {true, false}) {
      std::vector<Curves> prims = one.others;
      prims.insert(isFirst ? prims.begin() : prims.end(), kHair);
      inEveryContainer(textOf(prims), crateOf(prims), [&](const auto& loaded, const std::string& what) {
        ASSERT_TRUE(loaded) << what << " " << one.says << ": " << loaded.error().message;
        EXPECT_TRUE(test::hasSameBits(loaded->groom, good)) << what << " " << one.says;
        const std::string warning = leftOut(*loaded);
        EXPECT_TRUE(contains(warning, one.says)) << what << ": " << warning;
      });
    }
    // Alone they stay refused.
    inEveryContainer(textOf(one.others), crateOf(one.others),
                     [&](const auto& loaded, const std::string& what) {
                       EXPECT_FALSE(loaded) << what << " " << one.says;
                     });
  }
  inEveryContainer(textOf({{"Rig", {4}, kFour, "periodic"}}), crateOf({{"Rig", {4}, kFour, "periodic"}}),
                   [](const auto& loaded, const std::string& what) {
                     ASSERT_FALSE(loaded) << what;
                     EXPECT_TRUE(contains(loaded.error().message, "/Rig: its curves are closed loops"))
                         << what;
                   });
}

TEST(LeftOut, CurvesOfAPrimWithoutCountsAreCutWhereThatIsSaid) {
  Curves counted = kHair, bare = kHair;
  counted.counts = {2, 2};
  counted.points.pop_back();
  bare.counts = {};
  bare.points.pop_back();
  inEveryContainer(textOf({bare}), crateOf({bare}), [](const auto& loaded, const std::string& what) {
    ASSERT_FALSE(loaded) << what;
    EXPECT_TRUE(contains(loaded.error().message, "--points-per-strand")) << loaded.error().message;
  });
  const auto expected = read("counted.usda", textOf({counted}));
  ASSERT_TRUE(expected);
  inEveryContainer(textOf({bare}), crateOf({bare}),
                   [&](const auto& loaded, const std::string& what) {
                     ASSERT_TRUE(loaded) << what << loaded.error().message;
                     EXPECT_TRUE(test::hasSameBits(loaded->groom, expected->groom)) << what;
                   },
                   {.pointsPerStrand = 2});
  inEveryContainer(textOf({bare}), crateOf({bare}),
                   [](const auto& loaded, const std::string& what) {
                     ASSERT_FALSE(loaded) << what;
                     EXPECT_TRUE(contains(loaded.error().message, "4 points")) << loaded.error().message;
                   },
                   {.pointsPerStrand = 3});
}

// A prim of hair with more said of it: as text between its braces, and as crate.
std::string hairWith(const std::string& text) {
  std::string whole = textOf({kHair});
  return whole.insert(whole.rfind('}'), " " + text + " ");
}
std::string crateWith(const std::function<void(CrateBytes&)>& add, const std::vector<std::string>& names) {
  CrateBytes crate;
  for (const char* name : {"points", "curveVertexCounts", "type", "Hair", "xformOpOrder"}) crate.name(name);
  for (const std::string& name : names) crate.name(name);
  crate.addRoot({"Hair"});
  crate.addPrim("/Hair", "BasisCurves");
  crate.addAttribute("/Hair.type", crate.token("linear"));
  crate.addAttribute("/Hair.curveVertexCounts", crate.integers(kHair.counts));
  add(crate);
  return crate.bytes();
}
void addPoints(CrateBytes& crate) { crate.addAttribute("/Hair.points", crate.points(kHair.points)); }

std::string warningWith(const LoadedGroom& loaded, const std::string& part) {
  for (const std::string& warning : loaded.warnings)
    if (contains(warning, part)) return warning;
  return "";
}

TEST(UsdSkinning, IsWarnedOfWithThePathAndWhatToDo) {
  constexpr std::uint32_t kRelationship = 8, kPathListOp = 34;
  const struct {
    const char *name, *text, *says;
    bool isRelationship;
  } kCases[] = {
      {"skel:skeleton", "rel skel:skeleton = </Rig/Skeleton>", "a skeleton", true},
      {"skel:blendShapeTargets", "rel skel:blendShapeTargets = [</A>, </B>]", "blend shapes", true},
      {"primvars:skel:jointWeights", "float[] primvars:skel:jointWeights = [1, 1]", "a skeleton", false},
      {"primvars:skel:jointIndices", "int[] primvars:skel:jointIndices = [0, 0]", "a skeleton", false},
      {"skel:blendShapes", "uniform token[] skel:blendShapes = [\"smile\"]", "blend shapes", false}};
  for (const auto& one : kCases) {
    const std::string crate = crateWith(
        [&](CrateBytes& c) {
          addPoints(c);
          const std::string path = std::string("/Hair.") + one.name;
          if (one.isRelationship) {
            c.add(path, kRelationship, {{"targetPaths", c.listEdit(kPathListOp, 1)}});
          } else {
            c.addAttribute(path, c.integers({0, 0}));
          }
        },
        {one.name});
    inEveryContainer(hairWith(one.text), crate, [&](const auto& loaded, const std::string& what) {
      ASSERT_TRUE(loaded) << what << loaded.error().message;
      const std::string warning = warningWith(*loaded, "is not followed");
      for (const char* part : {"/Hair", one.says, one.name, "bake the deformation"})
        EXPECT_TRUE(contains(warning, part)) << what << " " << one.name << ": " << warning;
    });
  }
}

TEST(UsdSkinning, IsInheritedAndOnlyWhatBindsIsWarnedOf) {
  const std::string hair = textOf({kHair}).substr(10);
  const auto below = [&](const std::string& text) {
    return read("a.usda", "#usda 1.0\ndef SkelRoot \"Body\" { " + text + " def Xform \"Hairs\" { " + hair +
                              "} }\n" + "def Skeleton \"Other\" { uniform token[] joints = [\"a\"] }\n");
  };
  const auto bound = below("rel skel:skeleton = </Other>");
  ASSERT_TRUE(bound) << bound.error().message;
  EXPECT_TRUE(contains(warningWith(*bound, "is not followed"), "/Body/Hairs/Hair")) << bound->warnings.size();
  for (const char* text : {"", "rel skel:skeleton", "rel skel:skeleton = None", "rel skel:skeleton = []",
                           "delete rel skel:skeleton = </Other>", "rel skel:animationSource = </Other>",
                           "float[] primvars:skel:jointWeights = []", "rel proxyPrim = </Other>"}) {
    const auto free = below(text);
    ASSERT_TRUE(free) << text << free.error().message;
    EXPECT_TRUE(free->warnings.empty()) << text << ": " << free->warnings.front();
  }
  // A binding beside the hair is none of it.
  const auto beside =
      read("a.usda", textOf({kHair}) + "def Mesh \"Head\" { rel skel:skeleton = </Other> }\n");
  ASSERT_TRUE(beside);
  EXPECT_EQ(warningWith(*beside, "skel"), "");
}

TEST(UsdTransforms, OpsWithoutAValueAreSkippedWithAWarning) {
  const std::string order =
      "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateXYZ:late\"] "
      "double3 xformOp:translate = (1, 2, 3) ";
  const std::string crate = crateWith(
      [](CrateBytes& c) {
        addPoints(c);
        c.addAttribute("/Hair.xformOpOrder", c.tokens({"xformOp:translate", "xformOp:rotateXYZ:late"}));
        c.addAttribute("/Hair.xformOp:translate", c.scalar<double>(23, {1, 2, 3}));
      },
      {"xformOp:translate"});
  // Not there, there without a value, blocked; of a name that nobody knows.
  for (const std::string& text :
       {order, order + "float3 xformOp:rotateXYZ:late", order + "float3 xformOp:rotateXYZ:late = None"}) {
    inEveryContainer(hairWith(text), crate, [&](const auto& loaded, const std::string& what) {
      ASSERT_TRUE(loaded) << what << loaded.error().message;
      EXPECT_EQ(loaded->groom.points[0], (Vec3f{1, 2, 3})) << what;
      const std::string warning = warningWith(*loaded, "without a value");
      for (const char* part : {"1 transform", "'xformOp:rotateXYZ:late'", "/Hair"})
        EXPECT_TRUE(contains(warning, part)) << what << ": " << warning;
    });
  }
  const auto above = read("a.usda",
                          "#usda 1.0\ndef Xform \"Top\" { uniform token[] xformOpOrder = [\"xformOp:scale\", "
                          "\"!invert!xformOp:scale\"] " +
                              textOf({kHair, {"More", {2}, {{0, 0, 0}, {0, 1, 0}}}}).substr(10) + "}\n");
  ASSERT_TRUE(above) << above.error().message;
  EXPECT_TRUE(contains(warningWith(*above, "without a value"), "2 transforms")) << above->warnings.size();
  EXPECT_TRUE(contains(warningWith(*above, "without a value"), "/Top")) << above->warnings.size();
}

TEST(UsdSamples, TheFirstThatIsNotEmptyCountsWithAWarning) {
  std::string text = textOf({kHair});
  const std::string standard = "point3f[] points = ";
  const std::size_t at = text.find(standard), end = text.find(']', at + standard.size()) + 1;
  const std::string points = text.substr(at + standard.size(), end - at - standard.size());
  for (const std::string& samples :
       {"{ 1: [], 5: " + points + ", 6: [(9, 9, 9)] }", "{ 6: [(9, 9, 9)], 5: " + points + ", 1: [] }",
        "{ 1: [], 2: None, 5: " + points + " }"}) {
    std::string sampled = text;
    sampled.replace(at, end - at, "point3f[] points.timeSamples = " + samples);
    const std::string crate = crateWith(
        [](CrateBytes& c) {
          c.add("/Hair.points", CrateBytes::kAttribute,
                {{"timeSamples", c.samples({1, 2, 5, 6}, {c.points({}), c.block(), c.points(kHair.points),
                                                          c.points({{9, 9, 9}})})}});
        },
        {});
    inEveryContainer(sampled, crate, [&](const auto& loaded, const std::string& what) {
      ASSERT_TRUE(loaded) << what << samples << loaded.error().message;
      EXPECT_EQ(loaded->groom.points, kHair.points) << what;
      const std::string warning = warningWith(*loaded, "without points at first");
      for (const char* part : {"/Hair", "at time 1", "first time with points, 5"})
        EXPECT_TRUE(contains(warning, part)) << what << ": " << warning;
    });
  }
  // Without points at any time it is a prim without strands.
  std::string sampled = text;
  sampled.replace(at, end - at, "point3f[] points.timeSamples = { 1: [], 2: [] }");
  EXPECT_FALSE(read("a.usda", sampled));
}

// --- What a prim says of its curves.

constexpr std::size_t kCurves = 4;

// Numbers of each curve, `width` of them, and those of the curves but one.
std::vector<double> numbersBut(std::size_t bad, std::size_t width) {
  std::vector<double> numbers;
  for (std::size_t c = 0; c < kCurves; ++c) {
    for (std::size_t i = 0; i < width && c != bad; ++i) numbers.push_back(static_cast<double>(10 * c + i));
  }
  return numbers;
}
std::string ofEach(const char* type, const char* name, std::size_t width) {
  std::string text;
  for (std::size_t c = 0; c < kCurves; ++c) {
    const char* form = width == 1 ? "{}" : width == 2 ? "({}, {})" : "({}, {}, {})";
    text += (c > 0 ? ", " : "") + fmt::format(fmt::runtime(form), 10 * c, 10 * c + 1, 10 * c + 2);
  }
  return fmt::format("{}[] primvars:{} = [{}] (interpolation = \"uniform\")\n", type, name, text);
}

// Values of each curve stay those of the strands, whichever curve is left out and whatever a value is made
// of.
TEST(LeftOut, ValuesOfCurvesAreThoseOfTheStrandsThatStay) {
  for (std::size_t bad = 0; bad < 2 * kCurves; ++bad) {
    const std::size_t out = bad % kCurves;
    const bool isShort = bad < kCurves;  // else it has a point that is none
    std::string counts, points, names;
    std::vector<std::string> kept;
    for (std::size_t c = 0; c < kCurves; ++c) {
      const char* comma = c > 0 ? ", " : "";
      counts += fmt::format("{}{}", comma, c == out && isShort ? 1 : 2);
      points += fmt::format("{}({}, 0, 0)", comma, c);
      if (c != out || !isShort) points += fmt::format(", ({}, {}, 0)", c, c == out ? "nan" : "1");
      names += fmt::format("{}\"name {}\"", comma, c);
      if (c != out) kept.push_back(fmt::format("name {}", c));
    }
    const auto loaded =
        read("values.usda",
             fmt::format("#usda 1.0\ndef BasisCurves \"Hair\" {{\nuniform token type = \"linear\"\n"
                         "int[] curveVertexCounts = [{}]\npoint3f[] points = [{}]\n{}{}{}"
                         "string[] primvars:name = [{}] (interpolation = \"uniform\")\n}}\n",
                         counts, points, ofEach("int", "id", 1), ofEach("texCoord2f", "st", 2),
                         ofEach("color3f", "displayColor", 3), names),
             {.keepsPrims = true});
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->groom.strandCount(), kCurves - 1) << bad;
    ASSERT_EQ(loaded->prims.size(), 1u);
    const auto& values = loaded->prims[0].values;
    ASSERT_EQ(values.size(), 4u);
    for (std::size_t width = 1; width <= 3; ++width)
      EXPECT_EQ(values[width - 1].numbers, numbersBut(out, width)) << values[width - 1].name << " " << bad;
    EXPECT_EQ(values[3].texts, kept) << bad;
  }
}

}  // namespace
}  // namespace ringlet::left_out_test
