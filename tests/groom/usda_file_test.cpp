// groom/usd/usda_file.h and usd_groom.h: USD text as people and programs write it, what is left out, what is
// refused and by which name.
#include "ringlet/groom/usd/usda_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "ringlet/groom/groom_file.h"
#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/output/usd/usd_writer.h"
#include "tests/groom/groom_samples.h"
#include "tests/groom/usda_samples.h"
#include "tests/support/memory_limit.h"
#include "tests/support/test_support.h"

namespace ringlet::usda_file_test {
namespace {

using test::contains;
using test::curves;
using test::kTwoStrands;

Result<LoadedGroom> read(const std::string& text, const GroomReading& reading = {}) {
  return readUsd(test::bytesOf(text), "test.usda", reading);
}
Groom groomOf(const std::string& text) {
  const auto loaded = read(text);
  EXPECT_TRUE(loaded) << loaded.error().message << "\n" << text;
  return loaded ? loaded->groom : Groom{};
}
void expectError(const std::string& text, const std::vector<std::string>& parts) {
  const auto loaded = read(text);
  ASSERT_FALSE(loaded) << "expected an error with '" << parts.front() << "' for\n" << text;
  EXPECT_TRUE(contains(loaded.error().message, "test.usda")) << loaded.error().message;
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(loaded.error().message, part)) << part << " in\n" << loaded.error().message;
}
void expectWarning(const std::string& text, const std::string& part) {
  const auto loaded = read(text);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->warnings.size(), 1u) << text;
  EXPECT_TRUE(contains(loaded->warnings[0], part)) << part << " in\n" << loaded->warnings[0];
}

TEST(UsdaFile, ReadsLinearStrands) {
  const auto loaded = read(curves(kTwoStrands));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty());
  EXPECT_EQ(loaded->groom.firstPoint, (std::vector<std::uint32_t>{0, 3, 5}));
  EXPECT_EQ(loaded->groom.points,
            (std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0}, {0, -2, 0.5f}, {1, 0, 0}, {1, -1.5f, 0}}));
  EXPECT_FALSE(loaded->statesUnit);
  EXPECT_FALSE(loaded->statesUp);
  EXPECT_EQ(loaded->groom.metresPerUnit, 0.01);
}

TEST(UsdaFile, ReadsTextAsPeopleWriteIt) {
  // Comments, strings with brackets in them, list edits, relationships, connections elsewhere, odd spaces.
  const std::string text = R"(#usda 1.0
(   "a comment that is a string" ; doc = """several
    lines with a ] and a "quote" in them""" # behind
    customLayerData = { string a = "}" ; dictionary b = { double c = 1e400 } }
    metersPerUnit = 1.0
)
/* C's comments ( too */ // and these [
reorder rootPrims = ["A", "World"]
def "World" (
    prepend apiSchemas = ["SkelBindingAPI"]
    kind = 'group'
    references = None
    delete payload = @nowhere.usd@</A>
    inherits = []
    customData = {}
)
{
    rel material:binding = </Materials/Hair> (bindMaterialAs = "weakerThanDescendants")
    prepend rel some = [</A>, </B>]
    token outputs:surface.connect = </A.b>
    asset file = @@@a@b.png@@@
    reorder nameChildren = ["Hair"]
    def BasisCurves "Hair" ( active = 1 )
    {
        custom string note = "it's \"quoted\", with { and \\"
        uniform   token type="linear";token wrap = 'nonperiodic'
        int [] curveVertexCounts = [ 2 , ]
        point3f[] points = [ (0,-0.5e1,+3) , (1,  # in between
                              2 , 3, ), ] (  interpolation = "vertex" customData = { int x = 1 } )
        float[] widths = [0.1] ( interpolation = "constant" )
        matrix4d other = ( (1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1) )
        color3f[] primvars:displayColor = None
        uniform token[] empty = []
    }
}
)";
  const auto loaded = read(text);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings[0];
  EXPECT_EQ(loaded->groom.points, (std::vector<Vec3f>{{0, -5, 3}, {1, 2, 3}}));
  EXPECT_EQ(loaded->groom.metresPerUnit, 1);
  EXPECT_TRUE(loaded->statesUnit);
  EXPECT_TRUE(read(std::string("#usda 1.0\r\n") + text.substr(10)));
  EXPECT_TRUE(read(std::string("#usda 1.1\n") + text.substr(10)));
}

TEST(UsdaFile, ReadsAllPrimsInTheirOrder) {
  const std::string strand =
      "uniform token type = \"linear\" int[] curveVertexCounts = [2] point3f[] points = ";
  const std::string text = "#usda 1.0\ndef Xform \"B\" { def BasisCurves \"x\" { " + strand +
                           "[(1,0,0),(1,1,0)] } def BasisCurves \"y\" { " + strand +
                           "[(2,0,0),(2,1,0)] } }\ndef BasisCurves \"A\" { " + strand +
                           "[(3,0,0),(3,1,0)] def BasisCurves \"inside\" { " + strand +
                           "[(4,0,0),(4,1,0)] } }\n";
  const Groom groom = groomOf(text);
  ASSERT_EQ(groom.strandCount(), 4u);
  for (std::size_t s = 0; s < 4; ++s) EXPECT_EQ(groom.strand(s)[0].x, float(s + 1));
}

TEST(UsdaFile, TurnsZUpToYUpAndBack) {
  for (const char axis : {'Y', 'Z'}) {
    const std::string text = curves(kTwoStrands, fmt::format("( upAxis = \"{}\" )", axis));
    for (const bool upIsZ : {false, true}) {
      const auto loaded = read(text, {.upIsZ = upIsZ});
      ASSERT_TRUE(loaded) << loaded.error().message;
      EXPECT_TRUE(loaded->statesUp);
      const bool isTurned = (axis == 'Z') != upIsZ;
      EXPECT_EQ(loaded->warnings.size(), isTurned ? 1u : 0u);
      // (0, -2, 0.5) is up the other axis afterwards.
      const Vec3f found = loaded->groom.points[2];
      EXPECT_EQ(found, !isTurned     ? (Vec3f{0, -2, 0.5f})
                       : axis == 'Z' ? (Vec3f{0, 0.5f, 2})
                                     : (Vec3f{0, -0.5f, -2}));
      if (isTurned) {
        EXPECT_TRUE(contains(loaded->warnings[0], axis == 'Z' ? "turned from Z up" : "turned from Y up"));
      }
    }
  }
  expectError(curves(kTwoStrands, "( upAxis = \"X\" )"), {"found up axis 'X'; expected Y or Z"});
}

TEST(UsdaFile, TakesTheFilesUnitWhereItIsOne) {
  EXPECT_EQ(groomOf(curves(kTwoStrands, "( metersPerUnit = 0.0254 )")).metresPerUnit, 0.0254);
  for (const char* unit : {"0", "-1", "1e9", "nan"}) {
    const auto loaded = read(curves(kTwoStrands, fmt::format("( metersPerUnit = {} )", unit)));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_FALSE(loaded->statesUnit) << unit;
    EXPECT_EQ(loaded->groom.metresPerUnit, 0.01);
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_TRUE(contains(loaded->warnings[0], "which no hair has"));
  }
}

// One strand from (0,0,0) to (1,2,3) below a prim with these ops; the tip is returned.
Vec3f tipBelow(const std::string& ops, const std::string& inner = "") {
  const std::string text = "#usda 1.0\ndef Xform \"Top\" {\n" + ops + "\ndef BasisCurves \"Hair\" {\n" +
                           inner +
                           "\nuniform token type = \"linear\" int[] curveVertexCounts = [2] point3f[] points "
                           "= [(0,0,0),(1,2,3)] } }\n";
  const Groom groom = groomOf(text);
  return groom.points.size() == 2 ? groom.points[1] : Vec3f{NAN, NAN, NAN};
}
void expectNear(Vec3f found, Vec3f wanted) {
  EXPECT_LT(length(found - wanted), 1e-5f) << found.x << " " << found.y << " " << found.z;
}

TEST(UsdaFile, PlacesWhatIsBelowTransforms) {
  const auto one = [](const std::string& type, const std::string& op, const std::string& value) {
    return tipBelow(fmt::format("{} xformOp:{} = {} uniform token[] xformOpOrder = [\"xformOp:{}\"]", type,
                                op, value, op));
  };
  expectNear(one("double3", "translate", "(10, 20, 30)"), {11, 22, 33});
  expectNear(one("float3", "scale", "(2, 3, -1)"), {2, 6, -3});
  // A turn about X takes Y to Z, about Y takes Z to X, about Z takes X to Y.
  expectNear(one("float", "rotateX", "90"), {1, -3, 2});
  expectNear(one("float", "rotateY", "90"), {3, 2, -1});
  expectNear(one("float", "rotateZ", "90"), {-2, 1, 3});
  // The letters are the order: X first makes (1, -3, 2), then Y (2, -3, -1), then Z (3, 2, -1).
  expectNear(one("float3", "rotateXYZ", "(90, 90, 90)"), {3, 2, -1});
  // Z first (-2, 1, 3), then Y (3, 1, 2), then X (3, -2, 1).
  expectNear(one("float3", "rotateZYX", "(90, 90, 90)"), {3, -2, 1});
  // The numbers belong to X, Y and Z whatever the order: only Y by a quarter.
  expectNear(one("float3", "rotateZYX", "(0, 90, 0)"), {3, 2, -1});
  expectNear(one("float3", "rotateZXY", "(90, 0, 0)"), {1, -3, 2});
  // A quarter about Z, the real part first.
  expectNear(one("quatf", "orient", "(0.70710678, 0, 0, 0.70710678)"), {-2, 1, 3});
  // Rows: x goes to the first, and the last moves.
  expectNear(one("matrix4d", "transform", "((0,1,0,0),(-1,0,0,0),(0,0,2,0),(5,6,7,1))"), {3, 7, 13});
  expectNear(one("double", "translateY", "5"), {1, 7, 3});
  EXPECT_EQ(one("float3", "translate", "None"), (Vec3f{1, 2, 3}));
}

TEST(UsdaFile, ComposesTransformsFromTheLastToTheFirst) {
  const std::string both =
      "double3 xformOp:translate = (10, 0, 0) float xformOp:rotateZ = 90 "
      "double3 xformOp:translate:pivot = (1, 2, 3) ";
  // The first listed is the outermost: turned (-2, 1, 3), then moved.
  expectNear(tipBelow(both + "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\"]"),
             {8, 1, 3});
  expectNear(tipBelow(both + "uniform token[] xformOpOrder = [\"xformOp:rotateZ\", \"xformOp:translate\"]"),
             {-2, 11, 3});
  // About a pivot at the tip itself nothing moves the tip.
  expectNear(
      tipBelow(both + "uniform token[] xformOpOrder = [\"xformOp:translate:pivot\", \"xformOp:rotateZ\", "
                      "\"!invert!xformOp:translate:pivot\"]"),
      {1, 2, 3});
  // What is not in the order does not count, and neither does an order without ops.
  expectNear(tipBelow(both), {1, 2, 3});
  // The inner prim's first, then the outer's.
  const std::string inner =
      "float3 xformOp:scale = (2, 2, 2) uniform token[] xformOpOrder = [\"xformOp:scale\"]";
  expectNear(
      tipBelow(
          "double3 xformOp:translate = (10, 0, 0) uniform token[] xformOpOrder = [\"xformOp:translate\"]",
          inner),
      {12, 4, 6});
  // Unless it says that those above do not count.
  const std::string reset =
      "float3 xformOp:scale = (2, 2, 2) uniform token[] xformOpOrder = [\"!resetXformStack!\", "
      "\"xformOp:scale\"]";
  expectNear(
      tipBelow(
          "double3 xformOp:translate = (10, 0, 0) uniform token[] xformOpOrder = [\"xformOp:translate\"]",
          reset),
      {2, 4, 6});
  // Nor do those before it in its own order, where a file has some.
  expectNear(
      tipBelow(
          "double3 xformOp:translate = (10, 0, 0) uniform token[] xformOpOrder = [\"xformOp:translate\"]",
          "float3 xformOp:scale = (2, 2, 2) double xformOp:translateY = 5 uniform token[] xformOpOrder = "
          "[\"xformOp:translateY\", \"!resetXformStack!\", \"xformOp:scale\"]"),
      {2, 4, 6});
  // Inverses: of a matrix that scales and moves.
  expectNear(
      tipBelow("matrix4d xformOp:transform = ((2,0,0,0),(0,4,0,0),(0,0,1,0),(1,2,3,1)) uniform token[] "
               "xformOpOrder = [\"!invert!xformOp:transform\"]"),
      {0, 0, 0});
}

TEST(UsdaFile, RefusesTransformsItCannotFollow) {
  const auto below = [](const std::string& ops) {
    return "#usda 1.0\ndef Xform \"Top\" { " + ops + " " + curves(kTwoStrands).substr(10) + "}\n";
  };
  const auto order = [](const std::string& entry) {
    return "uniform token[] xformOpOrder = [\"" + entry + "\"] ";
  };
  expectError(below(order("xformOp:shear") + "float3 xformOp:shear = (1, 2, 3)"),
              {"/Top: 'xformOp:shear' is not known", "rotateXYZ"});
  expectError(below(order("xformOp:translate") + "double2 xformOp:translate = (1, 2)"),
              {"has 2 numbers; expected 3"});
  expectError(below(order("xformOp:rotateXX") + "double2 xformOp:rotateXX = (1, 2)"), {"is not known"});
  expectError(below(order("xformOp:translate") + "double3 xformOp:translate = (1, inf, 2)"),
              {"expected finite numbers"});
  expectError(below(order("!invert!xformOp:scale") + "float3 xformOp:scale = (1, 0, 2)"), {"has no inverse"});
  expectError(below(order("xformOp:orient") + "quatf xformOp:orient = (0, 0, 0, 0)"), {"a quaternion of 0"});
  expectError(below(order("xformOp:transform") +
                    "matrix4d xformOp:transform = ((1,0,0,1),(0,1,0,0),(0,0,1,0),(0,0,0,1))"),
              {"last column"});
  expectError(below(order("xformOp:translate") + "double3 xformOp:translate.connect = </A.b>"),
              {"given by a connection"});
  // Of a prim without hair below it nothing is asked.
  EXPECT_TRUE(read(curves(kTwoStrands) + "def Camera \"C\" { " + order("xformOp:shear") + "}\n"));
}

TEST(UsdaFile, LeavesOutWhatIsNotDrawn) {
  const std::string kept = curves(kTwoStrands);
  const auto with = [&](const std::string& prim) { return kept + prim; };
  const std::string inner =
      curves(
          "uniform token type = \"linear\" int[] curveVertexCounts = [2] point3f[] points = "
          "[(0,0,0),(0,1,0)]")
          .substr(10);
  const std::pair<std::string, std::string> cases[] = {
      {"def Xform \"X\" ( active = false ) {" + inner + "}", "1 inactive"},
      {"class \"X\" {" + inner + "}", "1 of a class"},
      {"over \"X\" {" + inner + "}", "1 only an `over`"},
      {"def Xform \"X\" { token visibility = \"invisible\" " + inner + "}", "1 invisible"},
      {"def Xform \"X\" { uniform token purpose = \"proxy\" " + inner + "}", "1 proxies"},
      {"def PointInstancer \"X\" {" + inner + "}", "1 below an instancer"}};
  for (const auto& [prim, words] : cases) {
    EXPECT_EQ(groomOf(with(prim)).strandCount(), 2u) << prim;
    expectWarning(with(prim), "left out BasisCurves that are not drawn: " + words);
    expectError("#usda 1.0\n" + prim, {"all its BasisCurves are left out: " + words});
  }
  // A prim of its own purpose below one of another.
  EXPECT_EQ(
      groomOf(
          with("def Xform \"X\" { uniform token purpose = \"proxy\" def Xform \"Y\" { uniform token purpose "
               "= \"render\" " +
               inner + "} }"))
          .strandCount(),
      3u);
  expectWarning(with("def Xform \"X\" { uniform token purpose = \"guide\" " + inner + "}"),
                "have purpose 'guide'");
}

TEST(UsdaFile, RefusesWhatOtherFilesBringIn) {
  for (const std::string field :
       {"references = @a.usd@</A> (offset = 1; scale = 2)", "prepend payload = @a.usd@",
        "inherits = </_class>", "add specializes = [</A>]", "variants = { string a = \"b\" }",
        "prepend variantSets = [\"look\"]", "clips = { dictionary default = { int a = 1 } }"}) {
    const std::size_t begin = field.find_first_not_of(' '), space = field.find(' ');
    const std::string first = field.substr(begin, space);
    const std::string name = first == "prepend" || first == "add"
                                 ? field.substr(space + 1, field.find(' ', space + 1) - space - 1)
                                 : first;
    const std::string above =
        "#usda 1.0\ndef Xform \"Top\" ( " + field + " ) {" + curves(kTwoStrands).substr(10) + "}\n";
    expectError(above, {"/Top: has " + name, "usdcat --flatten"});
    // Beside the curves it is only said.
    expectWarning(curves(kTwoStrands) + "def Xform \"Top\" ( " + field + " ) {}\n", "/Top has " + name);
  }
  expectError("#usda 1.0\ndef Xform \"Top\" { variantSet \"look\" = { \"a\" { } } " +
                  curves(kTwoStrands).substr(10) + "}\n",
              {"/Top: has variantSet"});
  expectError(curves(kTwoStrands, "( subLayers = [ @a.usd@, @b.usd@ (offset = 3) ] )"),
              {"has subLayers", "--flatten"});
  EXPECT_TRUE(read(curves(kTwoStrands, "( subLayers = [ ] )")));
  expectError("#usda 1.0\ndef Xform \"Top\" ( references = @hair.usd@ ) {}\n",
              {"found no BasisCurves", "1 Xform", "/Top has references", "--flatten"});
  expectError(curves("point3f[] points.connect = </A.b> int[] curveVertexCounts = [2]"),
              {"/Hair: its points are given by a connection"});
}

TEST(UsdaFile, SaysWhichPrimsItFound) {
  expectError("#usda 1.0\n", {"found no prims; expected BasisCurves"});
  expectError("#usda 1.0\ndef Mesh \"A\" {} def Mesh \"B\" {} def NurbsCurves \"C\" {} def \"D\" {}\n",
              {"found no BasisCurves", "2 Mesh", "1 NurbsCurves", "1 without a type"});
  expectWarning(curves(kTwoStrands) + "def NurbsCurves \"C\" {}\n", "1 NurbsCurves left aside");
}

TEST(UsdaFile, RefusesFormsItCannotRead) {
  const std::string points =
      "int[] curveVertexCounts = [4] point3f[] points = [(0,0,0),(0,1,0),(0,2,0),(0,3,0)] ";
  expectError(curves(points + "uniform token wrap = \"periodic\""), {"/Hair: its curves are closed loops"});
  expectError(curves(points + "uniform token wrap = \"segmented\""), {"found wrap 'segmented'"});
  expectError(curves(points + "uniform token type = \"quadratic\""),
              {"found type 'quadratic'; expected linear or cubic"});
  expectError(curves(points + "uniform token basis = \"hermite\""),
              {"found basis 'hermite'; expected bezier"});
  // Linear curves have no basis.
  EXPECT_TRUE(read(curves(points + "uniform token type = \"linear\" uniform token basis = \"hermite\"")));
}

TEST(UsdaFile, RefusesCountsAndPointsThatDoNotFit) {
  const std::string linear = "uniform token type = \"linear\" ";
  expectError(curves(linear + "int[] curveVertexCounts = [3] point3f[] points = [(0,0,0),(0,1,0)]"),
              {"/Hair: its curveVertexCounts add up to 3, and it has 2 points"});
  expectError(curves(linear + "point3f[] points = [(0,0,0),(0,1,0)]"), {"add up to 0, and it has 2 points"});
  expectError(curves(linear + "int[] curveVertexCounts = [-2, 4] point3f[] points = [(0,0,0),(0,1,0)]"),
              {"found -2 in curveVertexCounts"});
  expectError(curves(linear + "int[] curveVertexCounts = [1.5, 0.5] point3f[] points = [(0,0,0),(0,1,0)]"),
              {"found 1.5 in curveVertexCounts"});
  expectError(curves(linear + "int[] curveVertexCounts = [2] point3f[] points = [(0,0),(0,1)]"),
              {"its points have 2 numbers each; expected 3"});
  expectError(curves(linear + "int[] curveVertexCounts = [2] point3f[] points = [(0,0,0),(0,1)]"),
              {"line 3", "found an element of 2 numbers; expected 3"});
  expectError(curves(linear + "int2[] curveVertexCounts = [(1,1)] point3f[] points = [(0,0,0),(0,1,0)]"),
              {"found tuples as curveVertexCounts"});
  for (const char* bad : {"nan", "inf", "-inf", "1e39", "-1e300"}) {
    expectError(
        curves(linear + "int[] curveVertexCounts = [2] point3f[] points = [(0,0,0),(0,1," + bad + ")]"),
        {"for curve 0, point 1; expected finite numbers"});
  }
  // Only a transform makes it too large.
  expectError(
      "#usda 1.0\ndef Xform \"A\" { double3 xformOp:scale = (1e30,1,1) uniform token[] xformOpOrder = "
      "[\"xformOp:scale\"] " +
          curves(linear + "int[] curveVertexCounts = [2] point3f[] points = [(0,0,0),(1e20,1,0)]")
              .substr(10) +
          "}",
      {"expected finite numbers"});
  expectError(curves(linear + "int[] curveVertexCounts = [] point3f[] points = []"),
              {"1 BasisCurves prim without a strand"});
  expectWarning(
      curves(linear + "int[] curveVertexCounts = [1, 2, 0] point3f[] points = [(9,9,9),(0,0,0),(0,1,0)]"),
      "left out 2 curves, which have too few points");
}

TEST(UsdaFile, ReadsTheFirstSampleWhereverItStands) {
  const std::string linear = "uniform token type = \"linear\" int[] curveVertexCounts = [2] ";
  const std::string samples =
      "point3f[] points.timeSamples = { 3: [(3,0,0),(3,1,0)], 1.5: [(1,0,0),(1,1,0)], 2: None, }";
  const std::string standard = " point3f[] points = [(9,0,0),(9,1,0)] ";
  for (const std::string& text :
       {linear + samples, linear + samples + standard, linear + standard + samples}) {
    EXPECT_EQ(groomOf(curves(text)).points[0], (Vec3f{1, 0, 0})) << text;
    expectWarning(curves(text), "it moves; read as it is at its first sample, at time 1.5");
  }
  // One sample does not move.
  const auto still = read(curves(linear + "point3f[] points.timeSamples = { 7: [(3,0,0),(3,1,0)] }"));
  ASSERT_TRUE(still);
  EXPECT_TRUE(still->warnings.empty());
}

TEST(UsdaFile, ReadsWhatRingletWrites) {
  const auto folder = test::scratchFolder("usda_own");
  const Groom groom = test::awkwardGroom();
  Groom small;  // numbers that text keeps to the bit
  small.addStrand(std::vector<Vec3f>{{0.1f, -0.f, 1.f / 3}, {16777217.f, 1e-30f, -2.5f}});
  small.addStrand(std::vector<Vec3f>{{1, 2, 3}, {1, 2, 3}, {4, 5, 6}});
  for (const double unit : {0.01, 1.0}) {
    auto writer = UsdWriter::create(folder / "hair.usda", small, {.metresPerUnit = unit, .frameCount = 2});
    ASSERT_TRUE(writer);
    std::vector<Vec3f> later = small.points;
    for (Vec3f& p : later) p.x += 1;
    ASSERT_TRUE(writer->addFrame(small.points));
    ASSERT_TRUE(writer->addFrame(later));
    ASSERT_TRUE(writer->finish());
    const auto loaded = readGroom(folder / "hair.usda");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(test::hasSameBits(loaded->groom, small));
    EXPECT_EQ(loaded->groom.metresPerUnit, unit);
    EXPECT_TRUE(loaded->statesUnit);
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_TRUE(contains(loaded->warnings[0], "at time 1"));
  }
}

TEST(UsdaFile, NamesLineAndWhatItWanted) {
  expectError("", {"found ''; expected '#usda 1.0'"});
  expectError("#usda 2.0\n", {"expected '#usda 1.0'"});
  expectError("PK\3\4", {"expected a whole .usdz package"});
  expectError("#usda 1.0\n\n}\n", {"line 3", "found '}", "expected a prim"});
  expectError("#usda 1.0\nint a = 3\n", {"line 2", "expected a prim: 'def', 'over' or 'class'"});
  expectError("#usda 1.0\ndef Xform A {}\n", {"line 2", "expected the prim's name in quotes"});
  expectError("#usda 1.0\ndef Xform \"A\n{}\n", {"line 2", "without its end"});
  expectError("#usda 1.0\ndef Xform \"A\" {\n\n", {"line 4", "found the end of the file; expected '}'"});
  expectError("#usda 1.0\ndef Xform \"A\" { float[] a = [1, (2] }\n", {"expected ')'"});
  expectError("#usda 1.0\n( upAxis \"Y\" )\n", {"line 2", "expected '='"});
  expectError(curves("point3f[] points = [(0, 0, x)]"), {"line 3", "found 'x", "expected a number"});
  expectError(curves("point3f[] points = [(0, 0, 0) (1"), {"line 3", "expected ',' or ']'"});
}

TEST(UsdaFile, RefusesEveryTruncation) {
  const std::string whole = curves(kTwoStrands, "( upAxis = \"Z\" metersPerUnit = 1 )");
  ASSERT_TRUE(read(whole));
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    const auto loaded = read(whole.substr(0, size));
    ASSERT_FALSE(loaded) << whole.substr(0, size);
    ASSERT_GT(loaded.error().message.size(), 20u);
  }
}

TEST(UsdaFile, RefusesBombs) {
  const test::MemoryLimit limit(256u << 20);
  std::string prims = "#usda 1.0\n", brackets = "#usda 1.0\ndef \"A\" { int a = ";
  for (int i = 0; i < 100000; ++i) prims += "def \"A\" {";
  expectError(prims, {"at most 256 prims in each other"});
  expectError(brackets + std::string(100000, '['), {"at most 256 brackets in each other"});
  expectError("#usda 1.0\n" + std::string(100000, '('), {"expected"});
  std::string ops = "#usda 1.0\ndef Xform \"A\" {\n";
  for (int i = 0; i < 1000; ++i) ops += fmt::format("double3 xformOp:translate:a{} = (1, 2, 3)\n", i);
  expectError(ops + "}\n", {"at most 256 transforms of a prim"});
  expectError(curves("point3f[] points = [(" + std::string(1000, '1') + ")]"), {"expected a number"});
  std::string wide = "(";
  for (int i = 0; i < 20; ++i) wide += "1,";
  expectError(curves("point3f[] points = [" + wide + ")]"), {"a tuple of at most 16 numbers"});
}

// What the files say, by eye; the numbers of Blender's B-splines are in usdc_file_test.cpp.
TEST(UsdaFile, ReadsPixarsExamples) {
  RINGLET_NEEDS_DATA(path, "usd/pxr_basisCurves_examples.usda");
  const auto loaded = readGroom(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->groom.strandCount(), 10u);
  // The first: linear, below two translations, (0, 9, 0) and (3, 0, 0).
  EXPECT_EQ(loaded->groom.strand(0).size(), 7u);
  EXPECT_EQ(loaded->groom.strand(0)[0], (Vec3f{3, 9, 0}));
  EXPECT_EQ(loaded->groom.strand(0)[6], (Vec3f{3, 15, 0}));
  // The fifth: two Bezier pieces, whose ends and middle are points of the file.
  const auto bezier = loaded->groom.strand(4);
  EXPECT_EQ(bezier.front(), (Vec3f{3, 0, 0}));
  EXPECT_EQ(bezier[bezier.size() / 2], (Vec3f{3, 3, 0}));
  EXPECT_EQ(bezier.back(), (Vec3f{3, 6, 0}));
}

TEST(UsdaFile, ReadsMovingCountsOfPixarsBunny) {
  RINGLET_NEEDS_DATA(path, "usd/pxr_bunnyCurves.usda");
  const auto loaded = readGroom(path, {.upIsZ = true});
  ASSERT_TRUE(loaded) << loaded.error().message;
  // Of 8, 13, 10, 9, 7 and 5 points three are no Bezier curves.
  EXPECT_EQ(loaded->groom.strandCount(), 3u);
  EXPECT_EQ(loaded->groom.points.front(), (Vec3f{17.6f, 0, 9.35f}));
}

TEST(UsdaFile, ReadsAThousandStrandsOfBlender) {
  RINGLET_NEEDS_DATA(path, "usd/hair-blender-3.0.1.usda");
  const auto loaded = readGroom(path, {.upIsZ = true});
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->groom.strandCount(), 1000u);
  // (1 + 4 x 1.4303906 + 2.0314999) / 6 along Z.
  EXPECT_LT(length(loaded->groom.points.front() - Vec3f{-0.47472772f, -0.70670986f, 1.45884372f}), 1e-6f);
}

}  // namespace
}  // namespace ringlet::usda_file_test
