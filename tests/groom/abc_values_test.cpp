// groom/alembic/abc_params.h: what Alembic says of curves beside their points, of every scope and type, as
// the values of grooms; carried on into USD files and read back; and what does not fit.
#include "ringlet/groom/alembic/abc_params.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ringlet/groom/alembic/abc_groom.h"
#include "ringlet/groom/groom_file.h"
#include "ringlet/output/animation_writer.h"
#include "tests/groom/abc_curve_samples.h"
#include "tests/groom/groom_samples.h"
#include "tests/support/test_support.h"

namespace ringlet::test::abc_values_test {
namespace {

const std::vector<std::int32_t> kCounts{3, 2};
constexpr std::size_t kCurves = 2, kPoints = 5;

LoadedGroom loadedOf(const std::vector<AbcBytes::Object>& objects) {
  auto loaded = readAbcGroom(bytesOf(abcFile(objects)), "g.abc", {.keepsPrims = true});
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? std::move(*loaded) : LoadedGroom{};
}
LoadedGroom loadedOf(const AbcCurveForm& form) {
  return loadedOf({abcCurves("hair", kCounts, abcCurl(kCounts), form)});
}
const GroomValue* valueNamed(const LoadedGroom& loaded, std::string_view name, std::size_t prim = 0) {
  const auto& values = loaded.prims.at(prim).values;
  const auto found = std::ranges::find(values, name, &GroomValue::name);
  return found == values.end() ? nullptr : &*found;
}
std::size_t leftAside(const LoadedGroom& loaded) {
  for (const std::string& warning : loaded.warnings)
    if (const auto at = warning.find("left aside "); at != warning.npos && contains(warning, "of curves"))
      return std::stoul(warning.substr(at + 11));
  return 0;
}

// Whole numbers from 1 on, as a type has them.
std::string numbersOf(std::uint32_t type, std::size_t count) {
  std::string bytes;
  for (std::size_t k = 1; k <= count; ++k) {
    const int exponent = static_cast<int>(std::log2(k));
    switch (type) {
      case 0:
      case 1:
      case 2:
        bytes += abcNumber(static_cast<std::uint8_t>(type == 0 ? k % 2 : k));
        break;
      case 3:
      case 4:
        bytes += abcNumber(static_cast<std::uint16_t>(k));
        break;
      case 5:
      case 6:
        bytes += abcNumber(static_cast<std::uint32_t>(k));
        break;
      case 7:
      case 8:
        bytes += abcNumber(static_cast<std::uint64_t>(k));
        break;
      case 9:
        bytes += abcNumber(
            static_cast<std::uint16_t>((15 + exponent) << 10 | (k - (1u << exponent)) << (10 - exponent)));
        break;
      case 10:
        bytes += abcNumber(static_cast<float>(k));
        break;
      default:
        bytes += abcNumber(static_cast<double>(k));
    }
  }
  return bytes;
}

struct Scope {
  const char *word, *interpolation;
  std::size_t count;
};
constexpr Scope kScopes[] = {
    {"con", "constant", 1},     {"con", "constant", 3},      {"uni", "uniform", kCurves},
    {"vtx", "vertex", kPoints}, {"var", "varying", kPoints}, {"fvr", "vertex", kPoints},
    {"", "constant", 1},        {"", "uniform", kCurves},    {"unk", "vertex", kPoints}};

TEST(AbcValues, OfEveryTypeWidthAndScope) {
  const char* types[][4] = {
      {"bool", "int2", "int3", "int4"},        {"int", "int2", "int3", "int4"},
      {"int", "int2", "int3", "int4"},         {"int", "int2", "int3", "int4"},
      {"int", "int2", "int3", "int4"},         {"int64", "int2", "int3", "int4"},
      {"int", "int2", "int3", "int4"},         {"int64", "int2", "int3", "int4"},
      {"int64", "int2", "int3", "int4"},       {"half", "half2", "half3", "half4"},
      {"float", "float2", "float3", "float4"}, {"double", "double2", "double3", "double4"}};
  for (const Scope& scope : kScopes) {
    for (std::uint32_t type = 0; type < 12; ++type) {
      for (std::uint32_t width = 1; width <= 4; ++width) {
        SCOPED_TRACE(fmt::format("{} {} type {} width {}", scope.word, scope.count, type, width));
        const AbcBytes::Property param =
            abcArray("number", static_cast<AbcBytes::Type>(type), numbersOf(type, scope.count * width), width,
                     fmt::format("arrayExtent=1;geoScope={};isGeomParam=true", scope.word));
        const LoadedGroom loaded = loadedOf({.params = {param}});
        EXPECT_TRUE(loaded.warnings.empty());
        const GroomValue* value = valueNamed(loaded, "primvars:number");
        ASSERT_TRUE(value);
        EXPECT_EQ(value->type, std::string(types[type][width - 1]) + "[]");
        EXPECT_EQ(value->interpolation, scope.interpolation);
        ASSERT_EQ(value->numbers.size(), scope.count * width);
        for (std::size_t k = 0; k < value->numbers.size(); ++k)
          EXPECT_EQ(value->numbers[k], type == 0 ? (k + 1) % 2 : k + 1);
      }
    }
    std::string names;
    for (std::size_t k = 0; k < scope.count; ++k) names += fmt::format("n{}", k) + '\0';
    const AbcBytes::Property texts =
        abcArray("name", AbcBytes::text, names, 1, fmt::format("geoScope={}", scope.word));
    const LoadedGroom loaded = loadedOf({.params = {texts}});
    const GroomValue* value = valueNamed(loaded, "primvars:name");
    ASSERT_TRUE(value);
    EXPECT_EQ(value->type, "string[]");
    EXPECT_EQ(value->interpolation, scope.interpolation);
    EXPECT_EQ(value->texts.size(), scope.count);
    EXPECT_EQ(value->texts.back(), fmt::format("n{}", scope.count - 1));
  }
}

AbcBytes::Property indexed(const std::string& name, AbcBytes::Property values,
                           const std::vector<std::uint32_t>& at, const std::string& scope) {
  values.name = ".vals";
  return {.name = name,
          .metadata = "geoScope=" + scope,
          .parts = {values, abcArray(".indices", static_cast<AbcBytes::Type>(5), abcNumbers(at))}};
}

TEST(AbcValues, IndexedOnesAreResolved) {
  const auto pairs = abcArray("", AbcBytes::f32, abcNumbers<float>({1, 2, 3, 4}), 2);
  const auto names = abcArray("", AbcBytes::text, std::string("left\0right\0", 11));
  const LoadedGroom loaded = loadedOf({.more = {indexed("uv", pairs, {1, 0}, "uni")},
                                       .params = {indexed("side", names, {1, 1, 0, 1, 0}, "vtx")}});
  const GroomValue* uv = valueNamed(loaded, "primvars:st");
  ASSERT_TRUE(uv);
  EXPECT_EQ(uv->type, "texCoord2f[]");
  EXPECT_EQ(uv->interpolation, "uniform");
  EXPECT_EQ(uv->numbers, (std::vector<double>{3, 4, 1, 2}));
  const GroomValue* side = valueNamed(loaded, "primvars:side");
  ASSERT_TRUE(side);
  EXPECT_EQ(side->texts, (std::vector<std::string>{"right", "right", "left", "right", "left"}));
  for (const std::vector<std::uint32_t>& wrong :
       {std::vector<std::uint32_t>{0, 2}, {0}, {}, {0, 4294967295u}})
    EXPECT_EQ(leftAside(loadedOf({.more = {indexed("uv", pairs, wrong, "uni")}})), 1u);
}

TEST(AbcValues, NamesAndMeaningsAreUsds) {
  const auto three = [](const char* name, const char* meaning, AbcBytes::Type type = AbcBytes::f32) {
    return abcArray(name, type, numbersOf(type, 3), 3,
                    fmt::format("geoScope=con;interpretation={}", meaning));
  };
  AbcCurveForm form;
  form.more = {three("N", "normal"), three(".velocities", "vector"),
               abcArray("width", AbcBytes::f32, numbersOf(10, 5), 1, "geoScope=vtx")};
  form.params = {three("Cs", "rgb"),
                 three("Ch", "rgb", AbcBytes::f16),
                 three("Pref", "point", AbcBytes::f64),
                 three("bytes", "rgb", AbcBytes::u8),
                 abcArray("rgba", AbcBytes::f32, numbersOf(10, 4), 4, "geoScope=con;interpretation=rgba"),
                 three("2nd clump.id:x", ""),
                 three("Cs", "rgb")};
  const LoadedGroom loaded = loadedOf(form);
  const std::pair<const char*, const char*> expected[] = {{"primvars:N", "normal3f[]"},
                                                          {"primvars:velocities", "vector3f[]"},
                                                          {"widths", "float[]"},
                                                          {"primvars:Cs", "color3f[]"},
                                                          {"primvars:Ch", "color3h[]"},
                                                          {"primvars:Pref", "point3d[]"},
                                                          {"primvars:bytes", "int3[]"},
                                                          {"primvars:rgba", "color4f[]"},
                                                          {"primvars:_2nd_clump_id_x", "float3[]"}};
  EXPECT_EQ(loaded.prims[0].values.size(), std::size(expected));
  for (const auto& [name, type] : expected) {
    const GroomValue* value = valueNamed(loaded, name);
    ASSERT_TRUE(value) << name;
    EXPECT_EQ(value->type, type) << name;
  }
  EXPECT_EQ(leftAside(loaded), 1u);  // the second Cs
}

TEST(AbcValues, WhatDoesNotFitIsLeftAside) {
  const std::string one = numbersOf(10, 1), two = numbersOf(10, 2);
  const auto vertex = abcArray("v", AbcBytes::f32, numbersOf(10, kPoints), 1, "geoScope=vtx");
  AbcBytes::Property moving = vertex, none = vertex, broken = vertex, few = vertex, wide = vertex,
                     large = vertex;
  moving.samples.push_back(numbersOf(10, 6).substr(4));
  none.samples.clear();
  broken.samples[0].pop_back();
  few.samples = {two};
  wide = abcArray("v", AbcBytes::f32, numbersOf(10, kPoints), 5, "geoScope=con");
  large = abcArray("v", static_cast<AbcBytes::Type>(8), abcNumber(std::numeric_limits<std::int64_t>::max()),
                   1, "geoScope=con");
  const AbcBytes::Property compound{.name = "v", .parts = {vertex}};
  const auto widths = abcArray("width", AbcBytes::text, std::string("a\0b\0", 4), 1, "geoScope=uni");
  for (const AbcBytes::Property& param : {moving, none, broken, few, wide, large, compound}) {
    const LoadedGroom loaded = loadedOf({.params = {param}});
    EXPECT_TRUE(loaded.prims[0].values.empty());
    EXPECT_EQ(leftAside(loaded), 1u);
  }
  EXPECT_EQ(leftAside(loadedOf({.more = {widths}})), 1u);
  // Of cubic curves, and where curves are left out, what is said of each curve or of all still fits.
  const auto uniform = abcArray("u", AbcBytes::i32, abcNumbers<std::int32_t>({7, 8, 9}), 1, "geoScope=uni");
  const auto constant = abcArray("c", AbcBytes::f32, one, 1, "geoScope=con");
  for (const bool isCubic : {false, true}) {
    const std::vector<std::int32_t> counts =
        isCubic ? std::vector<std::int32_t>{4, 3, 5} : std::vector<std::int32_t>{3, 1, 2};
    AbcCurveForm form{.type = isCubic ? kAbcCubic : kAbcLinear, .basis = 2};
    AbcBytes::Property all = vertex;
    all.samples = {numbersOf(10, isCubic ? 12 : 6)};
    form.params = {all, uniform, constant};
    const LoadedGroom loaded = loadedOf({abcCurves("hair", counts, abcCurl(counts), form)});
    EXPECT_EQ(leftAside(loaded), 1u);
    EXPECT_FALSE(valueNamed(loaded, "primvars:v"));
    ASSERT_TRUE(valueNamed(loaded, "primvars:u"));
    EXPECT_EQ(valueNamed(loaded, "primvars:u")->numbers, (std::vector<double>{7, 9}));
    EXPECT_TRUE(valueNamed(loaded, "primvars:c"));
  }
}

// What USD's writers take: out of an archive, into both kinds of files, and in again. Widths follow the
// transform.
TEST(AbcValues, AreCarriedIntoUsdFiles) {
  const auto folder = scratchFolder("abc_values");
  const auto params = [](int first) {
    AbcCurveForm form;
    form.more = {abcArray("width", AbcBytes::f32, numbersOf(10, 1), 1, "geoScope=con")};
    form.params = {
        abcArray("groom_id", AbcBytes::i32, abcNumbers<std::int32_t>({first, first + 1}), 1, "geoScope=uni"),
        abcArray("groom_group_name", AbcBytes::text, std::string("left\0right\0", 11), 1, "geoScope=uni"),
        abcArray("groom_root_uv", AbcBytes::f32, numbersOf(10, 4), 2, "geoScope=uni"),
        abcArray("Cs", AbcBytes::f32, numbersOf(10, 15), 3, "geoScope=vtx;interpretation=rgb"),
        abcArray("groom_version_major", static_cast<AbcBytes::Type>(4), numbersOf(4, 1), 1, "geoScope=con")};
    return form;
  };
  const LoadedGroom loaded = loadedOf(
      {abcXform("large", {0x00}, {{2, 2, 2}}, 0, {abcCurves("a", kCounts, abcCurl(kCounts), params(100))}),
       abcXform("other", {0x00}, {{2, 2, 2}}, 0, {abcCurves("b", kCounts, abcCurl(kCounts), params(200))})});
  for (const char* ending : {"usda", "usdc"}) {
    const auto path = folder / fmt::format("hair.{}", ending);
    const auto writer =
        createAnimation(path, loaded.groom, {.usd = {.origin = &loaded, .originValues = true}});
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE((*writer)->addFrame(loaded.groom.points));
    ASSERT_TRUE((*writer)->finish());
    const auto back = readGroom(path, {.keepsPrims = true});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->groom.points, loaded.groom.points);
    const auto numbers = [&](std::string_view name) {
      const GroomValue* value = valueNamed(*back, name);
      EXPECT_TRUE(value) << name;
      return value ? value->numbers : std::vector<double>();
    };
    EXPECT_EQ(numbers("primvars:groom_id"), (std::vector<double>{100, 101, 200, 201}));
    EXPECT_EQ(valueNamed(*back, "primvars:groom_id")->type, "int[]");
    EXPECT_EQ(valueNamed(*back, "primvars:groom_id")->interpolation, "uniform");
    EXPECT_EQ(numbers("widths"), (std::vector<double>{2, 2, 2, 2}));
    EXPECT_EQ(numbers("primvars:groom_root_uv"), (std::vector<double>{1, 2, 3, 4, 1, 2, 3, 4}));
    EXPECT_EQ(numbers("primvars:Cs").size(), 30u);
    EXPECT_EQ(numbers("primvars:groom_version_major"), (std::vector<double>{1, 1, 1, 1}));
    ASSERT_TRUE(valueNamed(*back, "primvars:groom_group_name"));
    EXPECT_EQ(valueNamed(*back, "primvars:groom_group_name")->texts,
              (std::vector<std::string>{"left", "right", "left", "right"}));
  }
}

TEST(AbcValues, WithoutPrimsNoneAreKept) {
  const AbcCurveForm form{.params = {abcArray("u", AbcBytes::f32, numbersOf(10, 1), 1, "geoScope=con")}};
  const std::string bytes = abcFile({abcCurves("hair", kCounts, abcCurl(kCounts), form)});
  const auto loaded = readAbcGroom(bytesOf(bytes), "g.abc");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->prims.empty());
}

}  // namespace
}  // namespace ringlet::test::abc_values_test
