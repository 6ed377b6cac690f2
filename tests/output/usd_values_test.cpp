// What USD files of ours say beside points: text and crates the same, as the reader of grooms reads it; what
// a groom's file said of its curves, carried over; and changes of the groom's own prims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "ringlet/groom/usd/usd_file.h"
#include "ringlet/groom/usd/usd_layer.h"
#include "ringlet/groom/usd/usda_file.h"
#include "ringlet/groom/usd/usdc_file.h"
#include "ringlet/output/animation_reader.h"
#include "ringlet/output/animation_writer.h"
#include "tests/support/test_support.h"

namespace ringlet::usd_values_test {
namespace {

namespace fs = std::filesystem;
using test::scratchFolder;

constexpr int kFrames = 3;

// Two prims: one moved and of twice the size, of two strands; one turned, of two. Colours of each strand, of
// all; widths of points; UVs; a name; a number that only one of them has.
constexpr const char* kGroomText = R"(#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "Head"
{
    def BasisCurves "Left"
    {
        double3 xformOp:translate = (10, 20, 30)
        float3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
        uniform token type = "linear"
        int[] curveVertexCounts = [3, 2]
        point3f[] points = [(0, 0, 0), (0, -1, 0.25), (0.5, -2, 0), (1, 0, 0), (1, -1.5, 0)]
        float[] widths = [0.5, 0.25, 0.125, 0.5, 0.25] (interpolation = "vertex")
        color3f[] primvars:displayColor = [(1, 0, 0.5), (0.25, 1, 0)] (interpolation = "uniform")
        int[] primvars:id = [42, 7] (interpolation = "uniform")
        texCoord2f[] primvars:st = [(0, 1), (0.5, 0.75)] (interpolation = "uniform")
        string primvars:look = "fair \"and\" long"
        half3[] primvars:odd = [(1, 2, 3)]
    }
    def BasisCurves "Right"
    {
        double3 xformOp:rotateXYZ = (0, 90, 0)
        uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
        uniform token type = "linear"
        int[] curveVertexCounts = [4, 2]
        point3f[] points = [(0, 0, 0), (0, -1, 0), (0, -2, 0), (0, -3, 0.5), (2, 0, 0), (2, -1, 0)]
        float[] widths = [0.5, 0.25, 0.125, 0.0625, 0.5, 0.25] (interpolation = "vertex")
        color3f[] primvars:displayColor = [(0, 0, 1)]
        int[] primvars:id = [11, 5] (interpolation = "uniform")
        texCoord2f[] primvars:st = [(1, 1), (0.25, 0)] (interpolation = "uniform")
        float primvars:alone = 3
    }
}
)";

std::vector<std::byte> bytesOf(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}
std::vector<std::byte> fileBytes(const fs::path& path) { return bytesOf(test::readText(path)); }

LoadedGroom groomOf(const char* text = kGroomText) {
  auto read = readUsd(bytesOf(text), "groom.usda", {.keepsPrims = true});
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(*read) : LoadedGroom{};
}

std::vector<Vec3f> pointsAt(const Groom& groom, int frame) {
  auto points = groom.points;
  for (Vec3f& p : points) p.z += 0.125f * static_cast<float>(frame);
  return points;
}

fs::path write(const std::string& ending, const Groom& groom, const UsdExtras& extras) {
  const fs::path path = scratchFolder("usd_values") / ("hair" + ending);
  auto writer = animationFormatOf(path)->resume(path, groom,
                                                {.diameter = 0.04f, .frameCount = kFrames, .usd = extras}, 0);
  EXPECT_TRUE(writer) << writer.error().message;
  for (int frame = 1; frame <= kFrames; ++frame) EXPECT_TRUE((*writer)->addFrame(pointsAt(groom, frame)));
  EXPECT_TRUE((*writer)->finish());
  return path;
}

// As a groom, with all that is said of its prim.
GroomPrim primOf(const fs::path& path) {
  auto read = readUsd(fileBytes(path), path, {.keepsPrims = true});
  EXPECT_TRUE(read) << read.error().message;
  if (!read || read->prims.size() != 1) {
    ADD_FAILURE() << path << " has not one prim";
    return {};
  }
  EXPECT_EQ(read->groom.points.size(), read->groom.firstPoint.back());
  return read->prims.front();
}
const GroomValue& valueOf(const GroomPrim& prim, std::string_view name) {
  static const GroomValue none;
  const auto found = std::ranges::find(prim.values, name, &GroomValue::name);
  if (found == prim.values.end()) ADD_FAILURE() << "no " << name;
  return found == prim.values.end() ? none : *found;
}

TEST(UsdValues, TextAndCrateSayTheSame) {
  const LoadedGroom groom = groomOf();
  const UsdExtras extras{
      .tipDiameter = 0.01f, .ids = true, .rest = true, .origin = &groom, .originValues = true};
  const GroomPrim text = primOf(write(".usda", groom.groom, extras)),
                  crate = primOf(write(".usdc", groom.groom, extras));
  EXPECT_EQ(text.path, crate.path);
  ASSERT_EQ(text.values.size(), crate.values.size());
  for (const GroomValue& value : text.values) {
    const GroomValue& other = valueOf(crate, value.name);
    EXPECT_EQ(value.type, other.type) << value.name;
    EXPECT_EQ(value.interpolation, other.interpolation) << value.name;
    EXPECT_EQ(value.texts, other.texts) << value.name;
    ASSERT_EQ(value.numbers.size(), other.numbers.size()) << value.name;
    for (std::size_t i = 0; i < value.numbers.size(); ++i)
      EXPECT_EQ(static_cast<float>(value.numbers[i]), static_cast<float>(other.numbers[i])) << value.name;
  }
}

TEST(UsdValues, IdsRestPositionsAndATaper) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0.1f}, {0.3f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, 0}});
  for (const char* ending : {".usda", ".usdc"}) {
    SCOPED_TRACE(ending);
    const GroomPrim prim = primOf(write(ending, groom, {.tipDiameter = 0.02f, .ids = true, .rest = true}));
    const GroomValue &ids = valueOf(prim, "primvars:id"), &rest = valueOf(prim, "primvars:rest"),
                     &widths = valueOf(prim, "widths");
    EXPECT_EQ(ids.type, "int[]");
    EXPECT_EQ(ids.interpolation, "uniform");
    EXPECT_EQ(ids.numbers, (std::vector<double>{0, 1}));
    EXPECT_EQ(rest.type, "point3f[]");
    EXPECT_EQ(rest.interpolation, "vertex");
    ASSERT_EQ(rest.numbers.size(), 15u);
    for (std::size_t i = 0; i < 5; ++i) {
      const Vec3f p = groom.points[i];
      EXPECT_EQ(static_cast<float>(rest.numbers[3 * i]), p.x);
      EXPECT_EQ(static_cast<float>(rest.numbers[3 * i + 1]), p.y);
      EXPECT_EQ(static_cast<float>(rest.numbers[3 * i + 2]), p.z);
    }
    EXPECT_EQ(widths.interpolation, "vertex");
    ASSERT_EQ(widths.numbers.size(), 5u);
    const double expected[]{0.04, 0.03, 0.02, 0.04, 0.02};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(widths.numbers[i], expected[i], 1e-9) << i;
  }
}

TEST(UsdValues, EachStrandIsAsWideAsItsFactorSays) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0.1f}, {0.3f, -2, 0}});
  groom.addStrand(std::vector<Vec3f>{{1, 0, 0}, {1, -1.5f, 0}});
  for (const char* ending : {".usda", ".usdc"}) {
    SCOPED_TRACE(ending);
    const fs::path path = write(ending, groom, {.widthFactors = {2, 0.5f}});
    const auto expectWidths = [](const GroomPrim& prim, const char* interpolation,
                                 std::vector<double> expected) {
      const GroomValue& widths = valueOf(prim, "widths");
      EXPECT_EQ(widths.interpolation, interpolation);
      ASSERT_EQ(widths.numbers.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_FLOAT_EQ(static_cast<float>(widths.numbers[i]), static_cast<float>(expected[i])) << i;
    };
    expectWidths(primOf(path), "uniform", {0.08, 0.02});
    const auto reader = AnimationReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_FLOAT_EQ(reader->header().diameter, 0.08f);
    expectWidths(primOf(write(ending, groom, {.tipDiameter = 0.02f, .widthFactors = {2, 0.5f}})), "vertex",
                 {0.08, 0.06, 0.04, 0.02, 0.01});
  }
}

// Of several prims one: what is of a prim becomes a value of each strand, in the groom's order; widths grow
// with their prim.
TEST(UsdValues, WhatTheGroomSaysIsCarriedOver) {
  const LoadedGroom groom = groomOf();
  for (const char* ending : {".usda", ".usdc"}) {
    SCOPED_TRACE(ending);
    const GroomPrim prim =
        primOf(write(ending, groom.groom, {.ids = true, .origin = &groom, .originValues = true}));
    EXPECT_EQ(valueOf(prim, "primvars:id").numbers, (std::vector<double>{42, 7, 11, 5}));
    const GroomValue& colour = valueOf(prim, "primvars:displayColor");
    EXPECT_EQ(colour.type, "color3f[]");
    EXPECT_EQ(colour.interpolation, "uniform");
    EXPECT_EQ(colour.numbers, (std::vector<double>{1, 0, 0.5, 0.25, 1, 0, 0, 0, 1, 0, 0, 1}));
    EXPECT_EQ(valueOf(prim, "primvars:st").numbers, (std::vector<double>{0, 1, 0.5, 0.75, 1, 1, 0.25, 0}));
    EXPECT_EQ(valueOf(prim, "widths").numbers,
              (std::vector<double>{1, 0.5, 0.25, 1, 0.5, 0.5, 0.25, 0.125, 0.0625, 0.5, 0.25}));
    for (const char* ofOne : {"primvars:alone", "primvars:look", "primvars:odd"})
      EXPECT_EQ(std::ranges::count(prim.values, ofOne, &GroomValue::name), 0) << ofOne;
  }
}

// Of one prim all of it, texts and halves too.
TEST(UsdValues, OfOnePrimEverythingIsCarriedOver) {
  std::string text = kGroomText;
  text.erase(text.find("    def BasisCurves \"Right\""));
  text += "}\n";
  const LoadedGroom groom = groomOf(text.c_str());
  for (const char* ending : {".usda", ".usdc"}) {
    SCOPED_TRACE(ending);
    const GroomPrim prim = primOf(write(ending, groom.groom, {.origin = &groom, .originValues = true}));
    EXPECT_EQ(valueOf(prim, "primvars:odd").numbers, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(valueOf(prim, "primvars:odd").type, "half3[]");
    ASSERT_EQ(valueOf(prim, "primvars:look").texts.size(), 1u);
    EXPECT_EQ(valueOf(prim, "primvars:look").texts.front(), "fair \"and\" long");
  }
}

// The prims of the groom's file, at their paths and in their order, with points where these stand in the
// file.
TEST(UsdValues, ChangesOfTheGroomsPrims) {
  const LoadedGroom groom = groomOf();
  const fs::path path =
      write(".usdc", groom.groom, {.velocities = true, .origin = &groom, .originPrims = true});
  const auto bytes = fileBytes(path);
  const auto layer = readUsdc(bytes, path.string(), {.content = UsdContent::strandsAndValues});
  ASSERT_TRUE(layer) << layer.error().message;
  ASSERT_EQ(layer->prims.size(), 3u);
  const char* paths[]{"/Head", "/Head/Left", "/Head/Right"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(usdPathOf(*layer, i), paths[i]);
    EXPECT_EQ(layer->prims[i].specifier, UsdSpecifier::over);
    for (const UsdAttribute& attribute : layer->prims[i].attributes) {
      EXPECT_FALSE(attribute.name.starts_with("primvars:") || attribute.name == "widths")
          << attribute.name << ": what the groom's file says stands there";
    }
  }

  // Laid over the groom: its prims bring them to where they were simulated.
  auto reader = AnimationReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->groom().firstPoint, groom.groom.firstPoint);
  for (int frame = 1; frame <= kFrames; ++frame) {
    ASSERT_TRUE(reader->readFrame(frame));
    std::vector<Vec3f> placed = reader->groom().points;
    for (const GroomPrim& prim : groom.prims) {
      for (std::uint32_t i = groom.groom.firstPoint[prim.firstStrand];
           i < groom.groom.firstPoint[prim.firstStrand + prim.strandCount]; ++i)
        placed[i] = Vec3f(prim.toGroom(Vec3d(placed[i])));
    }
    // Coordinates below 64, rounded to float32 once on the way and once back, at twice the size.
    EXPECT_LT(test::farthestApart(placed, pointsAt(groom.groom, frame)), 64 * 0x1p-24 * 4);
  }
}

// Curves that were left out or cut into edges are not those of the file any more: all is said of them anew.
TEST(UsdValues, ChangesOfCubicCurvesSayWhatTheyAre) {
  std::string text = kGroomText;
  text.replace(text.find("type = \"linear\""), 15, "type = \"cubic\" ");
  text.replace(text.find("point3f[] points"), 0,
               "uniform token basis = \"bspline\"\n uniform token wrap = \"pinned\"\n");
  const LoadedGroom groom = groomOf(text.c_str());
  ASSERT_FALSE(groom.prims.front().isWhole);
  const fs::path path = write(".usdc", groom.groom, {.origin = &groom, .originPrims = true});
  const auto bytes = fileBytes(path);
  const auto layer = readUsdc(bytes, path.string(), {.content = UsdContent::strandsAndValues});
  ASSERT_TRUE(layer) << layer.error().message;
  const auto has = [&](std::size_t prim, std::string_view name) {
    return std::ranges::count(layer->prims[prim].attributes, name, &UsdAttribute::name) == 1;
  };
  for (const char* name : {"type", "wrap", "curveVertexCounts", "widths", "primvars:id"})
    EXPECT_TRUE(has(1, name)) << name;
  EXPECT_FALSE(has(2, "widths")) << "its curves are as they were";
}

TEST(UsdValues, WithoutBeingAskedNothingIsAdded) {
  Groom groom;
  groom.addStrand(std::vector<Vec3f>{{0, 0, 0}, {0, -1, 0}});
  for (const char* ending : {".usda", ".usdc"}) {
    const GroomPrim prim = primOf(write(ending, groom, {}));
    ASSERT_EQ(prim.values.size(), 1u) << ending;
    EXPECT_EQ(prim.values.front().name, "widths");
    EXPECT_EQ(prim.values.front().interpolation, "constant");
  }
}

}  // namespace
}  // namespace ringlet::usd_values_test
