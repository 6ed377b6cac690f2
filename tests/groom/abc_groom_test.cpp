// groom/alembic/abc_groom.h: curves of Alembic files against the same curves in USD, those that the Alembic
// library wrote, what is left out and what is refused.
#include "ringlet/groom/alembic/abc_groom.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/alembic/abc_archive.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/output/groom_writer.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::abc_groom_test {
namespace {

constexpr double kRounding = 2e-6;  // of points below 20, from text and back

Result<LoadedGroom> read(const std::string& bytes, const GroomReading& reading = {}) {
  return readAbcGroom(bytesOf(bytes), "g.abc", reading);
}
Result<LoadedGroom> read(const std::vector<AbcBytes::Object>& objects, const GroomReading& reading = {}) {
  return read(abcFile(objects), reading);
}
LoadedGroom loadedOf(const std::vector<AbcBytes::Object>& objects, const GroomReading& reading = {}) {
  auto loaded = read(objects, reading);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? std::move(*loaded) : LoadedGroom{};
}
void expectProblem(const Result<LoadedGroom>& loaded, const std::string& expected) {
  const std::string problem = loaded ? "" : loaded.error().message;
  EXPECT_TRUE(contains(problem, expected)) << "found: " << problem << "\nexpected: " << expected;
}
void expectWarning(const LoadedGroom& loaded, const std::string& expected) {
  std::string all;
  for (const std::string& warning : loaded.warnings) all += warning + "\n";
  EXPECT_TRUE(contains(all, expected)) << "found: " << all << "expected: " << expected;
}
void expectSame(const Groom& a, const Groom& b) {
  EXPECT_EQ(a.firstPoint, b.firstPoint);
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_LE(farthestApart(a.points, b.points), kRounding);
}

// The same curves, as USD text.
Groom asUsd(const std::vector<std::int32_t>& counts, const std::vector<Vec3d>& points,
            const std::string& form) {
  std::string text = "int[] curveVertexCounts = [";
  for (const std::int32_t count : counts) text += fmt::format("{}, ", count);
  text += "]\npoint3f[] points = [";
  for (const Vec3d& p : points) text += fmt::format("({}, {}, {}), ", p.x, p.y, p.z);
  text += "]\n" + form;
  const auto loaded = readUsd(bytesOf(curves(text)), "g.usda");
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? loaded->groom : Groom{};
}

struct FormCase {
  const char* name;
  AbcCurveForm form;
  std::string usd;
  std::vector<std::int32_t> counts;
};

AbcBytes::Property ordersOf(const std::vector<std::uint8_t>& orders) {
  return abcArray(".orders", AbcBytes::u8, abcNumbers(orders));
}

std::vector<FormCase> formCases() {
  const auto usd = [](const char* basis, const char* wrap = "nonperiodic") {
    return fmt::format("uniform token basis = \"{}\"\nuniform token wrap = \"{}\"\n", basis, wrap);
  };
  const std::string linear = "uniform token type = \"linear\"\n";
  const std::vector<std::int32_t> any{5, 9, 4}, bezier{4, 7, 13};
  const AbcCurveForm variable{.type = kAbcVariable};
  const auto withOrders = [&](std::uint8_t basis, std::uint8_t order) {
    return AbcCurveForm{.type = kAbcVariable, .basis = basis, .more = {ordersOf({order, order, order})}};
  };
  return {{"linear", {}, linear, {2, 9, 3}},
          {"linear with a basis", {.basis = 2}, linear, any},
          {"bezier", {.type = kAbcCubic, .basis = 1}, usd("bezier"), bezier},
          {"bspline", {.type = kAbcCubic, .basis = 2}, usd("bspline"), any},
          {"catmullRom", {.type = kAbcCubic, .basis = 3}, usd("catmullRom"), any},
          {"without orders and basis", variable, linear, any},
          {"catmullRom without orders", {.type = kAbcVariable, .basis = 3}, usd("catmullRom", "pinned"), any},
          {"bspline without orders", {.type = kAbcVariable, .basis = 2}, usd("bspline"), any},
          {"orders of 2", withOrders(2, 2), linear, any},
          {"orders of 4", withOrders(2, 4), usd("bspline"), any}};
}

TEST(AbcGroom, CurvesOfEveryFormAreThoseOfUsd) {
  for (const FormCase& c : formCases()) {
    SCOPED_TRACE(c.name);
    const std::vector<Vec3d> points = abcCurl(c.counts);
    const LoadedGroom loaded = loadedOf({abcCurves("Hair", c.counts, points, c.form)});
    expectSame(loaded.groom, asUsd(c.counts, points, c.usd));
    EXPECT_FALSE(loaded.statesUnit);
    EXPECT_FALSE(loaded.statesUp);
    EXPECT_FALSE(loaded.hasUsdPrims);
    const bool isCubic = !contains(c.usd, "linear");
    EXPECT_EQ(loaded.warnings.empty(), !isCubic);
    if (isCubic) expectWarning(loaded, "g.abc: 3 curves are cubic, cut into edges");
  }
}

// Points of every type of float, and counts of every type of integer.
TEST(AbcGroom, PointsAndCountsOfEveryType) {
  const std::vector<Vec3d> points{{0, 0, 0}, {0, -1, 0.5}, {1, 0, 0}, {1, -2, 0.25}, {1, -3, 0}};
  std::string halves, doubles;
  for (const Vec3d& p : points) {
    for (const double x : {p.x, p.y, p.z}) {
      doubles += abcNumber(x);
      const int number = static_cast<int>(std::abs(x) * 4);  // quarters to 3
      constexpr std::uint16_t kQuarters[] = {0, 0x3400, 0x3800, 0x3a00, 0x3c00, 0,     0,
                                             0, 0x4000, 0,      0,      0,      0x4200};
      halves += abcNumber(static_cast<std::uint16_t>(kQuarters[number] | (x < 0 ? 0x8000 : 0)));
    }
  }
  const std::pair<std::uint32_t, std::string> floats[] = {
      {9, halves}, {10, abcPoints(points)}, {11, doubles}};
  const std::pair<std::uint32_t, std::string> counts[] = {
      {1, abcNumbers<std::uint8_t>({2, 3})},  {2, abcNumbers<std::int8_t>({2, 3})},
      {3, abcNumbers<std::uint16_t>({2, 3})}, {4, abcNumbers<std::int16_t>({2, 3})},
      {5, abcNumbers<std::uint32_t>({2, 3})}, {6, abcNumbers<std::int32_t>({2, 3})},
      {7, abcNumbers<std::uint64_t>({2, 3})}, {8, abcNumbers<std::int64_t>({2, 3})}};
  for (const auto& [pointType, pointBytes] : floats) {
    for (const auto& [countType, countBytes] : counts) {
      AbcBytes::Object hair = abcCurves("Hair", {2, 3}, points);
      std::vector<AbcBytes::Property>& parts = hair.properties[0].parts;
      parts[0].type = static_cast<AbcBytes::Type>(pointType);
      parts[0].samples = {pointBytes};
      parts[1].type = static_cast<AbcBytes::Type>(countType);
      parts[1].samples = {countBytes};
      const LoadedGroom loaded = loadedOf({hair});
      EXPECT_EQ(loaded.groom.firstPoint, (std::vector<std::uint32_t>{0, 2, 5}));
      ASSERT_EQ(loaded.groom.points.size(), points.size());
      for (std::size_t k = 0; k < points.size(); ++k)
        EXPECT_EQ(loaded.groom.points[k], Vec3f(points[k])) << pointType << " " << countType;
    }
  }
}

// A curve with the knots of an open NURBS curve begins and ends at its points, as Maya has them; with even
// knots it is a B-spline without.
TEST(AbcGroom, KnotsOfBSplinesAreFollowed) {
  const std::vector<std::int32_t> counts{4, 9};
  const std::vector<Vec3d> points = abcCurl(counts);
  const auto knotsOf = [&](bool isOpen) {
    std::string bytes;
    for (const std::int32_t count : counts) {
      for (std::int32_t k = 0; k < count + 4; ++k) {
        const std::int32_t inner = std::clamp(k, 3, count);
        bytes += abcNumber(static_cast<float>(isOpen ? inner : k) * 0.5f);
      }
    }
    return abcArray(".knots", AbcBytes::f32, bytes);
  };
  AbcCurveForm form{.type = kAbcCubic, .basis = 2};
  const Groom even = loadedOf({abcCurves("Hair", counts, points, form)}).groom;
  form.more = {knotsOf(false)};
  const Groom evenByKnots = loadedOf({abcCurves("Hair", counts, points, form)}).groom;
  expectSame(even, evenByKnots);
  form.more = {knotsOf(true)};
  const LoadedGroom open = loadedOf({abcCurves("Hair", counts, points, form)});
  ASSERT_EQ(open.groom.strandCount(), 2u);
  EXPECT_LE(length(Vec3d(open.groom.strand(0).front()) - points[0]), kRounding);
  EXPECT_LE(length(Vec3d(open.groom.strand(0).back()) - points[3]), kRounding);
  EXPECT_LE(length(Vec3d(open.groom.strand(1).front()) - points[4]), kRounding);
  EXPECT_LE(length(Vec3d(open.groom.strand(1).back()) - points[12]), kRounding);
  EXPECT_EQ(open.warnings.size(), 1u);  // cubic, and not short of its ends
  // Four points with eight such knots are a Bezier curve.
  AbcCurveForm bezier{.type = kAbcCubic, .basis = 1};
  const std::vector<Vec3d> four(points.begin(), points.begin() + 4);
  const Groom same = loadedOf({abcCurves("Hair", {4}, four, bezier)}).groom;
  Groom first;
  first.addStrand(open.groom.strand(0));
  expectSame(first, same);

  AbcBytes::Property falling = knotsOf(true), few = knotsOf(true);
  falling.samples[0].replace(0, 4, abcNumber(9.0f));
  few.samples[0].resize(few.samples[0].size() - 4);
  for (const AbcBytes::Property& wrong : {falling, few}) {
    form.more = {wrong};
    const LoadedGroom loaded = loadedOf({abcCurves("Hair", counts, points, form)});
    expectSame(loaded.groom, even);
    expectWarning(loaded,
                  "1 curves object, the first /Hair, with knots that do not fit; read as B-splines of");
    expectWarning(loaded, "2 of them begin and end short");
  }
}

// Depth first, each under what is above it; one that is said not to inherit stands by itself.
TEST(AbcGroom, ObjectsStandInTheFilesOrderUnderTheirTransforms) {
  const std::vector<Vec3d> points{{1, 2, 3}, {1, 1, 3}};
  const auto hair = [&](const std::string& name) { return abcCurves(name, {2}, points); };
  AbcBytes::Object apart = abcXform("apart", {0x10}, {{0, 0, 7}}, 0, {hair("d")});
  apart.properties[0].parts[0].samples = {std::string(1, '\0')};
  const std::vector<AbcBytes::Object> objects{
      abcXform("first", {0x10}, {{10, 0, 0}}, 0,
               {abcXform("inner", {0x40}, {{90}}, 0, {hair("a"), hair("b")}), apart}),
      hair("last")};
  const LoadedGroom loaded = loadedOf(objects, {.keepsPrims = true});
  ASSERT_EQ(loaded.prims.size(), 4u);
  const std::vector<std::string> paths{"/first/inner/a", "/first/inner/b", "/first/apart/d", "/last"};
  const std::vector<Vec3d> first{{11, -3, 2}, {11, -3, 2}, {1, 2, 10}, {1, 2, 3}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    EXPECT_EQ(loaded.prims[k].path, paths[k]);
    EXPECT_EQ(loaded.prims[k].firstStrand, k);
    EXPECT_EQ(loaded.prims[k].strandCount, 1u);
    EXPECT_LE(length(Vec3d(loaded.groom.strand(k).front()) - first[k]), kRounding) << paths[k];
    EXPECT_LE(length(loaded.prims[k].toGroom(points[0]) - first[k]), kRounding) << paths[k];
  }
}

TEST(AbcGroom, WhatMovesIsReadAtItsFirstSample) {
  const std::vector<std::vector<Vec3d>> poses{{{1, 2, 3}, {1, 1, 3}}, {{5, 2, 3}, {5, 1, 3}}};
  const std::vector<std::vector<double>> moves{{10, 0, 0}, {20, 0, 0}};
  const AbcBytes::Object still = abcCurves("hair", {2}, poses[0]);
  const AbcBytes::Object moving = abcMovingCurves("hair", {{2}}, poses, {.sampling = 1});
  for (const bool pointsMove : {false, true}) {
    for (const bool headMoves : {false, true}) {
      AbcBytes::Object head = abcXform("head", {0x10}, moves, 1, {pointsMove ? moving : still});
      if (!headMoves) head.properties[0].parts[2].samples.resize(1);
      const LoadedGroom loaded = loadedOf({head});
      EXPECT_EQ(loaded.groom.points, (std::vector<Vec3f>{{11, 2, 3}, {11, 1, 3}}));
      EXPECT_EQ(loaded.warnings.size(), pointsMove || headMoves ? 1u : 0u);
      if (pointsMove || headMoves)
        expectWarning(loaded, "g.abc: it moves; read as it is at its first sample, at 1 s");
    }
  }
}

// As of USD, curves that are not there yet count for nothing; counts are those of the same sample.
TEST(AbcGroom, CurvesThatBeginEmptyAreReadWhereTheyAre) {
  const std::vector<std::vector<Vec3d>> poses{{}, {}, abcCurl({2, 3}), abcCurl({4})};
  const std::vector<std::vector<std::int32_t>> counts{{}, {}, {2, 3}, {4}};
  AbcBytes::Object hair = abcMovingCurves("hair", counts, poses, {.sampling = 1});
  const LoadedGroom loaded = loadedOf({hair});
  EXPECT_EQ(loaded.groom.firstPoint, (std::vector<std::uint32_t>{0, 2, 5}));
  expectWarning(loaded,
                "1 curves object is without points at first, /hair at 1 s; read as at the first time");
  hair = abcMovingCurves("hair", {{}, {}}, {{}, {}}, {.sampling = 1});
  expectProblem(read({hair}), "g.abc: 1 curves object without a strand");
  expectWarning(loadedOf({hair, abcCurves("other", {2}, abcCurl({2}))}),
                "left out 1 curves object without points, /hair");
}

TEST(AbcGroom, HiddenObjectsAreLeftOut) {
  const auto visible = [](AbcBytes::Object object, std::int8_t number) {
    object.properties.push_back({.name = "visible",
                                 .kind = AbcBytes::scalar,
                                 .type = static_cast<AbcBytes::Type>(2),
                                 .samples = {abcNumber(number)}});
    return object;
  };
  const AbcBytes::Object hair = abcCurves("hair", {2}, {{0, 0, 0}, {0, 1, 0}});
  const auto below = [&](const AbcBytes::Object& object) {
    return abcXform("head", {0x10}, {{0, 0, 0}}, 0, {object});
  };
  const AbcBytes::Object drawn = abcCurves("drawn", {2}, {{5, 0, 0}, {5, 1, 0}});
  struct Case {
    AbcBytes::Object object;
    bool isDrawn;
  };
  const Case cases[] = {{visible(hair, 0), false},
                        {visible(hair, -1), true},
                        {visible(hair, 1), true},
                        {visible(below(hair), 0), false},
                        {visible(below(visible(hair, -1)), 0), false},
                        {visible(below(visible(hair, 1)), 0), true},
                        {visible(below(visible(hair, 0)), 1), false}};
  for (std::size_t k = 0; k < std::size(cases); ++k) {
    const LoadedGroom loaded = loadedOf({cases[k].object, drawn});
    EXPECT_EQ(loaded.groom.strandCount(), cases[k].isDrawn ? 2u : 1u) << k;
    EXPECT_EQ(loaded.warnings.size(), cases[k].isDrawn ? 0u : 1u) << k;
    if (cases[k].isDrawn) continue;
    expectWarning(loaded, "g.abc: left out curves that are not drawn: 1 hidden");
    expectProblem(read({cases[k].object}), "g.abc: its only curves object is hidden; expected some that are");
  }
}

// What is wrong with one object leaves it out beside another, and is the error where it is the only one.
TEST(AbcGroom, WhatCannotBeReadIsNamed) {
  const std::vector<std::int32_t> counts{4, 5};
  const std::vector<Vec3d> points = abcCurl(counts);
  const auto with = [&](AbcCurveForm form) { return abcCurves("X", counts, points, form); };
  const auto changed = [&](auto change) {
    AbcBytes::Object object = with({});
    change(object.properties[0].parts);
    return object;
  };
  using Parts = std::vector<AbcBytes::Property>;
  const auto counted = [&](const std::vector<std::int32_t>& each) {
    return changed([&](Parts& p) { p[1].samples = {abcNumbers(each)}; });
  };
  struct Case {
    AbcBytes::Object object;
    std::string sentence;
  };
  const AbcBytes::Property weights =
      abcArray("w", AbcBytes::f32, abcNumbers<float>({1, 1, 1, 1, 2, 1, 1, 1, 1}));
  const Case cases[] = {
      {with({.wrap = 1}), "its curves are closed loops (periodic); a strand has a root and a tip"},
      {with({.type = kAbcCubic, .wrap = 1, .basis = 2}), "its curves are closed loops (periodic)"},
      {with({.wrap = 2}), "found wrap 2; expected 0 (nonperiodic) or 1"},
      {with({.type = 3}), "found curves of type 3; expected 0 (cubic), 1 (linear) or 2"},
      {with({.type = kAbcCubic, .basis = 0}),
       "its cubic curves have the basis 'none'; expected Bezier, B-spline"},
      {with({.type = kAbcCubic, .basis = 4}), "the basis 'Hermite'"},
      {with({.type = kAbcCubic, .basis = 5}), "the basis 'power'"},
      {with({.type = kAbcCubic, .basis = 6}), "found basis 6; expected 0 to 5"},
      {with({.type = kAbcVariable, .basis = 2, .more = {ordersOf({4, 3})}}),
       "its curves are of orders from 3 to 4; expected all of order 2 (linear) or 4 (cubic)"},
      {with({.type = kAbcVariable, .basis = 2, .more = {ordersOf({3, 3})}}), "orders from 3 to 3"},
      {with({.type = kAbcCubic, .basis = 2, .more = {weights}}),
       "its points have weights (w), which are not read"},
      {counted({4, 6}), "its nVertices add up to 10, and it has 9 points; expected as many"},
      {counted({4, 4}), "its nVertices add up to 8, and it has 9 points"},
      {counted({-1, 10}), "found -1 in nVertices; expected counts of points"},
      {counted({}), "where all strands have as many points, say how many: --points-per-strand"},
      {changed([](Parts& p) { p.erase(p.begin()); }), "has no P"},
      {changed([](Parts& p) { p[0].samples.clear(); }), "has no P"},
      {changed([](Parts& p) { p[0].width = 9; }), "found P of 9 float32 an element; expected 3 floats"},
      {changed([](Parts& p) { p[0].type = AbcBytes::i32; }),
       "found P of 3 int32 an element; expected 3 floats"},
      {changed([](Parts& p) { p[0].samples[0].pop_back(); }),
       "P: found 107 bytes in sample 1; expected whole"},
      {changed([](Parts& p) { p[0].dimensions = {7}; }), "its dimensions say another number"},
      {changed([](Parts& p) { p[1].type = AbcBytes::f32; }), "found nVertices of float32; expected integers"},
      {changed([](Parts& p) { p.pop_back(); }), "has no curveBasisAndType"},
      {changed([](Parts& p) { p[2].width = 2, p[2].samples = {std::string("\1\0", 2)}; }),
       "found 2 numbers in curveBasisAndType; expected 4"},
      {{.name = "X", .metadata = "schema=AbcGeom_Curve_v2"}, "has no .geom"}};
  const AbcBytes::Object good = abcCurves("good", {2}, abcCurl({2}));
  for (const Case& c : cases) {
    SCOPED_TRACE(c.sentence);
    const auto alone = read({c.object});
    expectProblem(alone, "g.abc: /X: ");
    expectProblem(alone, c.sentence);
    const LoadedGroom beside = loadedOf({c.object, good});
    EXPECT_EQ(beside.groom.strandCount(), 1u);
    EXPECT_EQ(beside.warnings.size(), 1u);
    expectWarning(beside, "g.abc: left out 1 curves object, /X: ");
    expectWarning(beside, c.sentence);
  }
  const AbcBytes::Object lost = abcXform("up", {0x70}, {{0}}, 0, {with({})});
  expectProblem(read({lost}), "g.abc: /up/X: /up: found operation 112; expected 0 to 111");
  expectWarning(loadedOf({lost, good}), "left out 1 curves object, /up/X: /up: found operation 112");
}

TEST(AbcGroom, CurvesWithoutCountsAreCutWhereItIsSaid) {
  AbcBytes::Object hair = abcCurves("hair", {6}, abcCurl({6}));
  for (const bool isEmpty : {false, true}) {
    auto& parts = hair.properties[0].parts;
    if (isEmpty) {
      parts[1].samples = {""};
    } else {
      parts.erase(parts.begin() + 1);
    }
    EXPECT_EQ(loadedOf({hair}, {.pointsPerStrand = 3}).groom.strandCount(), 2u);
    expectProblem(read({hair}, {.pointsPerStrand = 4}), "/hair: ");
    hair = abcCurves("hair", {6}, abcCurl({6}));
  }
}

TEST(AbcGroom, CurvesThatAreNoStrandAreLeftOutBesideOthers) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(),
                   kInf = std::numeric_limits<float>::infinity();
  std::vector<Vec3d> points = abcCurl({1, 3, 2, 0, 2});
  for (const double bad : {kNone, kInf, -kInf}) {
    points[4].y = bad;
    const LoadedGroom loaded = loadedOf({abcCurves("hair", {1, 3, 2, 0, 2}, points)}, {.keepsPrims = true});
    EXPECT_EQ(loaded.groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
    EXPECT_FALSE(loaded.prims.at(0).isWhole);
    expectWarning(loaded, "left out 2 curves, which have too few points, the first of /hair");
    expectWarning(loaded, "left out 1 curve, the first of /hair: found (");
    expectWarning(loaded, "for curve 2, point 0; expected finite numbers");
  }
  // Also where the transform brings them out of what floats hold.
  const AbcBytes::Object far =
      abcXform("far", {0x00}, {{1e38, 1e38, 1e38}}, 0, {abcCurves("hair", {2}, {{0, 0, 0}, {0, 9, 0}})});
  expectProblem(read({far}), "g.abc: /far/hair: found (0, ");
}

TEST(AbcGroom, SaysWhatAFileHoldsInPlaceOfCurves) {
  const AbcBytes::Object mesh =
      abcMesh("body", AbcTriangles{{0, 1, 2}}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 0);
  const auto other = [](const std::string& name, const std::string& schema) {
    return AbcBytes::Object{.name = name, .metadata = "schema=" + schema};
  };
  expectProblem(
      read({mesh, abcXform("up", {0x10}, {{0, 0, 0}}, 0, {mesh})}),
      "g.abc: holds no curves, of which strands are made; it holds 2 meshes, 1 transform: export the hair "
      "as curves");
  expectProblem(
      read({other("a", "AbcGeom_Points_v1"), other("b", "AbcGeom_NuPatch_v2"), other("c", "AbcGeom_SubD_v1"),
            other("d", "Own_v9"), other("e", "")}),
      "it holds 1 object without a schema, 1 NURBS patch, 1 point cloud, 1 subdivision surface, 1 object "
      "of 'Own_v9': ");
  expectProblem(read(std::vector<AbcBytes::Object>{}), "g.abc: holds no objects; expected curves");
  AbcBytes::Object instance{.name = "copy"};
  instance.properties = {{.name = ".instanceSource",
                          .kind = AbcBytes::scalar,
                          .type = AbcBytes::text,
                          .samples = {std::string("/hair\0", 6)}}};
  const LoadedGroom loaded =
      loadedOf({abcCurves("hair", {2}, abcCurl({2})), other("a", "AbcGeom_Points_v1"),
                other("b", "AbcGeom_Points_v1"), other("c", "AbcGeom_NuPatch_v2"), instance, mesh});
  EXPECT_EQ(loaded.warnings.size(), 3u);
  expectWarning(loaded, "g.abc: 2 point clouds left aside; only curves are read");
  expectWarning(loaded, "g.abc: 1 NURBS patch left aside; only curves are read");
  expectWarning(loaded, "g.abc: 1 instance left aside; only the curves themselves are read");
}

TEST(AbcGroom, RefusesFilesOfOtherKinds) {
  std::string open = abcFile({abcCurves("hair", {2}, abcCurl({2}))});
  ASSERT_TRUE(read(open));
  open[5] = 0;
  expectProblem(read(open), "g.abc: was not closed by the program that wrote it");
  expectProblem(read("\x89HDF\r\n\x1a\n and more"), "is an Alembic file of the older kind, HDF5");
  expectProblem(read("PXR-USDC"), "expected 'Ogawa'");
  expectProblem(read(""), "expected 'Ogawa'");
}

// All children of the top object are its first.
std::string withSharedChild(std::string bytes) {
  const auto wordAt = [&](std::uint64_t place) { return readU64(std::as_bytes(std::span(bytes)), place); };
  const std::uint64_t top = wordAt(wordAt(8) + 8 * 3), count = wordAt(top);
  for (std::uint64_t k = 3; k < count; ++k) bytes.replace(top + 8 * k, 8, abcNumber(wordAt(top + 16)));
  return bytes;
}

// A file may say the same thing many times: what is made of it is bounded by its size.
TEST(AbcGroom, WhatObjectsShareIsBounded) {
  std::vector<Vec3d> points;
  for (int k = 0; k < 4000; ++k) points.push_back({static_cast<double>(k % 2), 0, 0});
  struct Case {
    std::vector<std::int32_t> counts;
    AbcCurveForm form;
    std::string sentence;
  };
  const Case cases[] = {
      {std::vector<std::int32_t>(4000, 1), {}, "g.abc: its objects share more than is read of a file of"},
      {std::vector<std::int32_t>(1000, 4), {.type = kAbcCubic, .basis = 1}, "particles, too many for its"}};
  for (const Case& c : cases) {
    std::vector<AbcBytes::Object> objects{abcCurves("hair", c.counts, points, c.form)};
    objects.resize(3000, {.name = "hair", .metadata = objects[0].metadata});
    expectProblem(read(withSharedChild(abcFile(objects))), c.sentence);
  }
}

// --- Files that the Alembic library wrote, with the figures of the README beside them.

void expectPoint(Vec3f p, Vec3d expected) {
  EXPECT_LE(length(Vec3d(p) - expected), 2e-5 * std::max(1.0, length(expected)))
      << p.x << " " << p.y << " " << p.z;
}

TEST(AbcGroom, ReadsLinearAnimatedCurvesOfTheLibrary) {
  RINGLET_NEEDS_DATA(path, "abc/curves_linear_animated.abc");
  const auto loaded = readGroom(path, {.keepsPrims = true});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->groom.strandCount(), 8u);
  for (std::size_t s = 0; s < 8; ++s) EXPECT_EQ(loaded->groom.strand(s).size(), 40 - 2 * s);
  EXPECT_EQ(loaded->groom.points.size(), 264u);
  expectPoint(loaded->groom.points.front(), {0, 160, 0});
  expectPoint(loaded->groom.points.back(), {6.60312, 152, 2.52559});
  ASSERT_EQ(loaded->warnings.size(), 2u);
  expectWarning(*loaded, "it moves; read as it is at its first sample, at 41.708333");
  expectWarning(*loaded, "left aside 1 value of curves, which move");  // the velocities
  ASSERT_EQ(loaded->prims.size(), 1u);
  const GroomPrim& prim = loaded->prims[0];
  EXPECT_EQ(prim.path, "/groom/head/curls");
  EXPECT_TRUE(prim.isWhole);
  struct Expected {
    const char *name, *type, *interpolation;
    std::size_t count;
    double first, last;
  };
  const Expected values[] = {{"widths", "float[]", "vertex", 264, 0.01, 0.003},
                             {"primvars:groom_id", "int[]", "uniform", 8, 100, 107},
                             {"primvars:groom_guide", "int[]", "uniform", 8, 1, 1},
                             {"primvars:groom_version_major", "int[]", "constant", 1, 1, 1},
                             {"primvars:groom_version_minor", "int[]", "constant", 1, 5, 5}};
  const auto valueOf = [&](std::string_view name) {
    const auto found = std::ranges::find(prim.values, name, &GroomValue::name);
    EXPECT_NE(found, prim.values.end()) << name;
    return found == prim.values.end() ? GroomValue{} : *found;
  };
  for (const Expected& expected : values) {
    const GroomValue value = valueOf(expected.name);
    EXPECT_EQ(value.type, expected.type) << expected.name;
    EXPECT_EQ(value.interpolation, expected.interpolation) << expected.name;
    ASSERT_EQ(value.numbers.size(), expected.count) << expected.name;
    EXPECT_NEAR(value.numbers.front(), expected.first, 1e-7) << expected.name;
    EXPECT_NEAR(value.numbers.back(), expected.last, 1e-7) << expected.name;
  }
  EXPECT_EQ(valueOf("primvars:groom_root_uv").type, "float2[]");
  EXPECT_EQ(valueOf("primvars:groom_root_uv").numbers.size(), 16u);
  EXPECT_EQ(valueOf("primvars:groom_width").numbers.size(), 264u);
  EXPECT_EQ(valueOf("primvars:groom_width").interpolation, "vertex");
  const GroomValue groups = valueOf("primvars:groom_group_name");
  EXPECT_EQ(groups.type, "string[]");
  EXPECT_EQ(groups.texts,
            (std::vector<std::string>{"left", "left", "left", "left", "right", "right", "right", "right"}));
}

TEST(AbcGroom, ReadsCubicCurvesOfTheLibrary) {
  RINGLET_NEEDS_DATA(path, "abc/curves_cubic_static.abc");
  const auto loaded = readGroom(path, {.keepsPrims = true});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->groom.strandCount(), 10u);
  ASSERT_EQ(loaded->prims.size(), 2u);
  const auto bytes = readWholeFile(path);
  ASSERT_TRUE(bytes);
  const auto archive = AbcArchive::of(*bytes, path.string());
  ASSERT_TRUE(archive);
  const char* paths[] = {"/scalp_hair/strands", "/beard/inner/strands"};
  const Vec3d last[] = {{-0.00522914, 0.02, 0.0139456}, {0.0272596, 0.02, 0.0633613}};
  for (std::size_t k = 0; k < 2; ++k) {
    const GroomPrim& prim = loaded->prims[k];
    EXPECT_EQ(prim.path, paths[k]);
    EXPECT_EQ(prim.strandCount, 5u);
    ASSERT_EQ(prim.values.size(), 1u);
    EXPECT_EQ(prim.values[0].name, "widths");
    EXPECT_EQ(prim.values[0].interpolation, "constant");
    EXPECT_NEAR(prim.values[0].numbers.at(0), 0.0008, 1e-9);
    // Its points: those of the file, and where its last strand ends by the definition of B-splines.
    std::uint32_t object = 0;
    while (archive->pathOf(object) != paths[k]) ++object;
    const auto geometry = archive->propertiesOf(archive->propertiesOf(object)->at(0));
    const auto sample = archive->stored(*abcPropertyNamed(*geometry, "P"), 0);
    ASSERT_EQ(sample->elementCount(), 70u);
    const auto point = [&](std::size_t i) {
      return Vec3d{sample->number(3 * i), sample->number(3 * i + 1), sample->number(3 * i + 2)};
    };
    EXPECT_LE(length(point(69) - last[k]), 1e-7);
    const Vec3d end = (point(67) + 4.0 * point(68) + point(69)) / 6;
    const Vec3d placed = k == 0 ? end : Vec3d{end.x, -end.z, end.y};
    EXPECT_LE(length(Vec3d(loaded->groom.strand(5 * k + 4).back()) - placed), 1e-8);
  }
}

TEST(AbcGroom, ReadsBezierAndCatmullRomCurvesOfTheLibrary) {
  RINGLET_NEEDS_DATA(path, "abc/curves_bezier_catmull.abc");
  const auto loaded = readGroom(path, {.keepsPrims = true});
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->groom.strandCount(), 6u);
  ASSERT_EQ(loaded->prims.size(), 2u);
  EXPECT_EQ(loaded->prims[0].path, "/bezier");
  EXPECT_EQ(loaded->prims[1].path, "/catmullrom");
  expectPoint(loaded->groom.strand(2).back(), {3.66708, 2, 0.727437});
  for (const GroomPrim& prim : loaded->prims) {
    ASSERT_EQ(prim.values.size(), 1u);
    EXPECT_EQ(prim.values[0].interpolation, "uniform");
    ASSERT_EQ(prim.values[0].numbers.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(prim.values[0].numbers[k], 0.02 + 0.01 * static_cast<double>(k), 1e-8);
  }
  expectWarning(*loaded, "6 curves are cubic");
  expectWarning(*loaded, "3 of them begin and end short");
}

TEST(AbcGroom, ReadsChangingCurvesOfTheLibraryAtTheirFirstTime) {
  RINGLET_NEEDS_DATA(path, "abc/curves_topology_changes.abc");
  const auto loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 10, 20, 30}));
  expectWarning(*loaded, "it moves; read as it is at its first sample");
}

TEST(AbcGroom, SaysThatAFileOfTheLibraryHoldsAMesh) {
  RINGLET_NEEDS_DATA(path, "abc/mesh_bending.abc");
  expectProblem(readGroom(path), "holds no curves, of which strands are made; it holds 1 mesh, 1 transform");
}

TEST(AbcGroom, FilesOfTheLibraryGoToEveryFormatAndBack) {
  const auto folder = scratchFolder("abc_groom");
  for (const char* name : {"linear_animated", "cubic_static", "bezier_catmull", "topology_changes"}) {
    const std::string file = fmt::format("abc/curves_{}.abc", name);
    RINGLET_NEEDS_DATA(path, file);
    const auto loaded = readGroom(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (const std::string& ending : writtenGroomEndings()) {
      const auto out = folder / (name + ending);
      ASSERT_TRUE(writeGroom(out, loaded->groom));
      const auto back = readGroom(out);
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_EQ(back->groom.firstPoint, loaded->groom.firstPoint) << out;
      EXPECT_EQ(back->groom.points, loaded->groom.points) << out;
    }
  }
}

}  // namespace
}  // namespace ringlet::test::abc_groom_test
